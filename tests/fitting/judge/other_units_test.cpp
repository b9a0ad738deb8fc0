// The unit that is named is the one that mends the fit best.
#include "fitting/judge/other_units.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "fitting/fit.h"
#include "fitting/support.h"
#include "table/format/measured_by.h"
#include "tables.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

FitDocument fit_of_scaled(const char* model, const char* settings, double scale) {
  Table t =
      synthesize(test::bind(model, settings, 1), {.layout = Layout::hemisphere, .noise = 0.01});
  t.truth.reset();  // as if measured
  scale_values(t, scale);
  FitOptions o;
  o.model = model;
  o.certificate = Certify::automatic;  // then units are tried
  return fit(t, o).document;
}

TEST(OtherUnit, OfAnyScaleIsAFreeOneAndNoUnitIsGuessedBesideIt) {
  for (const double scale : {4321.0, 100.0, 17.0}) {
    const auto d =
        fit_of_scaled("ggx/smith_ggx.correlated/conductor", "alpha=0.15,eta=1.2,k=5", scale);
    ASSERT_FALSE(d.next.empty()) << scale;
    EXPECT_TRUE(d.next[0].starts_with("--scale free")) << d.next[0];
    for (const auto& w : d.warnings) {
      EXPECT_EQ(w.find("radiance factor"), w.npos) << w;
      EXPECT_EQ(w.find("counts?"), w.npos) << w;
    }
    EXPECT_TRUE(std::ranges::any_of(
        d.warnings, [](const auto& w) { return w.starts_with("the table returns"); }));
  }
}

TEST(OtherUnit, OfRadianceFactorsIsThatThoughOthersDoAsWell) {
  const auto d = fit_of_scaled("lambert", "kd=0.4", std::numbers::pi);
  ASSERT_FALSE(d.next.empty());
  EXPECT_TRUE(d.next[0].starts_with("values may be radiance factors:")) << d.next[0];
}

TEST(OtherUnit, IsNamedWholeThoughItsCosineShowsWithoutAFit) {
  Table t = synthesize(
      test::bind("lambert+ggx/smith_ggx.correlated/schlick", "alpha=0.3,f0=0.05,kd=0.3", 1),
      {.layout = Layout::hemisphere, .noise = 0.01});
  t.truth.reset();  // as if measured
  const SampleAngles at(t);
  for (std::size_t i = 0; i < t.size(); ++i) t.values[0][i] *= std::numbers::pi * at(i).nov;
  FitOptions o;
  o.model = "lambert+ggx/smith_ggx.correlated/schlick";
  o.certificate = Certify::automatic;
  const auto d = fit(t, o).document;
  ASSERT_FALSE(d.next.empty());
  EXPECT_TRUE(d.next[0].starts_with("values may be pi f cos(theta_o):")) << d.next[0];
}

TEST(OtherUnit, OfATableIsToldThoughAScaleOfEachAzimuthTakesMuchOfItUp) {
  const char* const paint = "lambert+ggx/smith_ggx.correlated/schlick";
  for (const double scale : {1.0, std::numbers::pi})
    for (const unsigned seed : {1U, 2U, 9U}) {
      Table t;
      t.format = "csv";
      t.channels = {"f"};
      DirectionList l;
      for (int in = 10; in <= 80; in += 10)
        for (int out = 0; out <= 80; out += 10)
          for (int phi = 0; phi <= (out > 0 ? 180 : 0); phi += 15) {
            l.theta_i_deg.push_back(in), l.phi_i_deg.push_back(0);
            l.theta_o_deg.push_back(out), l.phi_o_deg.push_back(phi);
          }
      t.where = std::move(l);
      test::put_values(t, test::bind(paint, "alpha=0.4,f0=0.04,kd=0.05", 1));
      std::mt19937_64 random(seed);
      std::normal_distribution<double> normal;
      for (double& f : t.values[0]) f *= scale * std::exp(0.01 * normal(random));
      FitOptions o;
      o.model = paint;
      o.certificate = Certify::automatic;
      const auto d = fit(t, o).document;
      EXPECT_EQ(d.misfit.told, scale > 1) << seed;
      EXPECT_EQ(!d.next.empty() && d.next[0].starts_with("values may be radiance factors:"),
                scale > 1)
          << seed;
    }
}

TEST(OtherUnit, OfAModelWithoutWeightsIsNoneWhereAnotherScaleMendsMore) {
  Table t = synthesize(test::bind("eon", "kd=0.4,r=0.5", 1), {.layout = Layout::hemisphere});
  t.truth.reset();
  scale_values(t, 4321);
  FitOptions o;
  o.model = "eon";
  // Of values that are too bright in any unit, and are all met where they are dark.
  const auto attempt = [](const Table& as, const FitOptions&) {
    return std::ranges::max(as.values[0]) < 0.02 ? 0.01 : 1.5;
  };
  EXPECT_FALSE(other_unit(t, o, 7, attempt));
}

}  // namespace
}  // namespace gonio
