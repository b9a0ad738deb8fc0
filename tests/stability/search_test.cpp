#include "stability/search.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "base/error.h"
#include "many_fits.h"
#include "number/half.h"
#include "stability/evaluate.h"
#include "stability/places.h"
#include "stability/subjects.h"

#include <tbb/global_control.h>

namespace gonio::stability {
namespace {

using Inputs = std::vector<double>;

constexpr Arithmetic half{Number::half}, contracted{Number::half, false, true},
    in_float{Number::float_}, in_double{Number::double_};

/// Effort for which a sanitizer has time.
SearchOptions options() {
  return {0, 1, test::few(2) == 2 ? 1.0 : 0.05};
}

TEST(Search, FindsTheWorstThatLookingAtEveryPairFinds) {
  auto s = subject("ndf.ggx", Given::cross);
  const auto found = search(s, half, options());
  EXPECT_TRUE(found.settled);
  EXPECT_EQ(found.evidence, Evidence::searched);
  EXPECT_LT(found.relative.value, 0.00714);
  EXPECT_EQ(found.no_value.count, 0U);
  if (test::few(2) < 2) return;  // less effort finds less
  EXPECT_GT(found.relative.value, 0.006);
  EXPECT_NEAR(*found.safe_from, 0.00391, 0.0004);
  EXPECT_LT(*found.safe_from, 0.00392);
}

TEST(Search, FindsNoOtherLimitFromOtherSeeds) {
  if (test::few(2) < 2) GTEST_SKIP() << "less effort finds less";
  const auto s = subject("ndf.beckmann", Given::cross);
  std::vector<double> from;
  for (const std::uint64_t seed : {1, 2, 3})
    from.push_back(search(s, {Number::mixed}, {0, seed, 1}).safe_from.value_or(1));
  const auto [least, most] = std::ranges::minmax(from);
  EXPECT_LT(most, 1.1 * least);
}

TEST(Search, IsTheSameForASeedWhateverTheThreads) {
  const auto s = subject("masking.smith_ggx.correlated", Given::cosines);
  const SearchOptions few{0, 3, 0.05};
  const auto all = search(s, half, few);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const auto alone = search(s, half, few);
  EXPECT_EQ(all.relative.at, alone.relative.at);
  EXPECT_EQ(all.beyond.at, alone.beyond.at);
  EXPECT_EQ(all.no_value.count, alone.no_value.count);
  EXPECT_EQ(all.no_value.first, alone.no_value.first);
  EXPECT_EQ(all.evaluations, alone.evaluations);
  EXPECT_EQ(all.safe_from, alone.safe_from);
  EXPECT_NE(search(s, half, {0, 4, 0.05}).evaluations, all.evaluations);
}

TEST(Search, WhatItTellsIsThereToBeEvaluatedAgain) {
  const auto s = subject("masking.smith_ggx.correlated", Given::cosines);
  for (const auto& a : {half, in_float, in_double}) {
    const auto found = search(s, a, {0, 1, 0.05});
    const auto f = truth_of(s, found.relative.at);
    EXPECT_EQ(f.relative_error(value_of(s, a.number, found.relative.at)), found.relative.value);
    EXPECT_EQ(rounded(s, a.number, found.relative.at), found.relative.at);
    for (std::size_t k = 0; k < s.inputs.size(); ++k)
      EXPECT_TRUE(s.inputs[k].domain.holds(found.relative.at[k]));
  }
}

TEST(Search, TheDistributionOfGgxKeepsEightUnitsInFloatAndDoubleByTheCrossProduct) {
  const auto s = subject("ndf.ggx", Given::cross);
  for (const auto& a : {in_float, in_double}) {
    const auto found = search(s, a, options());
    EXPECT_LT(found.ulp.value, 8) << name_of(a.number);
    EXPECT_GT(found.ulp.value, 4) << name_of(a.number);
    EXPECT_EQ(found.no_value.count + found.negative.count + found.vanished.count, 0U);
    EXPECT_EQ(found.safe_from, rounded(a.number, 1e-6, true));
  }
}

TEST(Search, TheDistributionOfGgxFromOneMinusTheCosineSquaredLosesFourDigitsNearThePeak) {
  auto s = subject("ndf.ggx", Given::cosine);
  set_domain(s, "alpha", {0.005, 1});
  const auto found = search(s, in_double, options());
  EXPECT_GT(found.ulp.value, 2e4);
  EXPECT_LT(found.ulp.value, 8e4);
  EXPECT_GT(found.ulp.at[1], 0.9999);  // near the peak
  EXPECT_LT(found.ulp.at[0], 0.006);
  EXPECT_LT(found.beyond.value, 8);  // of the cosine alone nothing better can be had
  EXPECT_GT(found.condition, 1e4);
}

TEST(Search, ContractionTakesReciprocityFromSmithsCorrelatedMasking) {
  const auto s = subject("masking.smith_ggx.correlated", Given::cosines);
  EXPECT_EQ(search(s, half, {0, 1, 0.1}).irreciprocal.count, 0U);
  const auto found = search(s, contracted, {0, 1, 0.1});
  EXPECT_GT(found.irreciprocal.count, 0U);
  EXPECT_EQ(found.irreciprocal.first.size(), 3U);
}

TEST(Search, IsNotSettledWhereTwoSeedsFoundDifferentThings) {
  const auto s = subject("ndf.gtr.as_written", Given::cosine);
  EXPECT_FALSE(search(s, in_double, {0, 1, 0.001}).settled);
}

TEST(Search, RefusesLibertiesInNumbersWhereTheyAreNotKnown) {
  const auto s = subject("ndf.ggx", Given::cross);
  EXPECT_THROW(search(s, {Number::float_, true, false}), Error);
}

TEST(Search, CountsNeighboursBetweenWhichTheValueGoesTheWrongWay) {
  // 1 − c² of half cosines jumps by more than alpha's share: D of NoH² alpha² + 1 − NoH² in half is
  // a staircase.
  const auto s = subject("ndf.gtr", Given::cosine);
  const auto found = search(s, half, {0, 1, 0.1});
  ASSERT_GT(found.not_monotone.count, 0U);
  Inputs at = found.not_monotone.first, next = at;
  next[2] = at_place(Number::half, place_of(Number::half, at[2], false) + 1, false);
  const double rise = value_of(s, Number::half, next) - value_of(s, Number::half, at);
  EXPECT_LT(rise * (truth_of(s, next).value - truth_of(s, at).value), 0);
}

TEST(Search, TellsTheFlagsThatWereRaisedOnTheWayToTheWorst) {
  const auto found = search(subject("ndf.ggx", Given::cross), half, {0, 1, 0.1});
  EXPECT_TRUE(found.flags.underflow);
  EXPECT_FALSE(found.flags.overflow);
}

TEST(Search, LooksAtModelsToo) {
  const auto found =
      search(subjects_of("ggx/smith_ggx.correlated/schlick").front(), in_float, {0, 1, 0.02});
  EXPECT_GT(found.relative.value, 1e-7);
  EXPECT_EQ(found.no_value.count, 0U);
  const auto spec = subjects_of("ggx/smith_ggx.correlated/schlick").front();
  EXPECT_GT(search(spec, contracted, {0, 1, 0.02}).relative.value, 1e-3);
}

// ---- What is known of naive forms
// -----------------------------------------------------------------

double naive_gtr(double alpha, double gamma, double noh) {
  const double a2 = alpha * alpha;
  const double n = (gamma - 1) * (a2 - 1) / (std::numbers::pi * (1 - std::pow(a2, 1 - gamma)));
  return n / std::pow(1 + (a2 - 1) * noh * noh, gamma);
}

TEST(NaiveForms, GtrLosesElevenDigitsBesideGammaOneAndIsNoNumberAtAlphaOne) {
  const auto s = subject("ndf.gtr", Given::cosine);
  double worst = 0;
  for (const double gamma : {0.999, 1.001})
    for (int k = 0; k < 100; ++k) {
      const Inputs in{1 - 1e-9 * (1 + k / 100.0), gamma, 0.5};
      const auto f = truth_of(s, in);
      worst = std::max(worst, f.relative_error(naive_gtr(in[0], in[1], in[2])));
      EXPECT_LT(f.relative_error(value_of(s, Number::double_, in)), 1e-14);
    }
  EXPECT_GT(worst, 1e-5);
  EXPECT_LT(worst, 1e-3);
  EXPECT_TRUE(std::isnan(naive_gtr(1, 1.5, 0.5)));
}

TEST(NaiveForms, SchlickFedTheWrongSidesCosineErrsByAlmostAllAtTheCriticalAngle) {
  const double eta = 1 / 1.5, critical = std::sqrt((1 - eta) * (1 + eta));
  const auto schlick = subject("fresnel.schlick", Given::facet),
             exact = subject("fresnel.dielectric", Given::facet);
  const double wrong = value_of(schlick, Number::double_, Inputs{0.04, critical});
  const double right = value_of(exact, Number::double_, Inputs{eta, critical * (1 - 1e-9)});
  EXPECT_EQ(right, 1);
  EXPECT_NEAR(right - wrong, 0.96, 0.002);
}

/// |n × h|² of halves that are exact, against the same in double.
double cross_error(const std::array<double, 3>& n, const std::array<double, 3>& h) {
  const auto squared = [&]<class T>(T) {
    const auto at = [](const auto& v, int k) { return T(v[static_cast<std::size_t>(k)]); };
    const auto minor = [&](int i, int j) { return at(n, i) * at(h, j) - at(n, j) * at(h, i); };
    const T x = minor(1, 2), y = minor(2, 0), z = minor(0, 1);
    return static_cast<double>(x * x + y * y + z * z);
  };
  const double f = squared(1.0);
  return std::abs(squared(Half()) - f) / f;
}

TEST(NaiveForms, TheCrossProductInHalfIsGoodAlongTheAxesAloneNearThePeak) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> sine(0.005, 0.02);
  const auto unit = [&] {
    std::array v{normal(random), normal(random), normal(random)};
    const double length = std::hypot(v[0], v[1], v[2]);
    for (double& x : v) x /= length;
    return v;
  };
  const auto halves = [](std::array<double, 3> v) {
    for (double& x : v) x = static_cast<double>(Half(x));
    return v;
  };
  double axes = 0, any = 0;
  for (int i = 0; i < 100'000; ++i) {
    const double s = sine(random), turn = sine(random) * 1e4;
    axes = std::max(axes, cross_error({0, 0, 1}, halves({s * std::cos(turn), s * std::sin(turn),
                                                         std::sqrt(1 - s * s)})));
    // h at the same angle from any n
    const auto n = unit(), other = unit();
    const double along = n[0] * other[0] + n[1] * other[1] + n[2] * other[2],
                 rest = std::sqrt(1 - along * along);
    std::array<double, 3> h{};
    for (std::size_t k = 0; k < 3; ++k)
      h[k] = n[k] * std::sqrt(1 - s * s) + s * (other[k] - along * n[k]) / rest;
    any = std::max(any, cross_error(halves(n), halves(h)));
  }
  EXPECT_LT(axes, 0.005);
  EXPECT_GT(axes, 0.0005);
  EXPECT_GT(any, 0.08);
}

}  // namespace
}  // namespace gonio::stability
