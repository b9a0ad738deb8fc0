#include "stability/exhaustive.h"

#include <limits>

#include "many_fits.h"
#include "stability/evaluate.h"
#include "stability/subjects.h"

namespace gonio::stability {
namespace {

using Inputs = std::vector<double>;

/// A formula f(parameter, angle) over any number as columns.
Formula columns(auto angle, auto f) {
  const auto over = [=]<class T>(T, const auto& x, const auto* p, auto* out) {
    using Float = std::remove_reference_t<decltype(*out)>;
    for (std::size_t i = 0; i < x.n; ++i) out[i] = static_cast<Float>(f(T(p[0]), T(angle(x)[i])));
  };
  return {[=](const Block<float>& x, const float* p, float* out) { over(Half(), x, p, out); },
          [=](const Block<double>& x, const double* p, double* out) { over(1.0, x, p, out); }};
}
constexpr auto noh_of = [](const auto& x) { return x.noh; };

/// Few cases of many under a sanitizer, which is slow.
const bool all_cases = test::few(2) == 2;

TEST(Exhaustive, FindsAFaultPlantedAtASinglePairOfInputs) {
  auto s = subject("ndf.ggx", Given::cross);
  const double least = all_cases ? 0.25 : 0.30126953125;
  set_domain(s, "alpha", {least, all_cases ? 0.5 : 1236 * 0x1p-12});
  const auto sound = exhaustive(s, {});
  EXPECT_EQ(sound.evaluations, (all_cases ? 1025U : 3U) * 15361U);
  EXPECT_EQ(sound.no_value.count, 0U);
  EXPECT_LT(sound.relative.value, 0.007);

  const Inputs at{1235 * 0x1p-12, 1777 * 0x1p-15};
  const auto planted = [&](float factor) {
    const auto own = formula_of(*s.term, {});
    const Formula with{[=](const Block<float>& x, const float* p, float* out) {
                         own.halves(x, p, out);
                         for (std::size_t i = 0; i < x.n; ++i)
                           if (static_cast<double>(p[0]) == at[0] &&
                               static_cast<double>(x.sin2_theta_h[i]) == at[1])
                             out[i] *= factor;
                       },
                       own.doubles};
    return exhaustive(s, {}, 0.02, &with);
  };
  const auto larger = planted(1.01F);
  EXPECT_EQ(larger.relative.at, at);
  EXPECT_NEAR(larger.relative.value, 0.01, 0.007);
  EXPECT_EQ(larger.safe_from, least);  // it keeps the tolerance
  const auto lost = planted(1.1F);
  EXPECT_EQ(lost.ulp.at, at);
  EXPECT_EQ(lost.safe_from, 1236 * 0x1p-12);
  const auto negative = planted(-1);
  EXPECT_EQ(negative.negative.count, 1U);
  EXPECT_EQ(negative.negative.first, at);
  const auto none = planted(std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(none.no_value.count, 1U);
  EXPECT_EQ(none.no_value.first, at);
  EXPECT_EQ(none.safe_from, 1236 * 0x1p-12);
  const auto vanished = planted(0);
  EXPECT_EQ(vanished.vanished.first, at);
}

TEST(Exhaustive, SaysFromWhichAlphaOnTheDistributionOfGgxKeepsTwoPercentInHalf) {
  auto s = subject("ndf.ggx", Given::cross);
  if (!all_cases) set_domain(s, "alpha", {0.0038, 0.004});
  const auto found = exhaustive(s, {});
  EXPECT_NEAR(*found.safe_from, 1025 * 0x1p-18, 1e-12);
  if (!all_cases) return;
  EXPECT_EQ(found.evaluations, 15344U * 15361U);
  EXPECT_NEAR(found.relative.value, 0.00713, 1e-5);
  EXPECT_EQ(hex(Number::half, found.relative.at[0], true), "0x0c52");
  EXPECT_EQ(hex(Number::half, found.relative.at[1], false), "0x0009");
  EXPECT_EQ(found.no_value.count, 0U);
  EXPECT_EQ(found.negative.count, 0U);
  EXPECT_TRUE(found.flags.underflow);
  EXPECT_FALSE(found.flags.overflow);
}

TEST(Exhaustive, FlushedSubnormalsCostTheDistributionOfGgxMoreOfItsDomain) {
  auto s = subject("ndf.ggx", Given::cross);
  set_domain(s, "alpha", {0.0038, all_cases ? 0.1 : 0.00395});
  const auto kept = exhaustive(s, {}), flushed = exhaustive(s, {true, false});
  EXPECT_NEAR(kept.safe_from.value(), 1025 * 0x1p-18, 1e-12);
  // Of few widths none is safe.
  EXPECT_EQ(flushed.safe_from.has_value(), all_cases);
  EXPECT_GT(flushed.safe_from.value_or(1), 1.5 * *kept.safe_from);
}

TEST(Exhaustive, MaskingOfOneDirectionIsWorstWhereItsCosineIsLeast) {
  auto s = subject("masking.smith_ggx.correlated", Given::cosines);
  EXPECT_FALSE(can_be_exhausted(s));
  EXPECT_THROW(exhaustive(s, {}), std::exception);
  set_domain(s, "nol", {1, 1});
  set_domain(s, "alpha", {1e-4, all_cases ? 0.0012 : 1.001e-4});
  ASSERT_TRUE(can_be_exhausted(s));
  const auto found = exhaustive(s, {});
  EXPECT_LT(found.relative.value, 0.0032);
  if (!all_cases) return;
  EXPECT_NEAR(found.relative.value, 0.003148, 1e-6);
  EXPECT_EQ(hex(Number::half, found.relative.at[0], true), "0x0696");
  EXPECT_EQ(hex(Number::half, found.relative.at[2], false), "0x009a");
  EXPECT_NEAR(*found.safe_from, 1e-4, 1e-7);  // all of them
}

TEST(Exhaustive, CountsNeighboursBetweenWhichTheValueGoesTheWrongWay) {
  auto s = subject("ndf.ggx", Given::cross);
  set_domain(s, "alpha", {0.5, 0.5});
  const auto own = formula_of(*s.term, {});
  const double at = 0.25;
  const Formula with{[=](const Block<float>& x, const float* p, float* out) {
                       own.halves(x, p, out);
                       for (std::size_t i = 0; i < x.n; ++i)
                         if (static_cast<double>(x.sin2_theta_h[i]) == at) out[i] *= 0.9F;
                     },
                     own.doubles};
  const auto sound = exhaustive(s, {}), found = exhaustive(s, {}, 0.02, &with);
  EXPECT_EQ(found.not_monotone.count, sound.not_monotone.count + 1);
}

TEST(Exhaustive, WalksOverTwoAnglesOfATermWithoutParameters) {
  auto s = subject("masking.implicit", Given::cosines);
  set_domain(s, "nol", {0.5, 0.51});
  const auto found = exhaustive(s, {});
  EXPECT_GT(found.evaluations, 15000U * 20U);
  EXPECT_EQ(found.no_value.count, 0U);
  EXPECT_FALSE(found.safe_from);
}

// ---- What is known of halves
// ----------------------------------------------------------------------

TEST(Exhaustive, TheTextbooksDistributionIsInfiniteAtThePeakAndAFifthWrongElsewhere) {
  const auto textbook = columns(noh_of, []<class T>(const T& alpha, const T& noh) {
    const T a2 = alpha * alpha, t = noh * noh * (a2 - 1) + 1;
    return a2 / (pi<T>() * t * t);
  });
  auto s = subject("ndf.ggx", Given::cosine);
  set_domain(s, "alpha", {0.01, 0.01});
  const auto found = exhaustive(s, {}, 0.02, &textbook);
  EXPECT_EQ(found.no_value.count, 1U);
  EXPECT_EQ(found.no_value.first[1], 1);
  EXPECT_NEAR(found.relative.value, 0.22, 0.005);
  EXPECT_EQ(found.evaluations, 15360U);
}

TEST(Exhaustive, ThePeakOfTheDistributionOverflowsBelowAnAlphaOfAboutTwoThousandths) {
  const auto peak = columns(
      noh_of, []<class T>(const T& alpha, const T&) { return 1 / (pi<T>() * (alpha * alpha)); });
  auto s = subject("ndf.ggx", Given::cosine);
  set_domain(s, "alpha", {1e-4, 1});
  set_domain(s, "noh", {1, 1});
  const auto found = exhaustive(s, {}, 0.02, &peak);
  EXPECT_GT(found.overflow.count, 1000U);
  EXPECT_NEAR(*found.safe_from, 0.0022, 1e-4);
}

}  // namespace
}  // namespace gonio::stability
