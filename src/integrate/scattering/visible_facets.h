#pragma once
/// \file
/// The facet of Smith's microsurface that light meets, drawn at random.
///
/// Light flies along w, above the surface or within it, upwards or downwards; the normal m of the facet it meets
/// has the density
///
///   D_w(m) = max(0, −w·m) D(m) / σ(−w),   σ(u) = ∫ max(0, u·m) D(m) dω_m      [Heitz et al. 2016]
///
/// Both distributions are stretched unit ones: with A = diag(α_x, α_y, 1), m is along A h, where h is drawn
/// for widths 1 and the direction A w.                                      [Heitz 2014, section 5.4]

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/random.h"
#include "geometry/direction.h"

namespace gonio {

/// A facet by a vector along its normal, of any length.
struct Facet {
  double x, y, z;
};

/// Facets of GGX, for which a unit h is the half vector of u = −A w/|A w| and a point even over the part of the
/// sphere with z > −u_z                                                          [Dupuy & Benyoub 2023]
///
/// \param area  σ(−w); |A w| is 2σ(−w) + w_z
class GgxFacets {
 public:
  GgxFacets(double alpha_x, double alpha_y) : alpha_x_(alpha_x), alpha_y_(alpha_y) {}

  Facet operator()(const Direction& w, double area, Draws& draw) const {
    return (*this)(w, area, {draw.uniform(), draw.uniform()});
  }
  /// Facet of a point of the unit square.
  Facet operator()(const Direction& w, double area, const std::array<double, 2>& point) const {
    const double per_length = 1 / (2 * area + w.z), height = 2 * area * per_length;  // 1 + u_z
    const double down = height * point[0];                                           // 1 − z
    const double phi = 2 * std::numbers::pi * point[1];
    const double sine = std::sqrt(down * (2 - down));
    return {alpha_x_ * (sine * std::cos(phi) - alpha_x_ * w.x * per_length),
            alpha_y_ * (sine * std::sin(phi) - alpha_y_ * w.y * per_length), height - down};
  }

 private:
  double alpha_x_, alpha_y_;
};

/// Slopes (x, y) with the density (a + x) e^(−x² − y²) over x > −a, unnormalised; a is any number.
///
/// x by rejection, from one of two densities that touch its own from above.  For large a it is almost normal;
/// a + x lies below its tangent in logarithms at the mode x₀, where a + x₀ = t₀ = (a + √(a² + 2))/2:
///
///   a + x = t₀ (1 + d) ≤ t₀ e^d,   d = (x − x₀)/t₀,   t₀ e^d e^(−x²) a normal density about 1/(2 t₀) = x₀
///
/// For negative a it is almost t e^(2 a t) with t = a + x, and lies below the same a little less steep:
///
///   t e^(2 a t − t²) = t e^(t₀² − λ t) e^(−d²),   λ = √(a² + 4) − a,   t₀ = 2/λ,   d = t − t₀
///
/// which is the best λ.  Where each is used it accepts 0.69 of its draws or more, mostly by 1 − d², which
/// is less than (1 + d) e^(−d) and than e^(−d²).
inline std::array<double, 2> beckmann_visible_slopes(double a, Draws& draw) {
  const bool normal = a > 0.25;
  const double root = std::sqrt(a * a + (normal ? 2 : 4));
  const double t0 = normal ? (a + root) / 2 : 2 / (root - a);
  for (;;) {
    const double r = std::sqrt(-std::log(draw.uniform()));
    const double phi = 2 * std::numbers::pi * draw.uniform();
    const double y = r * std::sin(phi), u = draw.uniform();
    if (normal) {
      const double off = r * std::cos(phi), d = off / t0;
      if (u <= 1 - d * d || u <= (1 + d) * std::exp(-d)) return {0.5 / t0 + off, y};
    } else {
      const double t = -std::log(draw.uniform() * draw.uniform()) * t0 / 2, d = t - t0;
      if (u <= 1 - d * d || u <= std::exp(-d * d)) return {t - a, y};
    }
  }
}

/// Facets of Beckmann, whose slopes along A w and across it are independent: a is the cotangent of −A w.
class BeckmannFacets {
 public:
  BeckmannFacets(double alpha_x, double alpha_y) : alpha_x_(alpha_x), alpha_y_(alpha_y) {}

  Facet operator()(const Direction& w, double, Draws& draw) const {
    const double wx = alpha_x_ * w.x, wy = alpha_y_ * w.y;
    const double sine = std::sqrt(wx * wx + wy * wy);
    const double per_sine = 1 / std::max(sine, 1e-150);
    // straight down, any azimuth will do
    const double c = sine > 0 ? -wx * per_sine : 1, s = -wy * per_sine;
    const auto [along, across] = beckmann_visible_slopes(-w.z * per_sine, draw);
    return {alpha_x_ * (c * along - s * across), alpha_y_ * (s * along + c * across), 1};
  }

 private:
  double alpha_x_, alpha_y_;
};

}  // namespace gonio
