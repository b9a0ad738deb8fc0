#pragma once
/// \file
/// Weight of a light that was drawn: f NoL over its density, GGX under
/// height-correlated Smith at F = 1; 0 below the horizon.

#include "brdf/formula/masking.h"
#include "brdf/formula/ndf_ggx.h"
#include "geometry/ggx_sampling.h"

namespace gonio::inline GONIO_ARCH {

template <class Sampling, Real T>
T sampling_weight(const Vector3<T>& v, const T& alpha, const Vector3<T>& l) {
  using namespace sampling;
  const auto above = T(0) < l[2];
  const Vector3<T> lit{l[0], l[1], select<T>(above, l[2], T(1))};
  const auto h = normalised<T>({v[0] + lit[0], v[1] + lit[1], v[2] + lit[2]});
  const Angles<T> a{lit[2], v[2], h[2], dot<T>(v, h), h[0] * h[0] + h[1] * h[1]};
  const auto d = Ggx<T>(std::array{alpha})(a), m = SmithGgxCorrelated<T>(std::array{alpha})(a);
  const T weight = d.num * m.num * lit[2] / (d.den * m.den * Sampling::density(v, alpha, lit));
  return select<T>(above, weight, T(0));
}

}  // namespace gonio::inline GONIO_ARCH
