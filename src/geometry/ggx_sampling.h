#pragma once
/// \file
/// Directions drawn for GGX, isotropic, by a point of the unit square: light l
/// for a view v, both away from the surface, in a frame with the normal along
/// z.
///
///   m a facet's normal, l = 2 (v·m) m − v, which may lie below the horizon
///
/// Number T: float, double, or a register of them, whose sin and cos are looked
/// up by argument.

#include <array>
#include <cmath>
#include <string_view>

#include "number/real.h"

namespace gonio::inline GONIO_ARCH {

template <class T>
using Vector3 = std::array<T, 3>;

namespace sampling {

using std::cos;
using std::sin;

template <Real T>
T dot(const Vector3<T>& a, const Vector3<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <Real T>
Vector3<T> normalised(const Vector3<T>& a) {
  const T scale = 1 / sqrt(dot<T>(a, a));
  return {a[0] * scale, a[1] * scale, a[2] * scale};
}
template <Real T>
T two_pi() {
  return constant<T>(6.28318530717958647692528676655900577L);
}
template <Real T>
T not_below_0(const T& x) {
  return max<T>(x, T(0));
}
/// (α x, α y, z)/‖·‖: the view as the sphere sees it that the facets are
/// stretched from.     [Heitz 2018, section 3]
template <Real T>
Vector3<T> stretched(const Vector3<T>& v, const T& alpha) {
  return normalised<T>({alpha * v[0], alpha * v[1], v[2]});
}
/// ‖(α x, α y, z)‖
template <Real T>
T stretched_length(const Vector3<T>& v, const T& alpha) {
  return sqrt(alpha * alpha * (v[0] * v[0] + v[1] * v[1]) + v[2] * v[2]);
}
template <Real T>
Vector3<T> reflected(const Vector3<T>& v, const Vector3<T>& m) {
  const T twice = dot<T>(v, m) * 2;
  return {twice * m[0] - v[0], twice * m[1] - v[1], twice * m[2] - v[2]};
}
template <Real T>
T ggx(const T& noh, const T& alpha) {
  const T a2 = alpha * alpha, bracket = noh * noh * (a2 - 1) + 1;
  return a2 / (pi<T>() * bracket * bracket);
}
/// The point (u even over a turn, w even over heights from −low to 1) of the
/// sphere.
template <Real T>
Vector3<T> on_cap(const T& u, const T& w, const T& low) {
  const T phi = two_pi<T>() * u, z = (1 - w) * (1 + low) - low;
  const T sine = sqrt(not_below_0<T>(1 - z * z));
  return {sine * cos(phi), sine * sin(phi), z};
}

}  // namespace sampling

/// Normals as they are there, whatever is seen of them: density D (n·m).
/// [Walter et al. 2007, Eq. 35]
template <Real T>
struct GgxNormals {
  static constexpr std::string_view id = "sampling.ggx.d", name = "normals by D only";
  static Vector3<T> light(const Vector3<T>& v, const T& alpha, const T& u, const T& w) {
    using namespace sampling;
    const T tangent = alpha * sqrt(u / max<T>(1 - u, constant<T>(1e-7L))), phi = two_pi<T>() * w;
    return reflected<T>(v, normalised<T>({tangent * cos(phi), tangent * sin(phi), T(1)}));
  }
  /// Density of l [1/sr], of l above the horizon.
  static T density(const Vector3<T>& v, const T& alpha, const Vector3<T>& l) {
    using namespace sampling;
    const auto h = normalised<T>({v[0] + l[0], v[1] + l[1], v[2] + l[2]});
    return ggx<T>(h[2], alpha) * h[2] / (4 * dot<T>(v, h));
  }
};

/// Normals as they are seen, by a disk that is cut and bent. [Heitz 2018]
template <Real T>
struct GgxVisible2018 {
  static constexpr std::string_view id = "sampling.ggx.vndf2018",
                                    name = "visible normals by Heitz 2018";
  static Vector3<T> light(const Vector3<T>& v, const T& alpha, const T& u, const T& w) {
    using namespace sampling;
    const auto h = stretched<T>(v, alpha);
    const T across2 = h[0] * h[0] + h[1] * h[1];
    const auto leans = constant<T>(1e-12L) < across2;
    const T scale = 1 / sqrt(select<T>(leans, across2, T(1)));
    const T tx = select<T>(leans, -h[1] * scale, T(1)), ty = select<T>(leans, h[0] * scale, T(0));
    const Vector3<T> up{0 - h[2] * ty, h[2] * tx, h[0] * ty - h[1] * tx};  // h × (tx, ty, 0)
    const T r = sqrt(u), phi = two_pi<T>() * w, x = r * cos(phi), even = r * sin(phi);
    const T share = (1 + h[2]) / 2;
    const T y = (1 - share) * sqrt(not_below_0<T>(1 - x * x)) + share * even;
    const T z = sqrt(not_below_0<T>(1 - x * x - y * y));
    const Vector3<T> m{x * tx + y * up[0] + z * h[0], x * ty + y * up[1] + z * h[1],
                       y * up[2] + z * h[2]};
    return reflected<T>(v, normalised<T>({alpha * m[0], alpha * m[1], not_below_0<T>(m[2])}));
  }
  static T density(const Vector3<T>& v, const T& alpha, const Vector3<T>& l) {
    using namespace sampling;
    const auto h = normalised<T>({v[0] + l[0], v[1] + l[1], v[2] + l[2]});
    return ggx<T>(h[2], alpha) / (2 * (v[2] + stretched_length<T>(v, alpha)));
  }
};

/// The same normals as half vectors of the view and a point even over the cap
/// that it lights.  [Dupuy & Benyoub 2023]
template <Real T>
struct GgxCaps {
  static constexpr std::string_view id = "sampling.ggx.caps",
                                    name = "visible normals by spherical caps";
  static Vector3<T> light(const Vector3<T>& v, const T& alpha, const T& u, const T& w) {
    using namespace sampling;
    const auto h = stretched<T>(v, alpha);
    const auto c = on_cap<T>(u, w, h[2]);
    return reflected<T>(v,
                        normalised<T>({alpha * (c[0] + h[0]), alpha * (c[1] + h[1]), c[2] + h[2]}));
  }
  static T density(const Vector3<T>& v, const T& alpha, const Vector3<T>& l) {
    return GgxVisible2018<T>::density(v, alpha, l);
  }
};

/// Caps that end where every light would lie below the horizon. [Tokuyoshi &
/// Eto 2024, Eqs. 5 and 6]
template <Real T>
struct GgxBounded {
  static constexpr std::string_view id = "sampling.ggx.bounded", name = "bounded spherical caps";
  static Vector3<T> light(const Vector3<T>& v, const T& alpha, const T& u, const T& w) {
    using namespace sampling;
    const auto h = stretched<T>(v, alpha);
    const auto c = on_cap<T>(u, w, share(v, alpha) * h[2]);
    return reflected<T>(v,
                        normalised<T>({alpha * (c[0] + h[0]), alpha * (c[1] + h[1]), c[2] + h[2]}));
  }
  static T density(const Vector3<T>& v, const T& alpha, const Vector3<T>& l) {
    using namespace sampling;
    const auto h = normalised<T>({v[0] + l[0], v[1] + l[1], v[2] + l[2]});
    return ggx<T>(h[2], alpha) / (2 * (share(v, alpha) * v[2] + stretched_length<T>(v, alpha)));
  }

 private:
  /// k = (1 − α²) s²/(s² + α² z²), s = 1 + sin θ_v
  static T share(const Vector3<T>& v, const T& alpha) {
    const T s = 1 + sqrt(v[0] * v[0] + v[1] * v[1]), s2 = s * s, a2 = alpha * alpha;
    return (1 - a2) * s2 / (s2 + a2 * v[2] * v[2]);
  }
};

}  // namespace gonio::inline GONIO_ARCH
