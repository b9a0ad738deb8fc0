// The search of the cost over the widths: what it looks at, and that the fit goes where it is
// lower.
#include "fitting/solve/profile.h"

#include <algorithm>
#include <cmath>

#include "fitting/fit.h"
#include "fitting/support.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace gonio {
namespace {

constexpr const char* paint = "lambert+ggx/smith_ggx.correlated/schlick";
constexpr const char* gtr = "lambert+gtr/smith_ggx.correlated/schlick";

/// A table, the problem of fitting it, and its samples.
struct Posed {
  FitOptions options;
  BoundModel truth;
  Table table;
  Problem problem;
  FitData<double> data;
  Posed(const char* model,
        const std::string& settings,
        std::vector<std::string> fixed = {},
        double noise = 0.02)
      : options(options_of(model, std::move(fixed))),
        truth(settings.empty() ? bind_model(model, {}, 1) : test::bind(model, settings, 1)),
        table(synthesize(truth, {.layout = Layout::in_plane, .noise = noise})),
        problem(pose(table, options)),
        data(fit_data<double>(Sampling(table, table.bins(), Metric::log, 0, true))) {}
  static FitOptions options_of(const char* model, std::vector<std::string> fixed) {
    FitOptions o;
    o.model = model;
    o.fixed = parse_settings(fixed);
    return o;
  }
  Fitted fitted_from(std::vector<double> values) const {
    return minimise(problem, data, {problem.start.model, std::move(values), {}}, no_huber);
  }
};

std::vector<std::string> axes_of(const char* model, std::vector<std::string> fixed = {}) {
  const Posed p(model, "", std::move(fixed));
  std::vector<std::string> names;
  for (const std::size_t k : profile_axes(p.problem))
    names.push_back(p.problem.start.model.parameters[k].name);
  return names;
}

TEST(Profile, IsOverWidthsThenExponentsThenIndices) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(axes_of(paint), Names{"alpha"});
  EXPECT_EQ(axes_of(gtr), (Names{"alpha", "gamma"}));
  EXPECT_EQ(axes_of(gtr, {"alpha=0.2"}), Names{"gamma"});
  EXPECT_EQ(axes_of("ggx/smith_ggx.correlated/dielectric"), (Names{"alpha", "eta"}));
  EXPECT_EQ(axes_of("gtr/smith_ggx.correlated/schlick+ggx/smith_ggx.correlated/schlick"),
            (Names{"alpha", "alpha_2"}));
  EXPECT_EQ(axes_of("lambert"), Names{});
}

TEST(Profile, HasTheLeastCostOfEachCell) {
  const Posed p(paint, "alpha=0.2,f0=0.3,kd=0.1");
  Fitted f = p.fitted_from(p.truth.values);
  const Profile profile = gonio::profile(p.problem, p.data, p.data, p.data, f);
  ASSERT_EQ(profile.cells.size(), profile_cells);
  EXPECT_EQ(profile.moves, 0);
  EXPECT_NEAR(profile.optimum / f.solution.at.cost, 1, 1e-6);
  for (const std::size_t i : {0U, 20U, 45U, 50U, 63U}) {
    const auto& cell = profile.cells[i];
    FitOptions held = p.options;
    held.fixed = {{"alpha", cell.at}};
    EXPECT_NEAR(cell.cost / fit(p.table, held).document.cost, 1, 1e-3) << cell.at[0];
  }
  const auto lowest = std::ranges::min_element(profile.cells, {}, &ProfileCell::cost);
  EXPECT_NEAR(std::log(lowest->at[0] / 0.2), 0, 0.08) << "within half a step of the truth";
  EXPECT_GE(lowest->cost_of_all, f.solution.at.cost);
}

TEST(Profile, SolvesForTheCellsWithinOnePercentWithAllSamples) {
  // Where noise is most of the cost many cells are as good.
  const Posed p(gtr, "alpha=0.6,gamma=2,f0=0.05,kd=0.3", {}, 0.3);
  Fitted f = p.fitted_from(p.truth.values);
  const Profile profile = gonio::profile(p.problem, p.data, p.data, p.data, f);
  ASSERT_EQ(profile.cells.size(), profile_side * profile_side);
  const auto lowest = std::ranges::min_element(profile.cells, {}, &ProfileCell::cost);
  std::size_t asked = 0;
  for (const auto& cell : profile.cells) {
    const bool near = cell.cost <= 1.01 * std::min(profile.optimum, lowest->cost);
    asked += near;
    if (near) {
      EXPECT_NEAR(cell.cost_of_all / cell.cost, 1, 1e-4) << "the thinned table is the whole";
    } else if (&cell != &*lowest) {
      EXPECT_TRUE(std::isnan(cell.cost_of_all));
    }
  }
  EXPECT_GT(asked, 2U);
}

TEST(Profile, LeadsAFitOutOfAValleyThatIsNotTheLowest) {
  // Short tails by l2_cosine: the valley of long tails holds a fit that begins there.
  Posed p(gtr, "alpha=0.2,gamma=9.5,f0=0.2,kd=0.05");
  p.data = fit_data<double>(Sampling(p.table, p.table.bins(), Metric::l2_cosine, 0, true));
  auto off = p.truth.values;
  const auto value = [&](const char* name) -> double& {
    return off[p.problem.start.model.find(name)->first];
  };
  value("alpha") = 0.076;
  value("gamma") = 1.9;
  value("kd") = 0;
  Fitted f = p.fitted_from(off);
  const double lost = f.solution.at.cost, best = p.fitted_from(p.truth.values).solution.at.cost;
  ASSERT_GT(lost, 2 * best);
  const Profile profile = gonio::profile(p.problem, p.data, p.data, p.data, f);
  EXPECT_GE(profile.moves, 1);
  EXPECT_EQ(f.values, p.data.counts.samples) << "what judges need of a fit moves with it";
  EXPECT_EQ(f.groups, p.data.groups);
  EXPECT_NEAR(f.solution.at.cost / best, 1, 1e-6);
  for (const auto& cell : profile.cells)
    if (!std::isnan(cell.cost_of_all)) {
      EXPECT_GE(cell.cost_of_all, best * (1 - 1e-6));
    }
}

TEST(Profile, IsTheSameForAnyNumberOfThreads) {
  const auto cells_of = [](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    const Posed p(gtr, "alpha=0.3,gamma=3,f0=0.1,kd=0.2");
    Fitted f = p.fitted_from(p.truth.values);
    std::vector<double> costs;
    for (const auto& c : gonio::profile(p.problem, p.data, p.data, p.data, f).cells)
      costs.push_back(c.cost);
    return costs;
  };
  EXPECT_EQ(cells_of(1), cells_of(4));
}

TEST(Certificate, OfAFitSaysThatItWasSearched) {
  const Posed p(paint, "alpha=0.2,f0=0.3,kd=0.1");
  FitOptions o = p.options;
  EXPECT_FALSE(fit(p.table, o).document.certificate);
  o.certificate = Certify::automatic;
  const auto d = fit(p.table, o).document;
  ASSERT_TRUE(d.certificate);
  EXPECT_EQ(d.certificate->evidence, "searched");
  EXPECT_EQ(d.certificate->parameters, std::vector<std::string>{"alpha"});
  EXPECT_GE(d.certificate->lowest, d.cost * (1 - 1e-6));
  EXPECT_EQ(d.certificate->cells.size(), profile_cells);
  o.model = "lambert";
  const auto flat = fit(p.table, o).document;
  EXPECT_EQ(flat.certificate->evidence, "open");
  EXPECT_TRUE(flat.certificate->cells.empty());
  EXPECT_TRUE(std::isnan(flat.certificate->lowest));
}

}  // namespace
}  // namespace gonio
