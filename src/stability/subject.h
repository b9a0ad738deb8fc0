#pragma once
/// \file
/// Subjects of the stability atlas: a term or a model, the numbers it is made of, and where these may lie.
///
/// Inputs that depend on one another are given as what they are made of, and the rest follows in the number that is looked at, as
/// a shader would compute it: NoH from sin²θ_h, or sin²θ_h from NoH; the half vector from two directions.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "brdf/model/model.h"
#include "number/parameter.h"
#include "stability/kernel/given.h"

namespace gonio::stability {

/// A parameter or an angle that a subject is made of.
struct Input {
  std::string name;           ///< "alpha", "sin2_theta_h", "nol" …
  Range domain;               ///< where it is looked at
  Range legal;                ///< where it may lie at all
  std::vector<double> edges;  ///< values within that are hard on their own: 1 of gamma and eta
};

/// A term, or a model of one channel: its inputs are its parameters in their order, then its angles.
struct Subject {
  std::string id;                   ///< of the catalogue, or a spec
  std::optional<std::size_t> term;  ///< index into catalogue(); none: a model
  std::optional<Model> model;       ///< where it is no term
  Given given;
  std::vector<Input> inputs;
  std::size_t parameters;              ///< of the inputs, those that are parameters
  std::optional<std::size_t> decides;  ///< the parameter that people clamp: alpha or a roughness,
                                       ///< else the first; none where there is none
  bool narrows = false;  ///< more of what decides is a narrower lobe, as of a smoothness: what is
                         ///< required holds up to a value, not from it

  std::string_view form() const { return name_of(given); }
};

/// Every way in which a term's angles are given: a distribution by |n × h|² and by NoH alone, others in one.
/// The domain is the hard one: alpha from 1e-6, cosines from 1e-8, k to 1e3.
std::vector<Subject> subjects_of_term(std::size_t term);
/// A term by its id, or a model by its spec; wrong usage if it is neither.
std::vector<Subject> subjects_of(std::string_view id_or_spec);

/// The one whose angles are given so; wrong usage that names the others if it has none.
Subject subject_of(std::string_view id_or_spec, std::string_view form);

/// Narrows the domain of an input; refuses a name it has not, and ends that are reversed, not numbers or outside what is legal.
void set_domain(Subject&, std::string_view input, Range);

/// Wrong usage where an input has no bounds: a parameter of a person's file of which nothing is said.
void expect_bounded(const Subject&);

/// Number of angles that are given.
std::size_t angle_count(Given);

}  // namespace gonio::stability
