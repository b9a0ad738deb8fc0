#include "integrate/scattering/tabulated_lobe.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "base/random.h"
#include "constants.h"
#include "geometry/half_vector.h"
#include "integrate/albedo/directional_albedo.h"
#include "integrate/rule/quadrature.h"
#include "integrate/scattering/half_space.h"
#include "integrate/scattering/walk.h"
#include "refusal.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace gonio {
namespace {

BoundModel tabulated_schlick(const std::string& ndf, double alpha, std::vector<double> f0) {
  return bind_model(ndf + "/smith_" + ndf + ".correlated/schlick",
                    {{"alpha", {alpha}}, {"f0", std::move(f0)}}, 3);
}
BoundModel stretched_schlick(double alpha_x, double alpha_y) {
  return bind_model("ggx_aniso/smith_ggx_aniso.correlated/schlick",
                    {{"alpha_x", {alpha_x}}, {"alpha_y", {alpha_y}}, {"f0", {0.9, 0.6, 0.3}}}, 3);
}
Direction tilted(double mu, double phi) {
  const double sine = std::sqrt((1 - mu) * (1 + mu));
  return {sine * std::cos(phi), sine * std::sin(phi), mu};
}
TabulatedLobe::Value value_between(const TabulatedLobe& lobe,
                                   const Direction& l,
                                   const Direction& v) {
  return lobe.at(angles_between<double>({l.x, l.y, l.z}, {v.x, v.y, v.z}));
}

/// Share of pairs of directions at which a table and a walk of its own differ by more than two of their standard errors.
double share_beyond_errors(const BoundModel& m, int count) {
  const TabulatedLobe lobe(m);
  int beyond = 0;
  for (int i = 0; i < count; ++i) {
    Draws draw(31, i);
    const double mu_v = std::sqrt(draw.uniform()), mu_l = std::sqrt(draw.uniform());
    const Direction v = tilted(mu_v, 6.3 * draw.uniform()), l = tilted(mu_l, 6.3 * draw.uniform());
    const auto walked = walk_value(m, l, v, {17, 1 << 14});
    double square = 0;
    for (std::size_t n = 1; n < walked.order[0].size(); ++n)
      square += walked.order_error[0][n] * walked.order_error[0][n];
    const auto found = value_between(lobe, l, v);
    const double off = found.f[0] - (walked.value[0] - walked.order[0][0]);
    constexpr double black = 1e-4;  // far down Beckmann's tail straight lines are many times too
                                    // high, where nobody sees it
    beyond += std::abs(off) > 2 * std::hypot(found.error[0], std::sqrt(square)) + black;
  }
  return static_cast<double>(beyond) / count;
}

TEST(TabulatedLobe, IsThatOfAWalkWithinItsErrors) {
  std::vector<double> shares;
  for (const double alpha : {0.1, 0.25, 0.6, 1.0})
    for (const double f0 : {0.04, 0.9})
      shares.push_back(share_beyond_errors(tabulated_schlick("ggx", alpha, {f0}), 50));
  shares.push_back(share_beyond_errors(tabulated_schlick("beckmann", 0.6, {0.9}), 50));
  shares.push_back(share_beyond_errors(stretched_schlick(0.6, 0.2), 50));
  EXPECT_LT(std::ranges::max(shares), 0.15);
  const auto n = static_cast<double>(shares.size());
  EXPECT_LT(std::accumulate(shares.begin(), shares.end(), 0.0) / n, 0.05)
      << "over all lobes two errors hold at 19 of 20 pairs";
}

struct TabulatedAlbedo {
  double value, error;  ///< the error as if all of the table were off in the same sense
};
TabulatedAlbedo tabulated_albedo(const TabulatedLobe& lobe, const Direction& v) {
  TabulatedAlbedo sum{0, 0};
  for (const auto& node : cosine_hemisphere(48, 512)) {
    const auto& d = node.direction;
    const auto at = value_between(lobe, {d.x, d.y, d.z}, v);
    sum.value += node.weight * at.f[0];
    sum.error += node.weight * at.error[0];
  }
  return sum;
}

TEST(TabulatedLobe, GivesBackWhatSingleScatteringLosesOfWhiteFacets) {
  for (const double alpha : {0.1, 0.3, 1.0}) {
    const auto m = tabulated_schlick("ggx", alpha, {1});
    const TabulatedLobe lobe(m);
    for (const double mu : {0.1, 0.4, 0.9}) {
      const double lost = 1 - directional_albedo(m, {{mu}})[0].value[0];
      const auto found = tabulated_albedo(lobe, tilted(mu, 0));
      EXPECT_NEAR(found.value, lost, 2 * found.error) << alpha << ' ' << mu;
      EXPECT_LT(found.error, alpha < 0.2 ? 0.1 * lost : 0.05 * lost);
    }
  }
}

TEST(TabulatedLobe, AgreesWithTheHalfSpaceOverRoughnessAndF0) {
  const std::vector<double> mu{0.15, 0.5, 1};
  for (const double roughness : {0.3, 0.5, 0.75, 1.0})
    for (const double f0 : {0.04, 0.5, 0.95}) {
      const auto m = tabulated_schlick("ggx", roughness * roughness, {f0});
      const TabulatedLobe lobe(m);
      const auto exact = half_space(m, mu, 1e-5);
      for (std::size_t i = 0; i < mu.size(); ++i) {
        const double later = exact.at[i].albedo[0] - exact.at[i].order[0][0];
        const auto found = tabulated_albedo(lobe, tilted(mu[i], 0));
        EXPECT_NEAR(found.value, later, 2 * found.error + 1e-5)
            << roughness << ' ' << f0 << ' ' << mu[i];
      }
    }
}

TEST(TabulatedLobe, OfARoundLobeIsTheSameWithLightAndViewInEachOthersPlace) {
  const TabulatedLobe lobe(tabulated_schlick("ggx", 0.4, {0.9}));
  for (int i = 0; i < 20; ++i) {
    Draws draw(5, i);
    const Direction v = tilted(draw.uniform(), 0), l = tilted(draw.uniform(), 6.3 * draw.uniform());
    const auto a = value_between(lobe, l, v), b = value_between(lobe, v, l);
    EXPECT_NEAR(a.f[0], b.f[0], 1e-6 * a.f[0]);
    EXPECT_NEAR(a.error[0], b.error[0], 1e-6 * a.error[0]);
  }
}

TEST(TabulatedLobe, OfAStretchedLobeIsAsSymmetricAsThat) {
  const TabulatedLobe lobe(stretched_schlick(0.5, 0.2));
  EXPECT_TRUE(lobe.anisotropic());
  for (int i = 0; i < 20; ++i) {
    Draws draw(6, i);
    const Direction v = tilted(draw.uniform(), 6.3 * draw.uniform()),
                    l = tilted(draw.uniform(), 6.3 * draw.uniform());
    const double f = value_between(lobe, l, v).f[1];
    for (const auto& [x, y] : {std::pair{-1, 1}, {1, -1}, {-1, -1}})
      EXPECT_NEAR(value_between(lobe, {x * l.x, y * l.y, l.z}, {x * v.x, y * v.y, v.z}).f[1], f,
                  1e-9 * f);
  }
}

/// Channels are followed by the same walks, so that a colour of two is the sum of both.
TEST(TabulatedLobe, AddsTheColoursOfItsChannels) {
  const auto m =
      bind_model("ggx/smith_ggx.correlated/schlick", {{"alpha", {0.5}}, {"f0", {0.9, 0.2}}}, 2);
  const TabulatedLobe mixed(m, std::array<ColourOfChannel, 2>{{{0.7, 0, 1}, {0.3, 1, 0}}});
  const Direction v = tilted(0.6, 0), l = tilted(0.4, 2.5);
  const auto f = value_between(mixed, l, v).f;
  EXPECT_NEAR(f[0], 0.7 * f[2] + 0.3 * f[1], 1e-6 * f[0]);
  EXPECT_GT(f[2], 4 * f[1]);
  // a grey one has all of it in each
  const TabulatedLobe grey(tabulated_schlick("ggx", 0.5, {0.9}));
  const auto g = value_between(grey, l, v);
  EXPECT_EQ(g.f[0], g.f[2]);
  EXPECT_NEAR(g.f[0], f[2], 4 * g.error[0]);
}

TEST(TabulatedLobe, HasTheSameBitsWhateverTheThreadsAndOthersForAnotherSeed) {
  const auto m = tabulated_schlick("ggx", 0.4, {0.9});
  const Direction v = tilted(0.6, 0), l = tilted(0.4, 2.5);
  const auto of = [&](std::uint64_t seed) {
    return value_between(TabulatedLobe(m, red_green_blue, {seed}), l, v).f[0];
  };
  const double several = of(1);
  EXPECT_NE(several, of(2));
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(several, of(1));
}

TEST(TabulatedLobe, RefusesWhatNoWalkIsKnownOf) {
  EXPECT_HAS(
      test::refusal(
          [] { const TabulatedLobe lobe(bind_model("gtr/smith_gtr.correlated/schlick", {}, 3)); },
          Exit::usage),
      "no surface to walk on");
}

}  // namespace
}  // namespace gonio
