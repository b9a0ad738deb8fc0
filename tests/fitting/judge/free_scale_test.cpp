// Tables that are known up to one factor: widths and ratios hold, whatever it is.
#include "fitting/judge/free_scale.h"

#include <cmath>
#include <random>

#include "base/error.h"
#include "brdf/model/evaluate.h"
#include "fitting/fit.h"
#include "fitting/support.h"
#include "refusal.h"
#include "table/format/measured_by.h"
#include "tables.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

using namespace test;

constexpr const char* schlick = "lambert+ggx/smith_ggx.correlated/schlick";

FitOptions free_scale(const char* model = schlick) {
  return {.model = model, .bin_sensitivity = false, .scale = Scale::free};
}

TEST(FreeScale, LeavesRatiosAndWidthsThatHold) {
  const BoundModel truth = test::bind(schlick, "alpha=0.2,f0=0.05,kd=0.3,0.2,0.1", 3);
  const Table f = synthesize(truth, {.layout = Layout::hemisphere, .noise = 0.02});
  for (const double counts : {4e4, 1e-6}) {
    Table t = f;
    scale_values(t, counts);
    const FitResult fitted = fit(t, free_scale());
    const FitDocument& d = fitted.document;
    EXPECT_EQ(d.model, std::string(schlick) + ".weighted");
    const auto& alpha = parameter(d, "alpha");
    EXPECT_LE(alpha.ci95_low[0], 0.2 * 1.002) << counts;
    EXPECT_GE(alpha.ci95_high[0], 0.2 * 0.998) << counts;
    for (const char* name : {"kd", "weight"})
      for (std::size_t c = 0; c < parameter(d, name).value.size(); ++c) {
        EXPECT_EQ(parameter(d, name).status[c], ParameterStatus::not_identifiable);
        EXPECT_TRUE(std::isnan(parameter(d, name).value[c]));
        EXPECT_HAS(parameter(d, name).reason[c], "the scale is free");
      }
    ASSERT_EQ(d.ratios.value().size(), 3U);
    const auto value_of = [](const std::string& name) {
      return name == "kd.r" ? 0.3 : name == "kd.g" ? 0.2 : name == "kd.b" ? 0.1 : 1.0;
    };
    for (const auto& r : *d.ratios) {
      const double ratio = value_of(r.of) / value_of(r.to);
      EXPECT_LT(r.ci95_low, ratio * 1.002) << r.of;
      EXPECT_GT(r.ci95_high, ratio * 0.998) << r.of;
      EXPECT_LT(r.ci95_high / r.ci95_low, 1.05) << r.of;
    }
    EXPECT_HAS(d.warnings[0], "the scale is free");
    for (const auto& w : d.warnings) EXPECT_EQ(w.find("the table returns"), w.npos) << w;
    EXPECT_NEAR(d.residuals.log_rms, 0.02, 0.001);
    const SampleAngles at(t);
    const double here = evaluate(fitted.model, std::vector{at.frame(0)})[1][0];
    EXPECT_NEAR(here / t.values[1][0], 1, 0.1) << "the fitted model is in the table's own counts";
    EXPECT_TRUE(d.physics.model_albedo.empty());
  }
}

TEST(FreeScale, BringsHighlightsWithoutABaseWithinRange) {
  const BoundModel truth = test::bind(schlick, "alpha=0.01,f0=0.8,kd=0.00002", 1);
  Table t = synthesize(truth, {.layout = Layout::hemisphere, .noise = 0.02});
  scale_values(t, 1000);
  const FitDocument d = fit(t, free_scale()).document;
  EXPECT_NEAR(parameter(d, "alpha").value[0], 0.01, 0.0002);
  EXPECT_NEAR(d.residuals.log_rms, 0.02, 0.002);
}

TEST(FreeScale, IsRefusedWhereAFactorIsNoneOfTheModels) {
  for (const char* model : {"eon", "lambert.coupled+ggx/smith_ggx.correlated/schlick"})
    EXPECT_HAS(refusal([&] { with_weights(free_scale(model)); }, Exit::usage), "scale free")
        << model;
  FitOptions held = free_scale();
  held.fixed = {{"kd", {0.3}}};
  EXPECT_HAS(refusal([&] { with_weights(held); }, Exit::usage), "kd given");
  EXPECT_EQ(with_weights(free_scale("lambert")).model, "lambert");
}

TEST(FreeScale, LeavesWhatItChangesUnboundedWhereAModelLacksIt) {
  for (const double scale : {1.0, 3.0}) {
    Table t = synthesize(test::bind(schlick, "alpha=0.2,f0=0.05,kd=0.1", 1),
                         {.layout = Layout::in_plane, .noise = 0.02});
    t.truth = {};
    scale_values(t, scale);
    const FitDocument d = fit(t, {.model = schlick}).document;
    EXPECT_EQ(d.misfit.told, scale > 1);
    const auto& kd = parameter(d, "kd");
    EXPECT_EQ(kd.status[0], scale > 1 ? ParameterStatus::unbounded : ParameterStatus::free);
    if (scale > 1) {
      EXPECT_HAS(kd.reason[0], "at another");
      EXPECT_EQ(kd.ci95_high[0], 1);
    }
  }
}

TEST(FreeScale, WidensIntervalsOfAModelThatLacksIt) {
  // A mirror that returns three times the light: its width makes up for some of it.
  const BoundModel truth = test::bind("ggx/smith_ggx.correlated/schlick", "alpha=0.2,f0=0.7", 1);
  for (const double scale : {1.0, 3.0}) {
    Table t;
    t.format = "csv";
    t.channels = {"f"};
    DirectionList l;
    for (int k = 0; k < 10; ++k)
      for (double out = -80; out <= 80; out += 10) {
        l.theta_i_deg.push_back(10 + 60 * k / 9.0), l.phi_i_deg.push_back(0);
        l.theta_o_deg.push_back(std::abs(out)), l.phi_o_deg.push_back(out < 0 ? 0 : 180);
      }
    t.where = std::move(l);
    put_values(t, truth);
    std::mt19937_64 random(1);
    std::normal_distribution<double> noise(0, 0.02);
    for (double& f : t.values[0]) f *= scale * std::exp(noise(random));
    const FitDocument d = fit(t, {.model = "ggx/smith_ggx.correlated/schlick"}).document;
    const auto& alpha = parameter(d, "alpha");
    EXPECT_EQ(d.misfit.told, scale > 1);
    EXPECT_LE(alpha.ci95_low[0], 0.2) << scale;
    EXPECT_GE(alpha.ci95_high[0], 0.2) << scale;
    if (scale == 1) {
      EXPECT_LT(alpha.ci95_high[0] - alpha.ci95_low[0], 0.01);
    }
  }
}

}  // namespace
}  // namespace gonio
