// Model and table side by side: the light that they return, and how high they rise.
#include "fitting/judge/physics.h"

#include <algorithm>
#include <cmath>

#include "fitting/fit.h"
#include "fitting/judge/warnings.h"
#include "fitting/support.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

constexpr const char* paint = "lambert+ggx/smith_ggx.correlated/schlick";

TEST(Physics, OfTheTrueModelIsThatOfTheTable) {
  const auto truth = test::bind(paint, "alpha=0.3,f0=0.05,kd=0.2,0.1,0.05", 3);
  for (const Layout layout : {Layout::mbsdf, Layout::hemisphere}) {
    const Table t = synthesize(truth, {.layout = layout});
    TableFacts facts(t);
    const auto p =
        check_physics(truth, facts, fit_data<double>(Sampling(t, t.bins(), Metric::log, 0, false)));
    ASSERT_GE(p.theta_i_deg.size(), 5U);
    for (std::size_t k = 0; k < 5; ++k)  // further down the highlight is too narrow for the samples
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(p.data_albedo[k][c] / p.model_albedo[k][c], 1, 0.1)
            << name_of(layout) << " " << p.theta_i_deg[k];
    for (const double r : p.peak_ratio) EXPECT_NEAR(r, 1, 1e-5);
  }
}

TEST(Physics, OfATableWithoutHemispheresKnowsTheModelAlone) {
  const auto truth = test::bind("lambert", "kd=0.25", 1);
  const Table t = test::list_of({0.1, 0.1, 0.1, 0.05});
  TableFacts facts(t);
  const auto p =
      check_physics(truth, facts, fit_data<double>(Sampling(t, t.bins(), Metric::log, 0, false)));
  EXPECT_EQ(p.theta_i_deg, (std::vector<double>{0, 15, 30, 45, 60, 75}));
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_NEAR(p.model_albedo[k][0], 0.25, 1e-4);
    EXPECT_TRUE(std::isnan(p.data_albedo[k][0]));
  }
  EXPECT_NEAR(p.peak_ratio[0], 0.25 / M_PI / 0.1, 1e-6);
}

TEST(Physics, IsWarnedOfWhereMoreLightComesBackThanArrived) {
  for (const auto& [settings, too_much] :
       {std::pair{"alpha=0.3,f0=0.15,kd=0.98", true}, {"alpha=0.3,f0=0.05,kd=0.5", false}}) {
    // Uncoupled, a lobe adds to a diffuse reflectance of nearly 1.
    const Table t = synthesize(test::bind(paint, settings, 3), {.layout = Layout::hemisphere});
    const auto d = fit(t, {}).document;
    EXPECT_EQ(returns_too_much(d.physics), too_much);
    EXPECT_EQ(physics_in_words(d.physics, false).size(), too_much ? 1U : 0U);
    const auto words = physics_in_words(d.physics, false);
    EXPECT_EQ(d.warnings.size(), 2 * words.size()) << "the table's own light comes first";
    EXPECT_TRUE(std::ranges::equal(words, std::span(d.warnings).last(words.size())));
  }
}

TEST(Physics, IsWarnedOfWhereTheModelRisesAboveTheTable) {
  const auto truth = test::bind(paint, "alpha=0.05,f0=0.05,kd=0.2", 3);
  const auto sentences = [&](double most) {
    Table t = synthesize(truth, {.layout = Layout::in_plane});
    for (auto& plane : t.values)
      for (double& v : plane) v = std::min(v, most);  // a detector at its limit
    FitOptions o;
    o.fixed = {{"alpha", {0.05}}, {"f0", {0.05}}};
    const auto d = fit(t, o).document;
    EXPECT_EQ(d.physics.peak_ratio[0] > 1.5, most < 1);
    const auto words = physics_in_words(d.physics, false);
    for (const auto& w : words) EXPECT_EQ(std::ranges::count(d.warnings, w), 1) << w;
    return words.size();
  };
  EXPECT_EQ(sentences(1e9), 0U);
  EXPECT_EQ(sentences(0.5), 1U);
}

TEST(Physics, IsWarnedOfWhereAModelThatMissesTheTableHasALowerPeak) {
  Physics p;
  p.peak_ratio = {0.1, 0.09};
  EXPECT_EQ(physics_in_words(p, false).size(), 0U);
  EXPECT_EQ(physics_in_words(p, true),
            std::vector<std::string>{
                "at the table's own samples the model's greatest value is 0.1 times the table's"});
}

}  // namespace
}  // namespace gonio
