#include "integrate/scattering/half_space.h"

#include <cmath>

#include "base/error.h"
#include "integrate/albedo/directional_albedo.h"
#include "integrate/rule/quadrature.h"
#include "integrate/scattering/walk.h"
#include "refusal.h"

#include <tbb/global_control.h>

namespace gonio {
namespace {

constexpr double half_space_cosines[] = {0.001, 0.01, 0.05, 0.2, 0.5, 0.8, 1};

BoundModel lobe(const std::string& ndf, double alpha, double f0) {
  return bind_model(ndf + "/smith_" + ndf + ".correlated/schlick",
                    {{"alpha", {alpha}}, {"f0", {f0}}}, 1);
}
BoundModel conductor(double alpha) {
  return bind_model("ggx/smith_ggx.correlated/conductor",
                    {{"alpha", {alpha}}, {"eta", {0.2}}, {"k", {3}}}, 1);
}

void expect_furnace(const std::string& ndf, double alpha) {
  const auto h = half_space(lobe(ndf, alpha, 1), half_space_cosines);
  for (std::size_t i = 0; i < std::size(half_space_cosines); ++i) {
    EXPECT_NEAR(h.at[i].albedo[0], 1, h.at[i].error[0])
        << ndf << alpha << " " << half_space_cosines[i];
    EXPECT_LE(h.at[i].error[0], 1e-5);
  }
  EXPECT_NEAR(h.average.albedo[0], 1, h.average.error[0]);
  EXPECT_LE(h.average.error[0], 1e-5);
}

TEST(HalfSpace, OfGgxGivesBackAllThatComesInWhereFIsOne) {
  for (const double alpha : {1e-4, 0.01, 0.1, 1.0}) expect_furnace("ggx", alpha);
}

TEST(HalfSpace, OfBeckmannGivesBackAllThatComesInWhereFIsOne) {
  for (const double alpha : {0.02, 0.5}) expect_furnace("beckmann", alpha);
}

/// D = 1/π and Λ = (1/μ − 1)/2, so that f₁ = 1/(o + i) and the next order under its integrals are logarithms.
TEST(HalfSpace, OfWhiteGgxAtAlphaOneHasTheTwoOrdersThatCanBeHadByHand) {
  const auto h = half_space(lobe("ggx", 1, 1), half_space_cosines, 1e-8);
  for (std::size_t i = 0; i < std::size(half_space_cosines); ++i) {
    const double mu = half_space_cosines[i];
    double second = 0;
    for (const auto& q : gauss_legendre(60)) {  // o = q⁴
      const double o = q.x * q.x * q.x * q.x;
      second += q.weight * 4 * q.x * q.x * q.x * o / (o + mu) *
                (mu * std::log1p(o / mu) + o * std::log1p(mu / o));
    }
    EXPECT_NEAR(h.at[i].order[0][0], 1 - mu * std::log(1 + 1 / mu), 2e-9);
    EXPECT_NEAR(h.at[i].order[0][1], second, 2e-9);
  }
}

TEST(HalfSpace, ItsFirstOrderIsDirectionalAlbedo) {
  for (const auto& m : {lobe("beckmann", 0.4, 0.04), conductor(0.7)}) {
    const auto single = directional_albedo(m, half_space_cosines, 0, {1e-7, 1'000'000});
    const auto h = half_space(m, half_space_cosines);
    for (std::size_t i = 0; i < std::size(half_space_cosines); ++i)
      EXPECT_NEAR(h.at[i].order[0][0], single[i].value[0], 1.1e-6);
    EXPECT_NEAR(h.average.order[0][0], hemispherical_albedo(m, {1e-6, 1'000'000}).value[0], 2e-6);
  }
}

TEST(HalfSpace, ItsBoundIsTrueHoweverLittleIsAskedFor) {
  for (const double goal : {0.03, 1.0, 200.0}) {
    const auto h = half_space(lobe("ggx", 1, 1), half_space_cosines, goal);
    for (const auto& s : h.at) EXPECT_NEAR(s.albedo[0], 1, s.error[0]) << goal;
    EXPECT_NEAR(h.average.albedo[0], 1, h.average.error[0]) << goal;
  }
}

/// All of whose first order is less than what is asked for.
TEST(HalfSpace, KnowsASecondOrderOfWhatIsNearlyBlack) {
  const auto m =
      bind_model("ggx/smith_ggx.correlated/constant", {{"alpha", {1}}, {"f0", {1e-4}}}, 1);
  const auto h = half_space(m, half_space_cosines, 0.1);
  for (const auto& s : h.at) {
    ASSERT_GE(s.order[0].size(), 2U);
    EXPECT_GT(s.order[0][1], 0);
  }
}

TEST(HalfSpace, ItsBoundIsTrueAndWhatWasAskedFor) {
  for (const auto& m : {lobe("ggx", 0.05, 0.5), conductor(0.5)}) {
    const auto truth = half_space(m, half_space_cosines, 3e-7);
    ASSERT_LE(truth.average.error[0], 3e-7);
    for (const double goal : {1e-3, 1e-5}) {
      const auto h = half_space(m, half_space_cosines, goal);
      for (std::size_t i = 0; i < std::size(half_space_cosines); ++i) {
        EXPECT_LE(std::abs(h.at[i].albedo[0] - truth.at[i].albedo[0]), h.at[i].error[0]);
        EXPECT_LE(h.at[i].error[0], goal);
      }
      EXPECT_LE(std::abs(h.average.albedo[0] - truth.average.albedo[0]), h.average.error[0]);
    }
  }
}

TEST(HalfSpace, ItsOrdersAddUpAndFallFasterAndFaster) {
  const auto h = half_space(conductor(1), half_space_cosines);
  for (const auto& s : h.at) {
    double sum = 0, ratio = 2;
    for (std::size_t n = 0; n < s.order[0].size(); ++n) {
      sum += s.order[0][n];
      if (n == 0) continue;
      EXPECT_LT(s.order[0][n], ratio * s.order[0][n - 1]);
      ratio = s.order[0][n] / s.order[0][n - 1];
    }
    EXPECT_NEAR(s.albedo[0], sum, 1e-14);
    EXPECT_LT(s.rest[0], s.error[0]);
  }
}

TEST(HalfSpace, AgreesWithRandomWalksOrderByOrder) {
  constexpr double mu[] = {0.05, 0.5, 1};
  constexpr double walks = 200'000;
  for (const auto& m : {lobe("ggx", 0.5, 0.04), conductor(1), lobe("beckmann", 0.3, 0.6)}) {
    const auto h = half_space(m, mu);
    const auto w = walk(m, mu, 0, {.walks = static_cast<std::size_t>(walks)});
    for (std::size_t i = 0; i < std::size(mu); ++i) {
      EXPECT_NEAR(h.at[i].albedo[0], w[i].albedo[0], 4 * w[i].error[0] + h.at[i].error[0]) << mu[i];
      // a walk gives at most 1 to one order: σ² ≤ E_n
      for (std::size_t n = 0; n < 3; ++n)
        EXPECT_NEAR(h.at[i].order[0][n], w[i].order[0][n],
                    4 * std::sqrt(h.at[i].order[0][n] / walks) + h.at[i].error[0])
            << mu[i] << " " << n + 1;
    }
  }
}

TEST(HalfSpace, AveragesWhatItSaysOfEachCosine) {
  std::vector<double> mu;
  const auto nodes = gauss_legendre(16);
  for (const auto& q : nodes) mu.push_back(q.x * q.x);
  const auto h = half_space(conductor(0.6), mu);
  double sum = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    sum += 4 * nodes[i].weight * nodes[i].x * mu[i] * h.at[i].albedo[0];
  EXPECT_NEAR(h.average.albedo[0], sum, h.average.error[0] + h.at[0].error[0]);
}

TEST(HalfSpace, OfAnyMuIsTheSameWhateverElseIsAsked) {
  const auto m = conductor(0.2);
  const auto all = half_space(m, half_space_cosines);
  for (const std::size_t i : {0, 3}) {
    const auto one = half_space(m, {&half_space_cosines[i], 1});
    EXPECT_NEAR(one.at[0].albedo[0], all.at[i].albedo[0], one.at[0].error[0] + all.at[i].error[0]);
  }
}

TEST(HalfSpace, HasAChannelForEachColour) {
  const double f0[] = {0.9, 0.2, 0.9};
  const auto m =
      bind_model("lambert+ggx/smith_ggx.correlated/schlick",
                 {{"alpha", {0.5}}, {"f0", {f0[0], f0[1], f0[2]}}, {"kd", {0.1, 0.2, 0.3}}});
  const auto h = half_space(m, half_space_cosines);
  for (std::size_t c = 0; c < 3; ++c) {
    const auto grey = half_space(lobe("ggx", 0.5, f0[c]), half_space_cosines);
    for (std::size_t i = 0; i < std::size(half_space_cosines); ++i)
      EXPECT_NEAR(h.at[i].albedo[c], grey.at[i].albedo[0], h.at[i].error[c] + grey.at[i].error[0]);
    EXPECT_NEAR(h.average.albedo[c], grey.average.albedo[0], 1e-6);
  }
}

TEST(HalfSpace, AddsLobes) {
  const auto m =
      bind_model("ggx/smith_ggx.correlated/schlick+beckmann/smith_beckmann.correlated/schlick",
                 {{"alpha", {0.5}}, {"f0", {0.04}}, {"alpha_2", {0.2}}, {"f0_2", {0.9}}}, 1);
  const auto h = half_space(m, half_space_cosines);
  const auto a = half_space(lobe("ggx", 0.5, 0.04), half_space_cosines);
  const auto b = half_space(lobe("beckmann", 0.2, 0.9), half_space_cosines);
  for (std::size_t i = 0; i < std::size(half_space_cosines); ++i) {
    EXPECT_NEAR(h.at[i].albedo[0], a.at[i].albedo[0] + b.at[i].albedo[0], 1e-6);
    EXPECT_NEAR(h.at[i].order[0][1], a.at[i].order[0][1] + b.at[i].order[0][1], 1e-6);
    EXPECT_LE(h.at[i].error[0], 1e-5);
  }
}

TEST(HalfSpace, IsTheSameOnOneThread) {
  const auto m = conductor(0.4);
  const auto all = half_space(m, half_space_cosines);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const auto alone = half_space(m, half_space_cosines);
  for (std::size_t i = 0; i < std::size(half_space_cosines); ++i) {
    EXPECT_EQ(all.at[i].albedo, alone.at[i].albedo);
    EXPECT_EQ(all.at[i].error, alone.at[i].error);
  }
}

TEST(HalfSpace, TakesTwoWidthsWhereTheyAreOne) {
  const auto of = [](double alpha_y) {
    return half_space(bind_model("ggx_aniso/smith_ggx_aniso.correlated/schlick",
                                 {{"alpha_x", {0.3}}, {"alpha_y", {alpha_y}}, {"f0", {0.5}}}, 1),
                      half_space_cosines);
  };
  const auto one = half_space(lobe("ggx", 0.3, 0.5), half_space_cosines), two = of(0.3);
  for (std::size_t i = 0; i < std::size(half_space_cosines); ++i)
    EXPECT_NEAR(one.at[i].albedo[0], two.at[i].albedo[0], 1e-6);
  EXPECT_HAS(test::refusal([&] { of(0.4); }, Exit::usage), "isotropic");
}

TEST(HalfSpace, RefusesCosinesOutsideItsRange) {
  for (const double mu : {0.0, -0.1, 1.0000001, std::nan("")})
    EXPECT_THROW(half_space(lobe("ggx", 0.3, 1), {&mu, 1}), Error) << mu;
}

TEST(HalfSpace, RefusesWhatIsNoMicrosurface) {
  for (const char* spec : {"lambert", "ggx/smith_ggx.separable/schlick",
                           "gtr/smith_ggx.correlated/schlick", "ggx/kelemen/schlick"})
    EXPECT_THROW(half_space(bind_model(spec, {}, 1), half_space_cosines), Error) << spec;
}

}  // namespace
}  // namespace gonio
