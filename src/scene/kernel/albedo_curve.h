#pragma once
/// \file
/// Albedo of a lobe at F = 1 by the cosine, as a short polynomial that a loop over samples can take.

#include <array>
#include <cstddef>

#include "brdf/formula/smith_gtr.h"
#include "number/real.h"

namespace gonio::scene {

/// E(μ) = Σ c_k T_k(2 √(μ/(μ + w)) / √(1/(1 + w)) − 1), T_k Chebyshev's: the variable is as wide in the layer at the
/// horizon, which is as thin as the lobe's width w, as above it.  Of GGX under Smith's masking it is off by at most
/// 4.2e-5, at alpha = 0.004; it is never above 1.
template <class T>
struct AlbedoCurve {
  static constexpr std::size_t terms = 16;
  T width{1}, scale{1};  ///< w, and 2 √(1 + w)
  std::array<T, terms> coefficient{};

  template <class S>
  AlbedoCurve<S> in() const {
    AlbedoCurve<S> c{S(width), S(scale), {}};
    for (std::size_t k = 0; k < terms; ++k) c.coefficient[k] = S(coefficient[k]);
    return c;
  }
};

inline namespace GONIO_ARCH {

template <Real T>
T value_at(const AlbedoCurve<T>& c, const T& mu) {
  const T e = smith_gtr::chebyshev_sum(c.coefficient, c.scale * sqrt(mu / (mu + c.width)) - 1);
  return min<T>(e, T(1));
}

}  // namespace GONIO_ARCH

}  // namespace gonio::scene
