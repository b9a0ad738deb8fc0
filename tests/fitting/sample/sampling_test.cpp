// Samples as a fit looks at them: what is left out and why, and how much each counts.
#include "fitting/sample/sampling.h"

#include <cmath>

#include "fitting/sample/data.h"
#include "fitting/support.h"
#include "table/example.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

TEST(Sampling, CountsEveryValueOnceByWhatItIs) {
  const double nan = std::nan("");
  Table t = test::list_of({0.1, 0.2, 0, -1, nan, 0.3, HUGE_VAL, 0.4, 0, 0.5});
  t.weights = {1, 1, 1, 1, 1, 0, 1, 1, 1, 1};
  const Sampling s(t, Bins::centre, Metric::log, 0, false);
  const auto counts = fit_data<double>(s).counts;
  EXPECT_EQ(counts.used, 4U);
  const auto reasons = counts.by_reason(s);
  EXPECT_EQ(reasons.at("not_finite"), 2U);
  EXPECT_EQ(reasons.at("negative"), 1U);
  EXPECT_EQ(reasons.at("zero"), 2U);
  EXPECT_EQ(reasons.at("zero_weight"), 1U);
  EXPECT_EQ(reasons.at("below_horizon"), 0U);
  // A metric that needs no logarithm takes the zeros too.
  const Sampling plain(t, Bins::centre, Metric::l2_cosine, 0, false);
  EXPECT_EQ(fit_data<double>(plain).counts.used, 6U);
  EXPECT_EQ(fit_data<double>(plain).counts.by_reason(plain).count("zero"), 0U);
}

TEST(Sampling, TakesWhatNoLogarithmTellsFromZeroForZero) {
  const Table t = test::list_of({0.1, 1e-29, 1e-31, 1e-300, 0.2});
  for (const Metric m : {Metric::log, Metric::relative}) {
    const Sampling s(t, Bins::centre, m, 0, false);
    const auto counts = fit_data<double>(s).counts;
    EXPECT_EQ(counts.used, 3U);
    EXPECT_EQ(counts.by_reason(s).at("zero"), 2U);
    const Sampling above(t, Bins::centre, m, 1e-3, false);
    EXPECT_EQ(fit_data<double>(above).counts.used, 5U);
  }
  const Sampling plain(t, Bins::centre, Metric::l2_cosine, 0, false);
  EXPECT_EQ(fit_data<double>(plain).counts.used, 5U);
}

TEST(Sampling, WeighsByTheRootOfTheWeightOverItsMean) {
  Table t = test::list_of({0.1, 0.2});
  t.weights = {0.5, 1.5};
  const Sampling s(t, Bins::centre, Metric::log, 0, false);
  EXPECT_NEAR(s.root_weight(0), std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(s.root_weight(1), std::sqrt(1.5), 1e-15);
  EXPECT_EQ(s.count_of(1), 1);
  EXPECT_EQ(fit_data<double>(s).counts.samples, 2);
}

TEST(Sampling, LeavesOutWhatItIsToldToAndCountsItAsOfNoWeight) {
  for (const bool weighted : {false, true}) {
    Table t = test::list_of({0.1, 0.2, 0.3});
    if (weighted) t.weights = {1, 2, 3};
    const Sampling whole(t, Bins::centre, Metric::log, 0, false);
    const Sampling s = whole.without({false, true, false});
    EXPECT_EQ(s.root_weight(1), 0);
    EXPECT_EQ(s.root_weight(2), whole.root_weight(2));
    const auto counts = fit_data<double>(s).counts;
    EXPECT_EQ(counts.used, 2U);
    EXPECT_EQ(counts.by_reason(s).at("zero_weight"), 1U);
    EXPECT_EQ(fit_data<double>(whole).counts.used, 3U);
  }
}

TEST(Sampling, CountsAsManySamplesAsAWholeWeightSays) {
  Table t = test::list_of({0.1, 0.2, 0.3, -1});
  t.weights = {1, 3, 0, 5};
  const Sampling s(t, Bins::centre, Metric::log, 0, false);
  EXPECT_EQ(s.root_weight(0), 1);
  EXPECT_EQ(s.root_weight(1), std::sqrt(3));
  EXPECT_EQ(s.count_of(1), 3);
  const auto counts = fit_data<double>(s).counts;
  EXPECT_EQ(counts.used, 2U);
  EXPECT_EQ(counts.samples, 4);
}

TEST(Sampling, LeavesOutWhatOnlyRepeatsAnotherAngle) {
  constexpr std::size_t thetas = 5, phis = 4, copy = 3;
  for (const std::size_t axis : {std::size_t{0}, std::size_t{1}}) {
    Table t = test::mbsdf_example(thetas, phis);
    const std::size_t step = axis == 0 ? thetas * phis : phis,
                      other = axis == 0 ? phis : thetas * phis;
    std::size_t repeated = 0;
    const SampleAngles at(t);
    for (std::size_t k = 0; k < thetas; ++k)
      for (std::size_t i = copy * step + k * other; i < copy * step + k * other + phis; ++i) {
        for (auto& plane : t.values) plane[i] = plane[i - step];
        repeated += at(i).nol > horizon_cosine && at(i).nov > horizon_cosine;
      }
    for (const bool fold : {false, true}) {
      const Sampling s(t, Bins::centre, Metric::l2_cosine, 0, fold);
      const Sampling kept(t, Bins::centre, Metric::l2_cosine, 0, fold, true);
      const auto counts = fit_data<double>(s).counts, all = fit_data<double>(kept).counts;
      EXPECT_EQ(counts.by_reason(s).at("copied"), repeated * t.values.size());
      EXPECT_EQ(counts.used + counts.copied, all.used);
      constexpr auto negative = static_cast<std::size_t>(Mask::negative);
      EXPECT_EQ(counts.masked[negative], all.masked[negative]);
      EXPECT_EQ(all.by_reason(kept).count("copied"), 0U);
    }
  }
}

TEST(Metrics, CompareAsTheyAreDefined) {
  const Table t = test::list_of({0.2, 0.4});
  const auto m = test::bind("lambert", "kd=0.9", 1);
  const FreeSlots none({false});
  const auto residuals = [&](Metric metric, double offset) {
    const Sampling s(t, Bins::centre, metric, offset, false);
    const auto data = fit_data<double>(s);
    return Accumulator<double>(m.model, data, none).residuals(m.values);
  };
  const double f = 0.9 / M_PI;
  const SampleAngles at(t);
  for (std::size_t i = 0; i < 2; ++i) {
    const double y = t.values[0][i];
    EXPECT_NEAR(residuals(Metric::log, 0.1)[i], std::log((f + 0.1) / (y + 0.1)), 1e-14);
    EXPECT_NEAR(residuals(Metric::l2_cosine, 0)[i], (f - y) * at(i).nol, 1e-15);
    EXPECT_NEAR(residuals(Metric::relative, 0.1)[i], (f - y) / (y + 0.1), 1e-14);
  }
}

TEST(Groups, OfAMirroredAndExchangedGridHoldFourMembersAtMost) {
  for (const auto& c : test::layouts_that_fold()) {
    const auto s = c.sampling(Metric::log, true);
    EXPECT_GE(s.groups().widest(), 2U);
    EXPECT_LE(s.groups().widest(), Groups::most);
    std::size_t members = 0;  // every sample has its place
    for (std::size_t r = 0; r < s.groups().rows().size(); ++r)
      for (std::size_t k = 0; k < s.groups().columns().size(); ++k)
        members += s.groups().rows().parts(r) * s.groups().columns().parts(k);
    EXPECT_EQ(members, c.table.size());
  }
}

}  // namespace
}  // namespace gonio
