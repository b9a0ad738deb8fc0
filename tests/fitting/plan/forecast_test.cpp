#include "fitting/plan/forecast.h"

#include <cmath>
#include <limits>

#include "base/random.h"
#include "fitting/judge/uncertainty.h"
#include "number/distributions.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

namespace gonio {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Values of which each tells an unknown alike, with an error of 1.
FitSoFar alike(int values) {
  FitSoFar f;
  f.information = Eigen::MatrixXd::Constant(1, 1, values);
  f.range = Eigen::VectorXd::Constant(1, 1e6);
  f.std_error = Eigen::VectorXd::Constant(1, nan);
  f.width = Eigen::VectorXd::Constant(1, 1);
  f.freedom = values - 1;
  return f;
}

/// Some values of three unknowns.
std::vector<SampleRows> drawn(std::size_t n, std::uint64_t seed) {
  Draws draw(seed);
  std::vector<SampleRows> all(n, SampleRows(2, 3));
  for (auto& j : all)
    for (Eigen::Index k = 0; k < j.size(); ++k) j.data()[k] = draw.normal();
  return all;
}
FitSoFar three(const std::vector<SampleRows>& values) {
  FitSoFar f;
  f.information = Eigen::MatrixXd::Zero(3, 3);
  for (const auto& j : values) f.information += j.transpose() * j;
  f.values = values;
  f.range = Eigen::VectorXd::Constant(3, 1e4);
  f.std_error = f.information.inverse().diagonal().cwiseSqrt();
  f.width = 4 * f.std_error;
  f.freedom = 2 * static_cast<double>(values.size()) - 3;
  return f;
}

TEST(Forecast, OfOneUnknownFallsByTheRootOfTheNumberOfValues) {
  const Forecast f(alike(25));
  const SampleRows one = SampleRows::Ones(1, 1);
  std::vector<const SampleRows*> more;
  for (int n = 25; n < 40; ++n) {
    EXPECT_NEAR(f.widths(more)[0], 2 * students_t_quantile(0.975, n - 1) / std::sqrt(n), 1e-9);
    more.push_back(&one);
  }
}

TEST(Forecast, NeverGrowsByASample) {
  const Forecast f(three(drawn(20, 1)));
  const auto further = drawn(30, 2);
  std::vector<const SampleRows*> more;
  Eigen::VectorXd before = f.widths(more);
  for (const auto& j : further) {
    more.push_back(&j);
    const Eigen::VectorXd after = f.widths(more);
    for (Eigen::Index k = 0; k < 3; ++k) EXPECT_LT(after[k], before[k]) << more.size();
    before = after;
  }
}

TEST(Forecast, KnowsTheVariancesAfterASampleFromThoseBefore) {
  const Forecast f(three(drawn(20, 1)));
  const auto further = drawn(2, 2);
  const std::vector<const SampleRows*> one{&further[0]}, both{&further[0], &further[1]};
  const Eigen::VectorXd after = Forecast::variances_after(f.covariance(one), further[1]);
  EXPECT_LT((after - f.covariance(both).diagonal()).norm(), 1e-12 * after.norm());
}

TEST(Forecast, OfWhatTheFitTellsAllowsForLeverageAndFewValues) {
  FitSoFar f = alike(5);
  f.values.assign(5, SampleRows::Ones(1, 1));
  const double variance = 1.0 / 5 / (1 - 1.0 / 5);  // HC3
  EXPECT_NEAR(Forecast(f).told_widths({})[0],
              2 * students_t_quantile(0.975, 4) * std::sqrt(variance), 1e-6);

  // A value that tells ten times as much as each of the others: in truth there is one.
  const Forecast before(f);
  const SampleRows much = SampleRows::Constant(1, 1, 10);
  const std::vector<const SampleRows*> more{&much};
  EXPECT_GT(before.told_widths(more)[0], before.told_widths({})[0]);
  EXPECT_LT(before.widths(more)[0], before.widths({})[0]);
}

TEST(Forecast, TakesTheTableToSayNothingOfWhatTheFitTellsNothingOf) {
  FitSoFar f = three(drawn(20, 1));
  f.range.setConstant(10);
  f.width[1] = nan;
  const Forecast forecast(f);
  const Eigen::VectorXd w = forecast.widths({});
  EXPECT_GT(w[1], 10) << "as wide as its range";
  EXPECT_LT(w[0], 3);
  SampleRows j = SampleRows::Zero(1, 3);
  j(0, 1) = 1;
  const std::vector<const SampleRows*> more{&j};
  EXPECT_LT(forecast.widths(more)[1], 5);
  EXPECT_NEAR(forecast.covariance(more)(1, 1), 1 / (1 + 12 / 100.0), 1e-12);
}

TEST(Forecast, OfAMisfitStaysInProportionToTheFit) {
  FitSoFar f = three(drawn(20, 1));
  f.width *= 7;
  const Forecast independent(f);
  f.std_error *= 7;
  f.in_proportion = true;
  const Forecast forecast(f);
  EXPECT_LT((forecast.widths({}) - f.width).norm(), 1e-6 * f.width.norm());
  const auto further = drawn(200, 2);
  std::vector<const SampleRows*> more;
  for (const auto& j : further) more.push_back(&j);
  const double ratio = forecast.widths(more)[0] / independent.widths(more)[0];
  EXPECT_NEAR(ratio, forecast.widths({})[0] / independent.widths({})[0], 0.05 * ratio);
}

TEST(Forecast, OfFewAnglesKnowsThatFurtherOnesAddDegreesOfFreedom) {
  FitSoFar f = three(drawn(40, 1));
  f.in_proportion = true;
  const auto t = [](double freedom) { return students_t_quantile(0.975, freedom); };
  const auto further = drawn(8, 2);
  std::vector<const SampleRows*> more;
  for (const auto& j : further) more.push_back(&j);
  f.width = 2 * t(1e3) * f.std_error;
  const double of_many = Forecast(f).widths(more)[0] / f.width[0];
  f.width = 2 * t(2) * f.std_error;
  const double of_few = Forecast(f).widths(more)[0] / f.width[0];
  EXPECT_NEAR(of_few / of_many, t(10) / t(2), 0.02);
}

TEST(Forecast, CarriesNoiseThatIsNotAlikeAsFarAsTheTableCounts) {
  FitSoFar f = three(drawn(400, 1));
  f.std_error *= 3;
  const Forecast uneven(f);
  f.std_error /= 3;
  const Forecast even(f);
  const auto ratio = [&](std::span<const SampleRows* const> more) {
    return uneven.widths(more)[0] / even.widths(more)[0];
  };
  EXPECT_NEAR(ratio({}), 3, 0.2);
  const auto further = drawn(400, 2);
  std::vector<const SampleRows*> more;
  for (const auto& j : further) more.push_back(&j);
  EXPECT_NEAR(ratio(more), std::sqrt((9 + 1) / 2.0), 0.2) << "half of the variance is the table's";
}

}  // namespace
}  // namespace gonio
