#pragma once
/// \file
/// GGX, the normal distribution that most models have: apart from those of ndf.h, for every masking is
/// compiled together with it.

#include "brdf/formula/widths.h"
#include "brdf/term/term.h"

namespace gonio::inline GONIO_ARCH {

/// GGX (Trowbridge–Reitz).  Its slopes have the density α²/(π (α² + p² + q²)²), Student's t of two
/// degrees of freedom and not, as is often said, a Cauchy density; they have no standard deviation.
///
/// 1. A facet with the slopes p, q has the normal h ~ (−p, −q, 1), so p² + q² = tan²θ_h and
///    dp dq = dω/cos³θ_h.  Facets of a slope are seen as D cos θ_h dω = density dp dq, which gives
///
///       D = density / cos⁴θ_h = α² / (π (α² cos²θ_h + sin²θ_h)²)                  [Walter 2007, Eq. 33]
///
/// 2. Shaders write NoH² (α² − 1) + 1 for the bracket.  At the peak of a smooth surface that is 1 − 1 + α²: a
///    unit of NoH's last digit, 6e-8 in float, is 6 times the whole of it at α = 1e-4.
///
/// 3. For unit vectors (n·h)² + |n×h|² = 1 (Lagrange), and |n×h|² has all its digits wherever h is given by its
///    coordinates.  It comes with the angles as sin²θ_h, and of
///
///       ┌────────────────────────────────────┐
///       │  D = (α²/π) / (α² NoH² + |n×h|²)²  │
///       └────────────────────────────────────┘
///
///    both summands are positive: D is as exact as what it is given.  The division is left to the product.
///
/// 4. In half α² has few digits below α = 0.008, the bracket's square overflows or vanishes, and D may be 0/0.  Of
///    u = bracket/α, which lies between α and 1/α, none does before D itself leaves the range:
///
///       ┌──────────────────────────────────────────────┐
///       │  D = (1/π) / u²,   u = α NoH² + |n×h|² (1/α)  │
///       └──────────────────────────────────────────────┘
template <Real T>
struct Ggx {
  static constexpr About about{
      "ndf.ggx", "GGX (Trowbridge–Reitz)", "D = α² / (π (NoH² (α² − 1) + 1)²)",
      "Trowbridge & Reitz 1975; Walter et al. 2007, Eq. 33",
      "Disney, Unreal Engine 4 (D_GGX), Unity, Filament, glTF 2.0, Mitsuba, pbrt"};
  static constexpr std::array parameters{alpha_parameter};

  T alpha, per_alpha, num;

  explicit Ggx(std::span<const T, 1> p)
      : alpha(p[0]), per_alpha(1 / p[0]), num(1 / pi<plain_t<T>>()) {}

  Quotient<T> operator()(const Angles<plain_t<T>>& a) const {
    return {num, square(alpha * square(a.noh) + per_alpha * a.sin2_theta_h)};
  }
};

}  // namespace gonio::inline GONIO_ARCH
