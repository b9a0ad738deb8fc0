#pragma once
/// \file
/// The facet of Smith's microsurface that light meets, drawn at random.
///
/// Of light that flies along w, above the surface or within it, upwards or downwards, that facet's normal m
/// has the density
///
///   D_w(m) = max(0, −w·m) D(m) / σ(−w),   σ(u) = ∫ max(0, u·m) D(m) dω_m        [Heitz 2016, Eq. 2]
///
/// Both distributions are stretched unit ones: with A = diag(α_x, α_y, 1), m is along A h, where h is drawn
/// for widths 1 and the direction A w.                                      [Heitz 2014, section 5.4]

#include <cmath>
#include <numbers>

#include "base/random.h"
#include "geometry/direction.h"

namespace gonio {

/// A facet by a vector along its normal, of any length.
struct Facet {
  double x, y, z;
};

/// Of GGX, for which a unit h is the half vector of u = −A w/|A w| and a point even over the part of the
/// sphere with z > −u_z                                                          [Dupuy & Benyoub 2023]
///
/// \param area  σ(−w); |A w| is 2σ(−w) + w_z
class GgxFacets {
 public:
  GgxFacets(double alpha_x, double alpha_y) : alpha_x_(alpha_x), alpha_y_(alpha_y) {}

  Facet operator()(const Direction& w, double area, Draws& draw) const {
    const double per_length = 1 / (2 * area + w.z), height = 2 * area * per_length;  // 1 + u_z
    const double down = height * draw.uniform();                                     // 1 − z
    const double phi = 2 * std::numbers::pi * draw.uniform();
    const double sine = std::sqrt(down * (2 - down));
    return {alpha_x_ * (sine * std::cos(phi) - alpha_x_ * w.x * per_length),
            alpha_y_ * (sine * std::sin(phi) - alpha_y_ * w.y * per_length), height - down};
  }

 private:
  double alpha_x_, alpha_y_;
};

/// x with the density (a + x) e^(−x²) over x > −a, unnormalised; a is any number.
///
/// By rejection, from one of two densities that touch it from above.  For large a it is almost normal; a + x
/// lies below its tangent in logarithms at the mode x₀, T = a + x₀ = (a + √(a² + 2))/2:
///
///   a + x ≤ T e^((x − x₀)/T),   a normal density about 1/(2T) = x₀
///
/// For negative a it is almost t e^(2 a t) with t = a + x, which it lies below with a little less steepness:
///
///   t e^(2 a t − t²) ≤ e^(t₀²) t e^(−λ t),   λ = √(a² + 4) − a,   t₀ = 2/λ
///
/// which is best of all λ.  Either accepts two of three draws or more, where it is used.
inline double beckmann_visible_slope(double a, Draws& draw) {
  if (a > 0.25) {
    const double t0 = (a + std::sqrt(a * a + 2)) / 2, x0 = t0 - a;
    for (;;) {
      const double r = std::sqrt(-std::log(draw.uniform()));
      const double x = x0 + r * std::cos(2 * std::numbers::pi * draw.uniform());
      if (draw.uniform() * t0 * std::exp((x - x0) / t0) <= a + x) return x;
    }
  }
  const double lambda = std::sqrt(a * a + 4) - a, t0 = 2 / lambda;
  for (;;) {
    const double t = -std::log(draw.uniform() * draw.uniform()) / lambda;
    if (draw.uniform() <= std::exp(-(t - t0) * (t - t0))) return t - a;
  }
}

/// Of Beckmann, whose slopes along A w and across it are independent: the first has the density
/// (a + x) e^(−x²) with the cotangent a of −A w, the other e^(−y²).
class BeckmannFacets {
 public:
  BeckmannFacets(double alpha_x, double alpha_y) : alpha_x_(alpha_x), alpha_y_(alpha_y) {}

  Facet operator()(const Direction& w, double, Draws& draw) const {
    const double sx = alpha_x_ * w.x, sy = alpha_y_ * w.y;
    const double s = std::sqrt(sx * sx + sy * sy);
    const double per_s = 1 / std::max(s, 1e-150);  // straight down, any azimuth will do
    const double c = s > 0 ? -sx * per_s : 1, d = -sy * per_s;
    const double along = beckmann_visible_slope(-w.z * per_s, draw);
    const double across = draw.normal() * (1 / std::numbers::sqrt2);
    return {alpha_x_ * (c * along - d * across), alpha_y_ * (d * along + c * across), 1};
  }

 private:
  double alpha_x_, alpha_y_;
};

}  // namespace gonio
