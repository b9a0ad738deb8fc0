// What a fit reads is what the table holds: folded, thinned, in float.
#include "fitting/sample/data.h"

#include <array>
#include <cmath>

#include "fitting/judge/assess.h"
#include "fitting/support.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

using test::Case;
using test::layouts_that_fold;

TEST(Folding, ChangesNoSum) {
  for (const Case& c : layouts_that_fold())
    for (std::size_t m = 0; m < names_of<Metric>.size(); ++m) {
      const auto alone = c.sampling(static_cast<Metric>(m)),
                 folded = c.sampling(static_cast<Metric>(m), true);
      EXPECT_LT(folded.groups().size(), 0.6 * static_cast<double>(alone.groups().size()));
      const auto all = fit_data<double>(alone), less = fit_data<double>(folded);
      EXPECT_EQ(all.counts.used, less.counts.used);
      EXPECT_EQ(all.counts.by_reason(alone), less.counts.by_reason(folded));
      const auto e = Accumulator<double>(c.model.model, all, c.free).normal_equations(c.off);
      const auto f = Accumulator<double>(c.model.model, less, c.free).normal_equations(c.off);
      EXPECT_NEAR(f.cost, e.cost, 1e-11 * e.cost) << names_of<Metric>[m];
      for (std::size_t i = 0; i < e.g.size(); ++i)
        EXPECT_NEAR(f.g[i], e.g[i], 1e-10 * std::sqrt(e.cost * e.h(i, i))) << names_of<Metric>[m];
      for (std::size_t i = 0; i < e.h.entries().size(); ++i)
        EXPECT_NEAR(f.h.entries()[i], e.h.entries()[i], 1e-11 * std::abs(e.h.entries()[i]) + 1e-12)
            << names_of<Metric>[m];
    }
}

TEST(Folding, InFloatLosesSixDigitsAtMost) {
  for (const Case& c : layouts_that_fold()) {
    const auto s = c.sampling(Metric::log, true);
    const auto e =
        Accumulator<double>(c.model.model, fit_data<double>(s), c.free).normal_equations(c.off);
    const auto f =
        Accumulator<float>(c.model.model, fit_data<float>(s), c.free).normal_equations(c.off);
    EXPECT_NEAR(f.cost, e.cost, 1e-5 * e.cost);
    for (std::size_t i = 0; i < 8; ++i) {
      EXPECT_NEAR(f.g[i], e.g[i], 2e-5 * std::sqrt(e.cost * e.h(i, i)));
      EXPECT_NEAR(f.h(i, i), e.h(i, i), 2e-5 * e.h(i, i));
    }
    const auto a = assess(s, c.at_off(), c.free, no_huber, true, nullptr, false);
    const auto b = assess(s, c.at_off(), c.free, no_huber, true, nullptr, true);
    EXPECT_NEAR(a.residuals.log_rms, b.residuals.log_rms, 1e-5 * a.residuals.log_rms);
    for (std::size_t i = 0; i < 8; ++i)
      EXPECT_NEAR(test::meat(a.sandwich, i, i), test::meat(b.sandwich, i, i),
                  1e-3 * test::meat(a.sandwich, i, i));
  }
}

TEST(Levels, HoldValuesAloneWhateverTheTableLacks) {
  Case c({.layout = Layout::random, .samples = 40000, .noise = 0.1});
  for (auto& v : c.table.values)
    for (std::size_t i = 0; i < v.size(); ++i)
      if (i % 100) v[i] = -1;  // 1 % is left
  constexpr std::array<std::size_t, 2> most{50, 200};
  const auto levels = fit_levels<double>(c.sampling(Metric::log), most);
  for (std::size_t l = 0; l < most.size(); ++l) {
    EXPECT_GT(levels.thinned[l].groups, 0U);
    EXPECT_GE(levels.thinned[l].counts.used, levels.thinned[l].groups);
  }
}

TEST(FitData, FoldsTheMembersOfAGroupIntoTheirMeanAndWhatIsLeft) {
  // Half of the polar grid mirrors the other: two members with weights 1 and 1 have their mean as
  // target, weight √2 and ½ (a − b)² that no model explains.
  Case c = layouts_that_fold()[2];
  c.table.weights.clear();
  const auto alone = fit_data<double>(c.sampling(Metric::log)),
             folded = fit_data<double>(c.sampling(Metric::log, true));
  double squares = 0, sum = 0, folded_squares = 0, folded_sum = 0;
  const auto add = [](const FitData<double>& d, double& s, double& s2) {
    for (const auto& task : d.tasks)
      for (const auto& b : task)
        for (std::size_t i = 0; i < b.n; ++i) {
          const double w = b.weight(0)[i], t = b.target(0)[i];
          s += w * w * t;
          s2 += w * w * t * t;
        }
  };
  add(alone, sum, squares);
  add(folded, folded_sum, folded_squares);
  double rest = folded.rest, others = 0, others_alone = 0, ignored = 0;
  for (std::size_t ch = 1; ch < 3; ++ch)
    for (const auto* d : {&alone, &folded})
      for (const auto& task : d->tasks)
        for (const auto& b : task)
          for (std::size_t i = 0; i < b.n; ++i) {
            const double w = b.weight(ch)[i], t = b.target(ch)[i];
            (d == &alone ? others_alone : others) += w * w * t * t;
            ignored += w;
          }
  EXPECT_NEAR(folded_sum, sum, 1e-9 * std::abs(sum));
  EXPECT_GT(rest, 0);
  EXPECT_NEAR(folded_squares + others + rest, squares + others_alone,
              1e-11 * (squares + others_alone));
  EXPECT_GT(ignored, 0);
}

TEST(Levels, TakeEveryNthGroupThatHasAValue) {
  const Table t = test::list_of(std::vector<double>(1000, 0.25));
  const Sampling s(t, Bins::centre, Metric::log, 0, false);
  constexpr std::array<std::size_t, 1> most{100};
  const auto levels = fit_levels<double>(s, most);
  EXPECT_EQ(levels.all.groups, 1000U);
  EXPECT_EQ(levels.all.counts.used, 1000U);
  // The smallest step from 10 on that has no divisor in common with 1000 is 11: 0, 11 … 990.
  EXPECT_EQ(levels.thinned[0].groups, 91U);
  EXPECT_EQ(levels.thinned[0].counts.used, 91U);
}

}  // namespace
}  // namespace gonio
