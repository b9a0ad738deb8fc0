#pragma once
/// \file
/// Which model of the catalogue a whole function of a person's file is, and by which slip it differs.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "reports/own/nearest.h"
#include "reports/own/parameters.h"

namespace gonio {

/// Model of the catalogue whose highlight a whole function has.
struct NearestModel {
  std::string spec;
  std::size_t width = 0;  ///< parameter of the function
  PartColours colours;
  std::string f0;              ///< the parameter that is F0, where its name does not say so
  double power = 1;            ///< of D: alpha = width^power
  double masking_power = 1;    ///< of V
  double factor = 1;           ///< the function's highlight over the model's
  std::size_t operations = 0;  ///< in the function's channels; with Lambert's where the function
                               ///< has another diffuse part
  bool lacks_diffuse =
      false;  ///< the function has a diffuse part that is not Lambert's, which the model has not
  bool keeps_lambert = false;  ///< Lambert's part has the colour of F0
  bool other_fresnel = false;  ///< F is that of none of ours
  std::string disguise;        ///< what its highlight is multiplied with, a sentence
  bool is_weight = false;      ///< `disguise` is right where F0 is a weight
  std::string fresnel_slip;    ///< a sentence
  std::string interface_slip;  ///< likewise, of F that comes from eta
  std::string form_slip;       ///< of D or V
  std::string diffuse_slip;    ///< a sentence
  std::string half_vector;     ///< a sentence
  std::string shape, masking;  ///< the forms of D and V, without their roles
  std::optional<Bite> bite;
  std::optional<Drop> drop;
};

/// The model whose D V F is the function's, with its other colours dark, but for a factor and what slips make of it.
/// \param why  why there is none
std::optional<NearestModel> nearest_model(std::size_t foreign_term, std::string& why);
/// The likely mistakes in its factor, its width and its parts, a sentence each.
/// \param guessed_pi  that its value includes π is a guess
std::vector<std::string> likely_slips(const NearestModel&, const Parameter& width, bool guessed_pi);
/// True of a highlight without a diffuse part that is that of ours only without the π that was guessed.
bool is_without_pi(const NearestModel&);
/// Whether its highlight is a sheen, which no smooth surface has.
bool is_sheen(const NearestModel&);
/// "its highlight is 4 times too large: a 4 is missing below"
std::string highlight_text(double factor, bool guessed_pi);
/// What is right for some uses and wrong for others, a sentence each.
std::vector<std::string> to_check(const NearestModel&, const Parameter& width);

}  // namespace gonio
