#pragma once
/// \file
/// Masking and shadowing as visibility V = G₂ / (4 NoL NoV) [1/sr]: the cosines cancel on paper, so
/// nothing divides by zero at grazing angles.  Defined for NoL, NoV in [0, 1], not both 0, where the
/// correlated V has no bound.

#include "brdf/ndf.h"
#include "brdf/term.h"

namespace gonio::inline GONIO_ARCH {

/// √(α² + (1 − α²) c²) = c √(1 + α² tan²θ), with (1 − α) (1 + α) for 1 − α²
template <Real T>
struct SmithRoot {
  T alpha2, rest;
  explicit SmithRoot(const T& alpha) : alpha2(square(alpha)), rest((1 - alpha) * (1 + alpha)) {}
  T operator()(const plain_t<T>& c) const { return sqrt(alpha2 + rest * square(c)); }
};

/// Smith masking for GGX, light and view independent.
///
///   V = 1 / ((NoL + r(NoL)) (NoV + r(NoV))),   G₁(c) = 2c / (c + r(c))  [Walter 2007, Eq. 34]
template <Real T>
struct SmithGgxSeparable {
  static constexpr About about{"masking.smith_ggx.separable", "Smith for GGX, separable",
                               "G2 = G1(NoL) G1(NoV), G1(c) = 2c / (c + √(α² + (1 − α²) c²))",
                               "Walter et al. 2007, Eq. 34"};
  static constexpr std::array parameters{alpha_parameter};

  SmithRoot<T> root;

  explicit SmithGgxSeparable(std::span<const T, 1> p) : root(p[0]) {}

  Quotient<T> operator()(const Angles<plain_t<T>>& a) const {
    return {T(1), (root(a.nol) + a.nol) * (root(a.nov) + a.nov)};
  }
};

/// Smith masking for GGX, correlated through the height of the facet.
///
///   V = 1 / (2 (NoL r(NoV) + NoV r(NoL))),   G₂ = 1 / (1 + Λ(l) + Λ(v)) [Heitz 2014, Eq. 99]
template <Real T>
struct SmithGgxCorrelated {
  static constexpr About about{
      "masking.smith_ggx.correlated", "Smith for GGX, height-correlated",
      "G2 = 2 NoL NoV / (NoL √(α² + (1−α²) NoV²) + NoV √(α² + (1−α²) NoL²))", "Heitz 2014, Eq. 99"};
  static constexpr std::array parameters{alpha_parameter};

  SmithRoot<T> root;

  explicit SmithGgxCorrelated(std::span<const T, 1> p) : root(p[0]) {}

  Quotient<T> operator()(const Angles<plain_t<T>>& a) const {
    const T sum = a.nol * root(a.nov) + a.nov * root(a.nol);
    return {T(1), sum + sum};
  }
};

}  // namespace gonio::inline GONIO_ARCH
