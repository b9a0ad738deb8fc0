#pragma once
/// \file
/// Subjects of the stability atlas: a term or a model, the numbers it is made of, and where these may lie.
///
/// What depends on one another is given as what it is made of, and the rest follows in the number that is looked at, as
/// a shader would compute it: NoH from sin²θ_h, or sin²θ_h from NoH; the half vector from two directions.

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/names.h"
#include "brdf/model/model.h"
#include "geometry/half_vector.h"
#include "number/parameter.h"

namespace gonio::stability {

/// Form in which a sample's angles are given.
///
///   cross       sin²θ_h, as |n × h|²: NoH = √(1 − sin²θ_h)
///   cosine      NoH alone: sin²θ_h = 1 − NoH²
///   frame       sin²θ_h and cos φ_h of an anisotropic distribution
///   facet       VoH
///   cosines     NoL and NoV
///   directions  NoL, NoV and cos φ, the azimuth between them; l lies above the tangent
///   turned      NoL, cos φ_l, NoV and cos φ_v: each direction with its own azimuth from the tangent
enum class Given { cross, cosine, frame, facet, cosines, directions, turned };

}  // namespace gonio::stability

namespace gonio {
template <>
inline constexpr std::array<std::string_view, 7> names_of<stability::Given>{
    "cross", "cosine", "frame", "facet", "cosines", "directions", "turned"};
}  // namespace gonio

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
  std::optional<std::size_t> decides;  ///< the parameter that people clamp: alpha, else the first;
                                       ///< none where there is none

  std::string_view form() const { return name_of(given); }
};

/// Every way in which a term's angles are given: a distribution by |n × h|² and by NoH alone, others in one.
/// The domain is the hard one: alpha from 1e-6, cosines from 1e-8, k to 1e3.
std::vector<Subject> subjects_of_term(std::size_t term);
/// A term by its id, or a model by its spec; wrong usage if it is neither.
std::vector<Subject> subjects_of(std::string_view id_or_spec);

/// Narrows the domain of an input; refuses a name it has not, and ends that are reversed, not numbers or outside what is legal.
void set_domain(Subject&, std::string_view input, Range);

/// Number of angles that are given.
std::size_t angle_count(Given);

inline namespace GONIO_ARCH {

/// Angles of a sample from the inputs that are angles; those that the subject does not read are those of the normal.
template <Real B>
FrameAngles<B> angles_of(Given given, std::span<const B> in) {
  const B one(1), none(0);
  FrameAngles<B> a{{one, one, one, one, none}, none, none, none, none, none, none};
  const auto across = [&](const B& c) { return sqrt(max<B>((1 - c) * (1 + c), none)); };
  switch (given) {
    case Given::cross:
      a.sin2_theta_h = in[0];
      a.noh = sqrt(max<B>(1 - in[0], none));
      break;
    case Given::cosine:
      a.noh = in[0];
      a.sin2_theta_h = 1 - in[0] * in[0];
      break;
    case Given::frame: {
      const B sine = sqrt(in[0]);
      a.sin2_theta_h = in[0];
      a.noh = sqrt(max<B>(1 - in[0], none));
      a.xoh = sine * in[1];
      a.yoh = sine * across(in[1]);
      break;
    }
    case Given::facet:
      a.voh = in[0];
      break;
    case Given::cosines:
      a.nol = in[0];
      a.nov = in[1];
      break;
    case Given::directions: {
      const B sine_v = across(in[1]);
      return angles_between<B>({across(in[0]), none, in[0]},
                               {sine_v * in[2], sine_v * across(in[2]), in[1]});
    }
    case Given::turned: {
      const B sine_l = across(in[0]), sine_v = across(in[2]);
      return angles_between<B>({sine_l * in[1], sine_l * across(in[1]), in[0]},
                               {sine_v * in[3], sine_v * across(in[3]), in[2]});
    }
  }
  return a;
}

}  // namespace GONIO_ARCH
}  // namespace gonio::stability
