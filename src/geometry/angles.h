#pragma once
/// \file
/// Angles that a term may ask of one sample: the cosines between n (normal), l (light), v (view) and
/// h (half vector).

#include "number/real.h"

namespace gonio::inline GONIO_ARCH {

/// sin²θ_h is given beside NoH because 1 − NoH² cancels at the peak: from 1 − c·c the GGX
/// distribution is wrong by 4e4 ulp in double, from |n×h|² by 5.
template <class B>
struct Angles {
  B nol, nov, noh, voh, sin2_theta_h;
};

/// Angles of a surface with a tangent x and a bitangent y, which anisotropic terms read, too.
/// \tparam C  number of the frame: it may carry a derivative by the tangent's turn
template <class B, class C = B>
struct FrameAngles : Angles<B> {
  C xoh, yoh, xol, yol, xov, yov;
};

/// VoH, which for any two directions is at least (NoL + NoV)/2: 2 VoH NoH = NoL + NoV.  Angles that no
/// two directions have get the bound, which is above 0 throughout the domain.
template <Real B>
B least_voh(const Angles<B>& a) {
  return max<B>(a.voh, (a.nol + a.nov) / 2);
}

}  // namespace gonio::inline GONIO_ARCH
