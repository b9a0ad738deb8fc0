#include "integrate/scattering/visible_facets.h"

#include <array>

#include "constants.h"

namespace gonio {
namespace {

using test::pi;
constexpr double alpha_x = 0.7, alpha_y = 0.3;

/// Moments of the facets that light along w meets: of the normal m, its x, z and (w·m)².
using Moments = std::array<double, 3>;
Moments moments(const Direction& w, const Facet& m) {
  const double length = std::sqrt(m.x * m.x + m.y * m.y + m.z * m.z);
  const double along = (w.x * m.x + w.y * m.y + w.z * m.z) / length;
  return {m.x / length, m.z / length, along * along};
}

/// By the midpoint rule over slopes of the unit distribution, ρ(t) and azimuth: density(t) is ρ P(ρ) dρ/dt.
struct Expected {
  Moments moments{};
  double area = 0;  ///< σ(−w)
};
Expected expected(const Direction& w, double t_end, auto&& rho, auto&& density) {
  constexpr int n = 600;
  Expected e;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      const double t = t_end * (i + 0.5) / n, psi = 2 * pi * (k + 0.5) / n;
      const Facet m{alpha_x * rho(t) * std::cos(psi), alpha_y * rho(t) * std::sin(psi), 1};
      const double seen = std::max(0.0, -(w.x * m.x + w.y * m.y + w.z * m.z));
      const double weight = seen * density(t) * t_end / n * 2 * pi / n;
      e.area += weight;
      const auto of_m = moments(w, m);
      for (std::size_t j = 0; j < of_m.size(); ++j) e.moments[j] += weight * of_m[j];
    }
  for (double& m : e.moments) m /= e.area;
  return e;
}

/// Down, along the surface, upwards, almost straight up.
const Direction flights[] = {direction(pi, 0),     direction(2.5, 1), direction(1.6, 2.2),
                             direction(pi / 2, 0), direction(1.3, 4), direction(0.6, 5),
                             direction(0.3, 0.3)};

template <class Facets>
void expect_drawn(const Facets& facets, const Direction& w, const Expected& e) {
  constexpr int n = 40'000;
  Draws draw(5);
  Moments sum{}, square{};
  for (int i = 0; i < n; ++i) {
    const Facet m = facets(w, e.area, draw);
    EXPECT_GT(m.z, 0);
    EXPECT_LE(w.x * m.x + w.y * m.y + w.z * m.z, 1e-12);
    const auto of_m = moments(w, m);
    for (std::size_t j = 0; j < of_m.size(); ++j) {
      sum[j] += of_m[j] / n;
      square[j] += of_m[j] * of_m[j] / n;
    }
  }
  for (std::size_t j = 0; j < sum.size(); ++j)
    EXPECT_NEAR(sum[j], e.moments[j], 4 * std::sqrt((square[j] - sum[j] * sum[j]) / n) + 1e-4)
        << "moment " << j << " of flight " << w.x << " " << w.y << " " << w.z;
}

TEST(GgxFacets, AreDrawnAsLightFromAboveAndBelowMeetsThem) {
  for (const auto& w : flights)  // ρ = tan t, P = 1/(π (1 + ρ²)²)
    expect_drawn(GgxFacets(alpha_x, alpha_y), w,
                 expected(
                     w, pi / 2, [](double t) { return std::tan(t); },
                     [](double t) { return std::sin(t) * std::cos(t) / pi; }));
}

TEST(BeckmannFacets, AreDrawnAsLightFromAboveAndBelowMeetsThem) {
  for (const auto& w : flights)
    expect_drawn(
        BeckmannFacets(alpha_x, alpha_y), w,
        expected(
            w, 7, [](double t) { return t; }, [](double t) { return t * std::exp(-t * t) / pi; }));
}

TEST(BeckmannFacets, HaveSlopesOfTheirDensityAtEveryCotangent) {
  for (const double a : {-30.0, -3.0, -1.0, 0.0, 0.2499, 0.2501, 1.0, 5.0, 300.0}) {
    constexpr int n = 40'000;
    double mass = 0, mean = 0, mean2 = 0;  // of t = a + x
    const double first = std::max(0.0, a - 7), last = std::max(a + 7, 7 / (1 - std::min(a, 0.0)));
    for (int i = 0; i < n; ++i) {
      const double t = first + (last - first) * (i + 0.5) / n;
      const double weight = t * std::exp(-(t - a) * (t - a) + std::min(a, 0.0) * a);
      mass += weight;
      mean += weight * t;
      mean2 += weight * t * t;
    }
    mean /= mass;
    mean2 /= mass;
    Draws draw(7);
    double sum = 0;
    for (int i = 0; i < n; ++i) {
      const double t = a + beckmann_visible_slopes(a, draw)[0];
      ASSERT_GE(t, 0);
      sum += t / n;
    }
    EXPECT_NEAR(sum, mean, 4 * std::sqrt((mean2 - mean * mean) / n) + 1e-12) << a;
  }
}

}  // namespace
}  // namespace gonio
