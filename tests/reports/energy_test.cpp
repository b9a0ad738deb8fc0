#include "reports/energy.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "integrate/directional_albedo.h"
#include "reports/energy_parts.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

const EnergyOptions few{false, {0.25, 0.5, 1}, {0.1, 0.5, 1}, 1024};
const auto unwatched = [](double) {};

EnergyReport of_forms(const std::vector<std::string>& names) {
  auto o = few;
  o.forms = names;
  EnergyReport r;
  add_forms(r, o, unwatched);
  return r;
}
const EnergyForm& form(const EnergyReport& r, std::string_view name) {
  return *std::ranges::find(r.forms, name, &EnergyForm::name);
}
const std::string correlated = "masking.smith_ggx.correlated",
                  separable = "masking.smith_ggx.separable", none = "masking.none";

const EnergyReport& materials() {
  static const EnergyReport report = [] {
    EnergyReport r;
    add_materials(r, few, unwatched);
    return r;
  }();
  return report;
}
const EnergyMaterial& material(std::string_view name) {
  return *std::ranges::find(materials().materials, name, &EnergyMaterial::name);
}

TEST(EnergyReport, KnowsWhatWhiteGgxLosesAtRoughnessOne) {
  const auto r = of_forms({correlated, separable});
  const auto& f = form(r, correlated);
  EXPECT_NEAR(f.rows.back().albedo, 1 - std::log(2.0), 1e-5);
  EXPECT_NEAR(1 - f.averages.back().albedo, 0.591, 5e-4);
  EXPECT_NEAR(1 - form(r, separable).averages.back().albedo, 0.623, 5e-4);
}

TEST(EnergyReport, LightIsMadeByNoMaskingAndByTheMobileFormsAlone) {
  std::set<std::string> makers;
  const auto r = of_forms({});
  for (const auto& f : r.forms)
    for (const auto& at : f.rows)
      if (at.albedo > 1 + 1e-4) makers.insert(f.name);
  EXPECT_EQ(makers,
            (std::set<std::string>{"masking.none", "masking.disney_coat", "masking.unity_mobile",
                                   "masking.unity_mobile.urp", "masking.ue_mobile_simple",
                                   "model.unity_mobile", "model.ue_mobile_simple"}));
}

TEST(EnergyReport, ALossPassesItsShareWhereItSays) {
  const auto r = of_forms({correlated});
  const auto& f = r.forms.at(0);
  std::size_t found = 0;
  for (const auto& c : f.crossings) {
    if (c.mu == 0 || !(c.roughness > 0)) continue;
    ++found;
    const auto loss = [&](double roughness) {
      const auto b = bind_model("ggx/smith_ggx.correlated/constant",
                                {{"roughness", {roughness}}, {"f0", {1}}}, 1);
      return 1 - directional_albedo(b, {&c.mu, 1})[0].value[0];
    };
    EXPECT_LT(loss(c.roughness - 0.002), c.share) << c.mu;
    EXPECT_GT(loss(c.roughness + 0.002), c.share) << c.mu;
  }
  EXPECT_GE(found, 5U);
}

TEST(EnergyReport, ALossThatIsThereFromTheStartPassesAtZeroAndOneThatNeverComesNowhere) {
  // at mu = 0.1: Schlick with k for direct light loses at once, no masking never
  const auto r = of_forms({"masking.schlick_ggx.direct", none});
  for (const auto& c : form(r, "masking.schlick_ggx.direct").crossings)
    EXPECT_TRUE(c.mu != 0.1 || c.roughness == 0);
  for (const auto& c : form(r, none).crossings) EXPECT_TRUE(c.mu != 0.1 || std::isnan(c.roughness));
}

TEST(EnergyReport, WhiteGivesAllBackAndTheOrdersSumToTheTruth) {
  for (const auto& at : material("F = 1").rows) EXPECT_NEAR(at.truth, 1, at.error + 1e-12);
  for (const auto& m : materials().materials)
    for (const auto& at : m.rows) {
      double sum = 0;
      for (const double e : at.orders) sum += e;
      EXPECT_NEAR(sum, at.truth, 1e-12) << m.name;
      EXPECT_LE(at.error, 1e-5);
    }
}

TEST(EnergyReport, CompensationsOfRoughMetalsAreNearerToTheTruthThanNone) {
  for (const auto* name : {"F = 1", "F0 = 0.9", "gold, red"})
    for (const auto& at : material(name).rows) {
      if (at.roughness < 0.5) continue;
      const double off = std::abs(at.scattering[0].albedo - at.truth);
      ASSERT_EQ(at.scattering[0].id, "single");
      for (std::size_t k = 1; k < at.scattering.size(); ++k)
        EXPECT_LT(std::abs(at.scattering[k].albedo - at.truth), off / 3)
            << name << " " << at.scattering[k].id << " " << at.roughness << " " << at.mu;
    }
}

TEST(EnergyReport, EveryEstimatorComesNearer) {
  EnergyReport r;
  add_estimators(r, few, unwatched);
  std::map<std::string, std::vector<EstimatorPoint>> by_name;
  for (const auto& e : r.estimators)
    by_name[std::string(e.estimator) + std::to_string(e.roughness)].push_back(e);
  EXPECT_EQ(by_name.size(), 15U);
  for (const auto& [name, points] : by_name) {
    EXPECT_LT(points.back().error, points.front().error / 2 + 1e-13) << name;
    for (const auto& p : points) {
      EXPECT_TRUE(p.bound == 0 || p.error <= p.bound + 1e-13) << name;
      EXPECT_GT(p.ns, 0) << name;
    }
  }
}

TEST(EnergyReport, RowsAreFlatAndHaveTheKeysOfTheContract) {
  const auto r = of_forms({correlated, separable});
  const auto j = nlohmann::json::parse(to_json(r));
  ASSERT_EQ(j["rows"].size(), 2U * 9U);
  for (const auto& row : j["rows"])
    for (const auto* key :
         {"ndf", "masking", "roughness", "mu", "albedo", "loss", "average", "error"})
      EXPECT_TRUE(row.contains(key)) << key;
  const auto& row = j["rows"][0];
  EXPECT_NEAR(row["albedo"].get<double>() + row["loss"].get<double>(), 1, 1e-5);
}

TEST(EnergyReport, FindingsAreMadeFromTheFigures) {
  auto r = of_forms({correlated, separable, none});
  add_findings(r);
  const auto said = [&](std::string_view words) {
    return std::ranges::any_of(r.findings,
                               [&](const std::string& f) { return f.find(words) != f.npos; });
  };
  EXPECT_TRUE(said("69.3\u00a0% at normal incidence and 59.1\u00a0% on average"));
  EXPECT_TRUE(said("masking.none (E = 5 at roughness 1, mu 0.1)"));
}

}  // namespace
}  // namespace gonio
