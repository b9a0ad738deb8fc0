#include "integrate/scattering/walk.h"

#include <cmath>

#include "base/error.h"
#include "brdf/catalogue/registry.h"
#include "brdf/model/evaluate.h"
#include "constants.h"
#include "geometry/half_difference.h"
#include "integrate/albedo/directional_albedo.h"
#include "integrate/rule/quadrature.h"
#include "integrate/scattering/half_space.h"

#include <tbb/global_control.h>

namespace gonio {
namespace {

using test::pi;
constexpr double walk_cosines[] = {0.02, 0.3, 1};
const std::string lobes[] = {"ggx", "beckmann"};

std::string spec(const std::string& ndf, const std::string& fresnel = "schlick") {
  return ndf + "/smith_" + ndf + ".correlated/" + fresnel;
}
BoundModel grey(const std::string& ndf, double alpha, double f0) {
  return bind_model(spec(ndf), {{"alpha", {alpha}}, {"f0", {f0}}}, 1);
}
BoundModel stretched(const std::string& ndf, double alpha_x, double alpha_y, double f0) {
  return bind_model(spec(ndf + "_aniso"),
                    {{"alpha_x", {alpha_x}}, {"alpha_y", {alpha_y}}, {"f0", {f0}}}, 1);
}
Scattered scattered_at(const BoundModel& m, double mu, const WalkGoal& goal, double phi = 0) {
  return walk(m, {&mu, 1}, phi, goal)[0];
}
double sum(const std::vector<double>& x) {
  double s = 0;
  for (const double v : x) s += v;
  return s;
}

/// Of n walks none does what one in n/9 does, with a chance of e^-9.
void expect_order_one(const BoundModel& m, double phi = 0) {
  const WalkGoal goal{3, 1 << 14};
  const auto walked = walk(m, walk_cosines, phi, goal);
  const auto exact = directional_albedo(m, walk_cosines, phi);
  for (std::size_t i = 0; i < walked.size(); ++i)
    for (std::size_t c = 0; c < m.model.channels; ++c)
      EXPECT_NEAR(walked[i].order[c][0], exact[i].value[c],
                  4 * walked[i].order_error[c][0] + 9.0 / static_cast<double>(goal.walks))
          << to_text(m.model.spec) << " channel " << c << " mu " << walk_cosines[i];
}

TEST(Walk, OfOneBounceIsSingleScattering) {
  for (const auto& ndf : lobes)
    for (const double alpha : {1e-4, 0.01, 0.2, 0.6, 1.0})
      for (const double f0 : {0.04, 1.0}) expect_order_one(grey(ndf, alpha, f0));
}

TEST(Walk, OfOneBounceOnAStretchedSurfaceIsSingleScattering) {
  for (const auto& ndf : lobes)
    for (const double phi : {0.0, 0.5, 1.3})
      for (const auto& [x, y] : {std::pair{0.2, 0.8}, {1.5, 0.5}, {0.01, 1.0}})
        expect_order_one(stretched(ndf, x, y, 0.5), phi);
}

TEST(Walk, WeightsItsFirstBounceByAnyFresnelOfTheCatalogue) {
  for (const auto& term : catalogue())
    if (role_of(term.about->id) == Role::fresnel)
      expect_order_one(
          bind_model(spec("ggx", std::string(short_id(term.about->id))), {{"alpha", {0.7}}}, 1));
  expect_order_one(bind_model(spec("ggx", "conductor"), {{"alpha", {0.7}}, {"metal", {}, "Au"}}));
}

/// D = 1/π and Λ = (1/μ − 1)/2 there: of light from above ∫ o/(1 + o) do leaves after one facet, after two
/// ∫ o/(1 + o) (ln(1 + o) + o ln(1 + 1/o)) do.
TEST(Walk, OnRoughGgxFromAboveHasTheOrdersThatCanBeHadByHand) {
  double second = 0;
  for (const auto& q : gauss_legendre(40)) {  // o = q²
    const double o = q.x * q.x;
    second += q.weight * 2 * q.x * o / (1 + o) *
              (std::log1p(o) + o * (std::log1p(o) - 2 * std::log(q.x)));
  }
  const auto s = scattered_at(grey("ggx", 1, 1), 1, {1, 1 << 18});
  EXPECT_NEAR(s.order[0][0], 1 - std::log(2.0), 4 * s.order_error[0][0]);
  EXPECT_NEAR(s.order[0][1], second, 4 * s.order_error[0][1]);
  EXPECT_LT(s.order_error[0][1], 1e-3);
}

TEST(Walk, OnWhiteFacetsLosesNothing) {
  for (const auto& ndf : lobes)
    for (const double alpha : {1e-4, 0.1, 1.0})
      for (const double mu : {1e-3, 0.5, 1.0}) {
        const auto s = scattered_at(grey(ndf, alpha, 1), mu, {1, 1 << 14});
        EXPECT_EQ(s.rest[0], 0);
        EXPECT_EQ(s.albedo[0], 1);
        EXPECT_EQ(s.error[0], 0);
        EXPECT_NEAR(sum(s.order[0]), 1, 1e-12);
      }
  const auto s = scattered_at(stretched("beckmann", 2, 0.1, 1), 0.4, {1, 1 << 14}, 0.7);
  EXPECT_EQ(s.albedo[0], 1);
}

TEST(Walk, SaysWhatWasInsideWhereItWasCutOff) {
  const auto white = scattered_at(grey("ggx", 1, 1), 1, {1, 1 << 15, 0, 2});
  EXPECT_GT(white.rest[0], 0.2);
  EXPECT_NEAR(white.albedo[0] + white.rest[0], 1, 1e-12);
  EXPECT_EQ(white.order[0].size(), 2U);

  const auto cut = scattered_at(grey("ggx", 1, 0.5), 1, {1, 1 << 16, 0, 2});
  const auto whole = scattered_at(grey("ggx", 1, 0.5), 1, {1, 1 << 16});
  const double error = 4 * std::hypot(cut.error[0], whole.error[0]);
  EXPECT_LT(cut.albedo[0], whole.albedo[0] - error);
  EXPECT_GT(cut.albedo[0] + cut.rest[0], whole.albedo[0] + error);
  EXPECT_EQ(whole.rest[0], 0);
}

TEST(Walk, OfItsOrdersIsTheSum) {
  const auto m = bind_model(spec("ggx"), {{"alpha", {0.9}}, {"f0", {0.1, 0.5, 0.9}}});
  const auto s = scattered_at(m, 0.6, {1, 1 << 14});
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(sum(s.order[c]), s.albedo[c], 1e-12);
  EXPECT_LT(s.albedo[0], s.albedo[1]);
  EXPECT_LT(s.albedo[1], s.albedo[2]);
  // the same walks in grey
  const auto one = scattered_at(grey("ggx", 0.9, 0.5), 0.6, {1, 1 << 14});
  EXPECT_EQ(one.albedo[0], s.albedo[1]);
  EXPECT_EQ(one.error[0], s.error[1]);
}

TEST(Walk, HasTheSameBitsWhateverTheThreads) {
  const auto m = bind_model(spec("beckmann"), {{"alpha", {0.7}}, {"f0", {0.3, 0.5, 0.9}}});
  const auto by = [&](std::uint64_t seed) {
    return walk(m, walk_cosines, 0, {seed, 5 * (1 << 14) + 77});
  };
  const auto several = by(9), other = by(10);
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 1);
  const auto one = by(9);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].albedo, several[i].albedo);
    EXPECT_EQ(one[i].error, several[i].error);
    EXPECT_EQ(one[i].order, several[i].order);
    EXPECT_EQ(one[i].bounces, several[i].bounces);
    EXPECT_NE(one[i].albedo, other[i].albedo);
  }
}

TEST(Walk, HasErrorsAsItSays) {
  const auto m = grey("ggx", 0.8, 0.5);
  const double truth = directional_albedo(m, {{0.4}})[0].value[0];
  constexpr int seeds = 100;
  double first = 0, mean = 0, mean2 = 0, error2 = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    const auto s = scattered_at(m, 0.4, {static_cast<std::uint64_t>(seed), 2048});
    const double z = (s.order[0][0] - truth) / s.order_error[0][0];
    first += z * z / seeds;
    mean += s.albedo[0] / seeds;
    mean2 += s.albedo[0] * s.albedo[0] / seeds;
    error2 += s.error[0] * s.error[0] / seeds;
  }
  // χ² of 100 over 100 lies there but for one in 10⁴
  EXPECT_GT(first, 0.55);
  EXPECT_LT(first, 1.6);
  EXPECT_GT((mean2 - mean * mean) / error2, 0.55);
  EXPECT_LT((mean2 - mean * mean) / error2, 1.6);
}

TEST(Walk, StopsWhereItsErrorIsAsAsked) {
  const auto m = bind_model(spec("ggx"), {{"alpha", {0.5}}, {"f0", {0.2, 0.9}}}, 2);
  const WalkGoal goal{1, 10'000'000, 7e-4};
  const auto s = scattered_at(m, 0.7, goal);
  for (const double e : s.error) {
    EXPECT_LE(e, goal.error);
    EXPECT_GT(e, 0);
  }
  EXPECT_LT(s.bounces, goal.walks / 10);
}

TEST(Walk, OnAStretchedSurfaceOfEqualWidthsIsThatOnAnIsotropicOne) {
  for (const auto& ndf : lobes) {
    const auto a = scattered_at(stretched(ndf, 0.6, 0.6, 0.5), 0.4, {1, 1 << 15}, 0.8);
    const auto b = scattered_at(grey(ndf, 0.6, 0.5), 0.4, {2, 1 << 15});
    EXPECT_NEAR(a.albedo[0], b.albedo[0], 4 * std::hypot(a.error[0], b.error[0]));
  }
}

TEST(Walk, TurnsWithItsSurface) {
  for (const auto& ndf : lobes) {
    const auto a = scattered_at(stretched(ndf, 0.3, 0.9, 0.5), 0.4, {1, 1 << 15}, 0.3);
    const auto b = scattered_at(stretched(ndf, 0.9, 0.3, 0.5), 0.4, {2, 1 << 15}, 0.3 + pi / 2);
    EXPECT_NEAR(a.albedo[0], b.albedo[0], 4 * std::hypot(a.error[0], b.error[0]));
  }
}

TEST(Walk, AddsLobesAndNothingBelow) {
  const auto both =
      bind_model("lambert+" + spec("ggx") + "+" + spec("beckmann"),
                 {{"alpha", {0.5}}, {"f0", {0.3}}, {"alpha_2", {0.9}}, {"f0_2", {0.2}}}, 1);
  const auto s = scattered_at(both, 0.5, {1, 1 << 15});
  const auto a = scattered_at(grey("ggx", 0.5, 0.3), 0.5, {2, 1 << 15});
  const auto b = scattered_at(grey("beckmann", 0.9, 0.2), 0.5, {3, 1 << 15});
  EXPECT_NEAR(s.albedo[0], a.albedo[0] + b.albedo[0], 6 * s.error[0]);
  EXPECT_NEAR(s.error[0], std::hypot(a.error[0], b.error[0]), 0.1 * s.error[0]);
}

TEST(Walk, RefusesWhatItCannotWalk) {
  const auto m = grey("ggx", 0.5, 1);
  for (const double mu : {0.0, -0.5, 1.5, std::nan("")})
    EXPECT_THROW(scattered_at(m, mu, {}), Error) << mu;
  for (const double phi : {std::nan(""), HUGE_VAL})
    EXPECT_THROW(scattered_at(m, 0.5, {}, phi), Error) << phi;
  EXPECT_THROW(scattered_at(m, 0.5, {1, 1}), Error);
  EXPECT_THROW(scattered_at(m, 0.5, {1, 100, 0, 0}), Error);
  EXPECT_THROW(scattered_at(bind_model("ggx/smith_ggx.separable/schlick", {}), 0.5, {}), Error);
  EXPECT_THROW(walk_value(m, {0, 0, -1}, {0, 0, 1}), Error);
  EXPECT_THROW(walk_value(m, {0, 0, 1}, {0, 0, 0.5}), Error);
}

TEST(WalkAverage, IsTheHalfSpacesWithinItsErrorAndTheSameForASeed) {
  const auto model = grey("ggx", 0.7, 0.6);
  const auto solved = half_space(model, {}).average;
  const WalkGoal goal{1, 100'000};
  const auto walked = walk_average(model, goal);
  EXPECT_NEAR(walked.albedo[0], solved.albedo[0], 4 * walked.error[0]);
  EXPECT_LT(walked.error[0], 2e-3);
  EXPECT_NEAR(sum(walked.order[0]), walked.albedo[0], 1e-12);
  for (std::size_t n = 0; n < 4; ++n)
    EXPECT_NEAR(walked.order[0][n], solved.order[0][n], 4 * walked.order_error[0][n]) << n;
  EXPECT_EQ(walk_average(model, goal).albedo[0], walked.albedo[0]);
  EXPECT_GT(walk_average(model, {1, 2}).albedo[0], 0);  // the fewest walks
}

/// A furrow as narrow as a mirror along, and as rough as can be across: what azimuths differ most in.
TEST(WalkAverage, OfAStretchedSurfaceIsOverAllAzimuths) {
  const auto model = stretched("ggx", 3e-4, 1, 0.04);
  const auto walked = walk_average(model, {1, 500'000});
  const auto exact = hemispherical_albedo(model, {2e-6, 1'000'000});
  EXPECT_LT(walked.order_error[0][0], 2e-4);
  EXPECT_NEAR(walked.order[0][0], exact.value[0], 4 * walked.order_error[0][0] + exact.error);
}

/// Pairs of directions: mirror-like, backwards, grazing, across.
const DirectionPair direction_pairs[] = {{direction(0.5, pi), direction(0.6, 0)},
                                         {direction(0.9, 0.1), direction(0.8, 0)},
                                         {direction(1.5, 2), direction(0.3, 0.7)},
                                         {direction(0.2, 1), direction(1.2, 2.5)}};

TEST(WalkValue, OfOneBounceIsTheModel) {
  for (const auto& m : {grey("ggx", 0.4, 0.3), grey("beckmann", 0.8, 1),
                        stretched("ggx", 0.8, 0.3, 0.5), stretched("beckmann", 0.4, 1, 0.5)})
    for (const auto& p : direction_pairs) {
      const FrameAngles<double> angles[] = {frame_angles(p)};
      const double exact = evaluate(m, std::span<const FrameAngles<double>>(angles))[0][0];
      const auto value = walk_value(m, p.wi, p.wo, {1, 1 << 13});
      EXPECT_NEAR(value.order[0][0], exact, 4 * value.order_error[0][0] + 1e-12 * exact)
          << to_text(m.model.spec);
    }
}

/// Of orders that no walk came to there is nothing.
double at_order(const std::vector<double>& orders, std::size_t n) {
  return n < orders.size() ? orders[n] : 0;
}

TEST(WalkValue, IsReciprocalOrderByOrder) {
  for (const auto& m : {grey("ggx", 0.9, 0.8), grey("beckmann", 1, 1),
                        stretched("ggx", 1.2, 0.4, 0.7), stretched("beckmann", 0.5, 1.5, 1)})
    for (const auto& p : direction_pairs) {
      const auto there = walk_value(m, p.wi, p.wo, {1, 1 << 14});
      const auto back = walk_value(m, p.wo, p.wi, {2, 1 << 14});
      for (std::size_t n = 1; n < 4; ++n) {
        const double value = at_order(there.order[0], n), other = at_order(back.order[0], n);
        const double error =
            std::hypot(at_order(there.order_error[0], n), at_order(back.order_error[0], n));
        EXPECT_NEAR(value, other, 4.5 * error) << to_text(m.model.spec) << " " << n;
        if (n == 1) {
          EXPECT_LT(error, 0.15 * value + 5e-4) << to_text(m.model.spec);
        }
      }
    }
}

/// ∫ f NoL dω order by order, two ways that share nothing but the facets.
TEST(WalkValue, IntegratesToWhatLeaves) {
  for (const auto& ndf : lobes) {
    const auto m = grey(ndf, 1, 0.8);
    const auto whole = scattered_at(m, 0.6, {1, 1 << 16});
    std::vector<double> sums(3), variances(3);
    std::uint64_t seed = 1;
    for (const auto& node : gauss_legendre(8))
      for (int k = 0; k < 8; ++k) {
        const double theta = node.x * pi / 2;
        const Direction l = direction(theta, (k + 0.5) * pi / 8);
        const double weight = node.weight * pi / 2 * 2 * pi / 8 * l.z * std::sin(theta);
        const auto value = walk_value(m, l, direction(std::acos(0.6), 0), {++seed, 1 << 11});
        for (std::size_t n = 0; n < sums.size(); ++n) {
          sums[n] += weight * at_order(value.order[0], n);
          variances[n] += std::pow(weight * at_order(value.order_error[0], n), 2);
        }
      }
    for (std::size_t n = 0; n < sums.size(); ++n) {
      const double error = std::hypot(std::sqrt(variances[n]), whole.order_error[0][n]);
      EXPECT_NEAR(sums[n], whole.order[0][n], 4 * error + 1e-3) << n;
      EXPECT_LT(error, 0.003);
    }
  }
}

}  // namespace
}  // namespace gonio
