// Defects that renderers shipped: each as a choice that breaks its budget, and mended as one that
// keeps it.
#include <algorithm>

#include "brdf/catalogue/masking_shape.h"
#include "brdf/catalogue/registry.h"
#include "reports/validate/measure.h"
#include "reports/validate/words.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

using nlohmann::json;

BudgetCheck checked(const json& choice) {
  json j = choice;
  j["schema"] = "gonio.choice/1";
  const auto v = validate(parse_choice("choice.json", j.dump()));
  EXPECT_EQ(v.budgets.size(), 1U);
  return v.budgets.at(0);
}
double at(const BudgetCheck& b, const std::string& name) {
  const auto x = std::ranges::find(b.at, name, &std::pair<std::string, double>::first);
  if (x == b.at.end()) throw std::out_of_range(name);
  return x->second;
}

const std::string smith = "ggx/smith_ggx.correlated/schlick";

TEST(Defects, RoughnessSquaredTwiceIsFound) {  // MaterialX 2642
  json j = {{"model", smith},
            {"reference", smith},
            {"alpha", "roughness^4"},
            {"domain", {{"roughness", {0.1, 1}}, {"f0", 0.9}}},
            {"budgets", {{"albedo_error", 0.01}}}};
  const auto b = checked(j);
  EXPECT_FALSE(b.holds) << sentence(b);
  EXPECT_GT(at(b, "roughness"), 0.5) << "a smooth surface and a mirror reflect alike";
  EXPECT_LT(at(b, "roughness"), 1) << "of 1 all powers are the same";
  j["alpha"] = "roughness^2";
  EXPECT_TRUE(checked(j).holds);
}

TEST(Defects, ASpecularLevelClampedAtItsRangeIsFound) {  // glTF-Blender-IO 2745
  json j = {{"model", smith},
            {"parameters", {{"f0", 0.08}}},
            {"reference", smith},
            {"reference_parameters", {{"f0", 0.16}}},
            {"domain", {{"roughness", {0.1, 1}}}},
            {"budgets", {{"albedo_error", 0.01}}}};
  const auto b = checked(j);
  EXPECT_FALSE(b.holds) << sentence(b);
  EXPECT_GT(b.found, 0.05);
  EXPECT_LT(b.found, 0.08) << "Schlick's F differs by no more than F0 does";
  EXPECT_NEAR(at(b, "roughness"), 0.1, 0.02) << "nothing is lost between facets";
  j["parameters"]["f0"] = 0.16;
  EXPECT_TRUE(checked(j).holds);
}

TEST(Defects, F0BlendedBeforeCompensationIsFoundForPartMetals) {  // bevy 23203
  const std::string weighted = "ggx/smith_ggx.correlated/schlick.weighted";
  const json both = {{"f0", 0.04},      {"weight", 0.5}, {"f0_2", 0.96},
                     {"weight_2", 0.5}, {"alpha", 0.8},  {"alpha_2", 0.8}};
  json j = {{"model", smith},
            {"parameters", {{"f0", 0.5}, {"alpha", 0.8}}},
            {"scattering", "turquin"},
            {"reference", weighted + "+" + weighted},
            {"reference_parameters", both},
            {"reference_scattering", "turquin"},
            {"domain", {{"mu", {0.05, 1}}}},
            {"budgets", {{"albedo_error", 0.01}}}};
  const auto b = checked(j);
  EXPECT_FALSE(b.holds) << sentence(b);
  EXPECT_GT(at(b, "mu"), 0);
  j["model"] = j["reference"];
  j["parameters"] = both;
  EXPECT_TRUE(checked(j).holds);
}

TEST(Defects, TheFourthPowerOfASmallRoughnessVanishesInHalf) {  // three.js 8349
  json j = {{"model", smith},
            {"number", "half"},
            {"domain", {{"roughness", 0.04}, {"f0", 0.04}, {"mu", {0.1, 1}}}},
            {"budgets", {{"nonfinite", 0}}}};
  const auto b = checked(j);
  EXPECT_FALSE(b.holds) << sentence(b);
  EXPECT_NEAR(at(b, "alpha"), 0.0016, 1e-5);
  j["number"] = "float";
  EXPECT_TRUE(checked(j).holds) << sentence(checked(j));
}

TEST(Defects, ACoatThatTakesNothingFromItsBaseIsReciprocalAndGainsEnergy) {
  json j = {{"model", "lambert+" + smith},
            {"parameters", {{"kd", 1}, {"f0", 0.04}}},
            {"domain", {{"roughness", {0.1, 1}}}},
            {"budgets", {{"reciprocity", 1e-9}}}};
  EXPECT_TRUE(checked(j).holds);
  j["budgets"] = {{"energy_gain", 1e-4}};
  const auto b = checked(j);
  EXPECT_FALSE(b.holds) << sentence(b);
  EXPECT_LT(at(b, "mu"), 0.2) << "F is greatest at grazing angles";
  j["model"] = "lambert.coupled+" + smith;
  EXPECT_FALSE(checked(j).holds) << "F of the half vector takes too little at grazing angles";
  j["parameters"]["kd"] = 0.15;
  EXPECT_TRUE(checked(j).holds) << sentence(checked(j));
}

TEST(Defects, NoReferenceOfTheCatalogueRaisesAnAlarm) {
  std::size_t seen = 0;
  for (const auto& ndf : catalogue()) {
    if (ndf.role() != Role::ndf || ndf.anisotropic || !ndf.about->reference().empty()) continue;
    for (const auto& masking : catalogue()) {
      if (masking.role() != Role::masking || masking.anisotropic ||
          !short_id(masking.id()).starts_with("smith_") ||
          shape_of_term(masking.id()) != shape_of_term(ndf.id()))
        continue;
      const auto spec =
          std::string(short_id(ndf.id())) + '/' + std::string(short_id(masking.id())) + "/schlick";
      // Berry's is GTR of γ = 1, which its masking has to know.
      json parameters = json::object();
      if (spec.starts_with("gtr1/")) parameters["gamma"] = 1;
      const json j = {
          {"schema", "gonio.choice/1"},
          {"model", spec},
          {"parameters", parameters},
          {"reference_parameters", parameters},
          {"reference", spec},
          {"domain", {{"roughness", 0.6}, {"f0", {0.04, 0.9}}, {"mu", {0.1, 1}}}},
          {"budgets", {{"albedo_error", 0}, {"energy_gain", 1e-3}, {"reciprocity", 1e-9}}}};
      const Choice c = parse_choice("choice.json", j.dump());
      for (const auto& check : validating::checks_of(c, validating::coarse)) {
        const auto b = check.check({});
        EXPECT_TRUE(b.holds) << spec << ": " << sentence(b);
      }
      ++seen;
    }
  }
  EXPECT_GE(seen, 4U);
}

}  // namespace
}  // namespace gonio
