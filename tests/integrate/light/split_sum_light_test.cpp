#include "integrate/light/split_sum_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "brdf/catalogue/registry.h"
#include "brdf/model/evaluate.h"
#include "constants.h"
#include "geometry/half_difference.h"
#include "geometry/sampling.h"
#include "integrate/lights.h"
#include "integrate/rule/quadrature.h"
#include "integrate/rule/slopes.h"
#include "support.h"

namespace gonio {
namespace {

using test::ln2;
using test::pi;
constexpr const char* correlated = "smith_ggx.correlated";

/// As lit_views() has the i-th of them.
Frame surface_of(std::size_t i, std::size_t views) {
  return Frame(spiral_direction(i, views),
               static_cast<double>(i) * std::numbers::phi * 2 * std::numbers::pi);
}

TEST(SplitSumLight, UnderEvenLightIsExact) {
  const SummedEnvironment even(test::gradient(4, {0, 0, 0}));
  for (const double roughness : {0.03, 0.3, 1.0})
    for (const double nov : {0.1, 0.6, 1.0}) {
      const auto views = lit_views(even, correlated, roughness, nov, 2, {1e-3, 1'000'000});
      for (const auto& v : views) {
        EXPECT_LE(v.error, 2e-3);
        EXPECT_NEAR(v.prefiltered[1], 1, v.error);
        for (const double f0 : {0.04, 0.3, 1.0})
          EXPECT_NEAR(v.exact(f0)[1] / (f0 * v.a + v.b), 1, v.error + 1e-6);
      }
      const auto e = split_sum_light_error(views, 0.04);
      EXPECT_LE(e.max, 2e-3);
    }
}

/// The fifth of six views is mirrored to −z, where all texels of a row meet.
TEST(SplitSumLight, SeesThePolesOfAFineMap) {
  const SummedEnvironment even(test::gradient(256, {0, 0, 0}));
  EXPECT_NEAR(surface_of(4, 6).outside({-std::sqrt(0.75), 0, 0.5}).z, -1, 1e-12);
  for (const double roughness : {0.1, 0.3}) {
    const auto v = lit_views(even, correlated, roughness, 0.5, 6)[4];
    EXPECT_NEAR(v.exact(1)[0] / (v.a + v.b), 1, v.error / 2);
    EXPECT_NEAR(v.prefiltered[0], 1, v.error / 2);
  }
}

/// At α = 1, D = 1/π and V = 1/(2 (NoL + NoV)): from n, with L = 1 + d·ω and F = 1,
///
///   exact = 1 − ln 2 + (ln 2 − ½) d·n,   P = 1 + ⅔ d·n
TEST(SplitSumLight, UnderAGradientIsTheClosedForm) {
  const Direction d = direction(0.4, 1);
  const SummedEnvironment light(test::gradient(256, d));
  const auto views = lit_views(light, correlated, 1, 1, 3, {2e-4, 1'000'000});
  for (std::size_t i = 0; i < views.size(); ++i) {
    const double dn = dot(d, spiral_direction(i, views.size()));
    EXPECT_NEAR(views[i].exact(1)[0], 1 - ln2 + (ln2 - 0.5) * dn, 4e-4);
    EXPECT_NEAR(views[i].exact(1)[2], 1 - ln2 - (ln2 - 0.5) * dn, 4e-4);
    EXPECT_NEAR(views[i].prefiltered[0], 1 + 2 * dn / 3, 6e-4);
    EXPECT_NEAR(views[i].exact(1)[1], 1 - ln2, 2e-4);
  }
}

TEST(SplitSumLight, OnANearMirrorBothAreTheTexelSeen) {
  Environment map = test::random_texels(8, 5);
  const SummedEnvironment light(map);
  constexpr std::size_t n = 12;
  const auto views = lit_views(light, correlated, 0.01, 0.5, n);
  std::size_t inside = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Direction r = surface_of(i, n).outside({-std::sqrt(0.75), 0, 0.5});
    const double y = theta_of(r) / pi * 8, x = (1 - phi_of(r) / pi) * 8;
    const auto edge = [](double v) { return std::abs(v - std::round(v)); };
    if (edge(x) < 0.05 || edge(y) < 0.05) continue;
    ++inside;
    EXPECT_NEAR(views[i].exact(1)[0] / map(r)[0], 1, 0.02);
    EXPECT_NEAR(views[i].prefiltered[0] / map(r)[0], 1, 0.02);
  }
  EXPECT_GE(inside, 5U);
}

/// The same integrals by half vectors drawn from D NoH.
TEST(SplitSumLight, AgreesWithImportanceSampling) {
  const Environment map = test::random_texels(16, 9);
  const SummedEnvironment light(map);
  constexpr double roughness = 0.6, nov = 0.4;
  constexpr std::uint32_t n = 1 << 18;
  const auto model = two_interfaces(correlated, roughness);
  const auto views = lit_views(light, correlated, roughness, nov, 3);
  const Direction v{std::sqrt(1 - nov * nov), 0, nov};
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Frame surface = surface_of(i, views.size());
    std::vector<Angles<double>> at;
    std::vector<Direction> l;
    for (std::uint32_t k = 0; k < n; ++k) {
      const auto [u, w] = hammersley(k, n);
      const double t = roughness * roughness * std::sqrt(w / (1 - w)), c = 1 / std::sqrt(1 + t * t);
      const Direction h{t * c * std::cos(2 * pi * u), t * c * std::sin(2 * pi * u), c};
      const double voh = dot(v, h);
      const Direction m{2 * voh * h.x - v.x, 2 * voh * h.y - v.y, 2 * voh * h.z - v.z};
      if (!(m.z > 0)) continue;
      l.push_back(m);
      at.push_back(angles({m, v}));
    }
    const auto f = evaluate(model, at);
    const auto d = [&](double sin2) {  // GGX: what was drawn from
      const double a2 = std::pow(roughness, 4), c2 = 1 - sin2;
      return a2 / (pi * std::pow(c2 * a2 + sin2, 2));
    };
    double b = 0, e = 0;
    for (std::size_t k = 0; k < l.size(); ++k) {
      const double weight = l[k].z * 4 * at[k].voh / (d(at[k].sin2_theta_h) * at[k].noh) / n;
      const double red = map(surface.outside(l[k]))[0];
      b += weight * f[0][k] * red;
      e += weight * f[1][k] * red;
    }
    EXPECT_NEAR(views[i].exact(0)[0] / b, 1, 0.01);
    EXPECT_NEAR(views[i].exact(1)[0] / e, 1, 0.01);
  }
}

TEST(SplitSumLight, ItsErrorIsTrue) {
  const SummedEnvironment light(test::random_texels(16, 4));
  for (const double roughness : {0.2, 0.8})
    for (const double nov : {0.15, 0.7}) {
      const auto truth = lit_views(light, correlated, roughness, nov, 3, {3e-4, 4'000'000});
      for (const double goal : {0.03, 3e-3}) {
        const auto found = lit_views(light, correlated, roughness, nov, 3, {goal, 1'000'000});
        for (std::size_t i = 0; i < 3; ++i)
          for (std::size_t c = 0; c < 3; ++c) {
            const double allowed = found[i].error + truth[i].error;
            for (const std::size_t f : {0, 1})
              EXPECT_NEAR(found[i].exact_at[f][c] / truth[i].exact_at[f][c], 1, allowed);
            EXPECT_NEAR(found[i].prefiltered[c] / truth[i].prefiltered[c], 1, allowed);
          }
      }
    }
}

TEST(SplitSumLight, InTheDarkHasNoErrorThatIsKnown) {
  const auto lit = [](const Environment& map) {
    const SummedEnvironment light(map);
    return split_sum_light_error(lit_views(light, correlated, 0.1, 0.9, 8, {0.1, 20'000}), 0.04);
  };
  Environment map{8, 4, std::vector<std::array<float, 3>>(32)};
  const auto dark = lit(map);
  EXPECT_EQ(dark.views, 0U);
  for (const double v : {dark.rms, dark.max, dark.bias, dark.of_mean, dark.truth})
    EXPECT_TRUE(std::isnan(v));
  for (std::size_t i = 0; i < 8; ++i) map.radiance[i] = {1, 1, 1};  // round the zenith
  const auto half = lit(map);
  EXPECT_GT(half.views, 0U);
  EXPECT_LT(half.views, 8U);
  EXPECT_TRUE(std::isfinite(half.rms));
}

TEST(SplitSumLight, PrefilterWeightIsItsIntegral) {
  EXPECT_NEAR(prefilter_weight(1), 0.25, 1e-12);
  EXPECT_NEAR(prefilter_weight(1 - 1e-4), prefilter_weight(1 - 1e-4 + 1e-9), 1e-9);
  EXPECT_NEAR(prefilter_weight(1e-4), 1, 1e-6);
  for (const double alpha : {0.2, 0.5, 0.9}) {
    double sum = 0;
    AngleBlock x(false);
    const auto c = x.resize(1);
    for (const auto& node : cosine_hemisphere(400, 1)) {
      const auto a = angles({node.direction, {}});
      const double columns[] = {a.nol, a.nov, a.noh, a.voh, a.sin2_theta_h};
      for (std::size_t k = 0; k < 5; ++k) c[k][0] = columns[k];
      term_values(find_term("ndf.ggx"), {{alpha}}, x.block(), x.extra(0));
      sum += node.weight * x.extra(0)[0] / 4;
    }
    EXPECT_NEAR(prefilter_weight(alpha), sum, 1e-5) << alpha;
  }
}

TEST(SplitSumLight, UnderRealLightIsOffByMoreThanTheTruthIs) {
  GONIO_NEEDS_SHARED(path, "data/env/city.exr");
  const SummedEnvironment light(read_environment(path));
  const auto smooth = split_sum_light_error(lit_views(light, correlated, 0.3, 0.8, 6), 0.04);
  const auto grazing = split_sum_light_error(lit_views(light, correlated, 0.6, 0.2, 6), 0.04);
  for (const auto& e : {smooth, grazing}) {
    EXPECT_LE(e.truth, 2e-3);
    EXPECT_GT(e.rms, 10 * e.truth);
    EXPECT_LE(e.rms, e.max);
  }
  EXPECT_GT(grazing.rms, smooth.rms);
}

}  // namespace
}  // namespace gonio
