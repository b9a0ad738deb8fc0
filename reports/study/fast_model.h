#pragma once
/// \file
/// The models in which operations are looked at: D V F of light and view, in
/// any number.

#include "brdf/formula/masking.h"
#include "brdf/formula/ndf.h"
#include "brdf/formula/ndf_ggx.h"
#include "optics/fresnel_approximate.h"

namespace gonio::inline GONIO_ARCH {

/// Distribution of a model; its masking is GGX's, correlated.
enum class Facets { ggx, beckmann, gtr };

/// Exponent of GTR here.
inline constexpr long double fast_gamma = 1.5L;

template <Real N>
N reciprocal_root(const N& x) {
  if constexpr (requires { rsqrt(x); })
    return rsqrt(x);
  else
    return 1 / sqrt(x);
}

/// Terms of a model in a number, and what they say of two directions.
template <Real N, Facets facets>
class FastModel {
 public:
  FastModel(const N& alpha, const N& f0)
      : f0_(f0),
        ggx_(std::array{alpha}),
        beckmann_(std::array{alpha}),
        gtr_(std::array{alpha, constant<N>(fast_gamma)}),
        masking_(std::array{alpha}) {}

  /// \param weight  of Schlick's form, by 1 − VoH
  template <class Weight>
  N operator()(const std::array<N, 3>& l,
               const std::array<N, 3>& v,
               bool by_cosine,
               const Weight& weight) const {
    const N x = l[0] + v[0], y = l[1] + v[1], z = l[2] + v[2];
    const N scale = reciprocal_root<N>(x * x + y * y + z * z);
    Angles<N> a{l[2], v[2], z * scale, (x * v[0] + y * v[1] + z * v[2]) * scale, N(0)};
    const N by_cross = (x * x + y * y) * (scale * scale);
    a.sin2_theta_h = by_cosine ? 1 - a.noh * a.noh : by_cross;
    const N w = weight(1 - a.voh), f = schlick<N>(f0_, w);
    const auto visibility = masking_(a);
    if constexpr (facets == Facets::ggx) {
      const auto d = ggx_(a);
      return d.num * visibility.num / (d.den * visibility.den) * f;
    } else if constexpr (facets == Facets::beckmann) {
      return beckmann_(a) * visibility.num / visibility.den * f;
    } else {
      return gtr_(a) * visibility.num / visibility.den * f;
    }
  }

 private:
  N f0_;
  Ggx<N> ggx_;
  Beckmann<N> beckmann_;
  Gtr<N> gtr_;
  SmithGgxCorrelated<N> masking_;
};

/// (1 − VoH)⁵ by three products.
struct ByProducts {
  template <Real N>
  N operator()(const N& m) const {
    return square(square(m)) * m;
  }
};
/// The same as a power: exp(5 ln m); of 0 it is that of the least normal float.
struct ByPower {
  template <Real N>
  N operator()(const N& m) const {
    return exp(log(max<N>(m, constant<N>(0x1p-126L))) * 5);
  }
};
/// The same as a spherical Gaussian. [Lagarde 2012]
struct BySphericalGaussian {
  template <Real N>
  N operator()(const N& m) const {
    const N c = 1 - m;
    return exp((constant<N>(-5.55473L) * c - constant<N>(6.98316L)) * c *
               constant<N>(0.693147180559945309417L));
  }
};

}  // namespace gonio::inline GONIO_ARCH
