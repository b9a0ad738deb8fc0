#pragma once
/// \file
/// Forms in which a sample's angles are given, and what follows from them in a number, as a shader would compute it.

#include <array>
#include <span>
#include <string_view>

#include "base/names.h"
#include "geometry/half_vector.h"

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
