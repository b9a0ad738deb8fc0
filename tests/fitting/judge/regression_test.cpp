// The probability of a misfit is what it says: of right models one in ten has one below 0.1.
#include "fitting/judge/regression.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "fitting/support.h"
#include "many_fits.h"

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

namespace gonio {
namespace {

/// Probabilities that tables of a model are told to miss it by luck.
std::vector<double> of_right_models(std::size_t tables, std::size_t samples) {
  const auto truth =
      test::bind("lambert+ggx/smith_ggx.correlated/schlick", "alpha=0.3,f0=0.05,kd=0.2", 1);
  std::vector<double> p(tables);
  tbb::parallel_for(std::size_t{0}, tables, [&](std::size_t k) {
    const Table t = synthesize(
        truth, {.layout = Layout::random, .samples = samples, .noise = 0.05, .seed = k + 1});
    FitOptions o;
    o.model = to_text(truth.model.spec);
    const Problem problem = pose(t, o);
    const Sampling s(t, t.bins(), Metric::log, problem.offset, true);
    const Fitted f = minimise(problem, fit_data<double>(s), truth, no_huber);
    TableFacts facts(t);
    auto left = misfit::left_over(s, problem, f, facts);
    misfit::find_variances(left);
    const auto found = misfit::regress(left);
    p[k] = found.tested ? found.p : 1;
  });
  return p;
}

TEST(Regression, IsSureOfScalesThatLeaveNothing) {
  misfit::Regression alone, open;
  alone.squares = 2, alone.freedom = 20, open.freedom = 10;
  EXPECT_EQ(misfit::luck_of_scales(alone, open), 0) << "an infinite F";
  EXPECT_EQ(misfit::luck_of_scales(open, open), 1);
}

TEST(Regression, TakesTheRightModelForWrongAboutAsOftenAsItsProbabilitySays) {
  constexpr double tables = test::few(600, 20);
  const auto p = of_right_models(static_cast<std::size_t>(tables), 500);
  for (const double level : {0.05, 0.1, 0.2}) {
    const auto below =
        static_cast<double>(std::ranges::count_if(p, [&](double x) { return x < level; }));
    EXPECT_LE(below, tables * level + 3 * std::sqrt(tables * level * (1 - level))) << level;
    if (tables >= 600) {
      EXPECT_GE(below, tables * level / 3) << level;
    }
  }
}

}  // namespace
}  // namespace gonio
