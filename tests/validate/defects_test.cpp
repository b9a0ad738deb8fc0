// Defects that renderers shipped: each as a choice that breaks its budget, and mended as one that
// keeps it.
#include <algorithm>
#include <fstream>

#include "brdf/catalogue/masking_shape.h"
#include "brdf/catalogue/registry.h"
#include "brdf/model/evaluate.h"
#include "geometry/half_difference.h"
#include "integrate/rule/quadrature.h"
#include "support.h"
#include "validate/checks.h"
#include "validate/measure.h"
#include "validate/words.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

using nlohmann::json;

/// A choice of docs/defect.
json shipped(const std::string& name) {
  std::ifstream in(test::project_folder() + "/docs/defect/" + name + ".json");
  return json::parse(in);
}
BudgetCheck checked(const json& choice) {
  json j = choice;
  j["schema"] = "gonio.choice/1";
  const auto v = validate(parse_choice("choice.json", j.dump()));
  EXPECT_GE(v.budgets.size(), 1U);
  return v.budgets.at(0);
}

TEST(Defects, RoughnessSquaredTwiceIsFound) {  // MaterialX 2642
  json j = shipped("roughness_squared_twice");
  const auto b = checked(j);
  EXPECT_FALSE(b.holds) << sentence(b);
  EXPECT_GT(at(b, "roughness"), 0.5) << "a smooth surface and a mirror reflect alike";
  EXPECT_LT(at(b, "roughness"), 1) << "of 1 all powers are the same";
  j["alpha"] = "roughness^2";
  EXPECT_TRUE(checked(j).holds);
}

TEST(Defects, ASpecularLevelClampedAtItsRangeIsFound) {  // glTF-Blender-IO 2745
  json j = shipped("specular_level_clamped");
  const auto b = checked(j);
  EXPECT_FALSE(b.holds) << sentence(b);
  EXPECT_GT(b.found, 0.05);
  EXPECT_LT(b.found, 0.08) << "Schlick's F differs by no more than F0 does";
  EXPECT_NEAR(at(b, "roughness"), 0.1, 0.02) << "nothing is lost between facets";
  j["parameters"]["f0"] = 0.16;
  EXPECT_TRUE(checked(j).holds);
}

TEST(Defects, F0BlendedBeforeCompensationIsFoundForPartMetals) {  // bevy 23203
  json j = shipped("f0_blended_before_compensation");
  const auto b = checked(j);
  EXPECT_FALSE(b.holds) << sentence(b);
  EXPECT_GT(at(b, "mu"), 0);
  j["model"] = j["reference"];
  j["parameters"] = j["reference_parameters"];
  EXPECT_TRUE(checked(j).holds);
}

TEST(Defects, TheFourthPowerOfASmallRoughnessVanishesInHalf) {  // three.js 8349
  json j = shipped("fourth_power_in_half");
  const auto b = checked(j);
  EXPECT_FALSE(b.holds) << sentence(b);
  EXPECT_NEAR(at(b, "alpha"), 0.0016, 1e-5);
  EXPECT_GT(b.found, 1000) << "each of them is counted";
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

TEST(Defects, ACoatThatTakesFromBothSidesFailsTheFurnaceOfAFixedView) {  // openpbr-bsdf 30
  json j = shipped("reciprocal_coat");
  auto v = validate(parse_choice("choice.json", j.dump()));
  ASSERT_EQ(v.budgets.size(), 2U);
  EXPECT_FALSE(v.budgets[0].holds) << "the furnace";
  EXPECT_GT(v.budgets[0].found, 0.05);
  EXPECT_GT(at(v.budgets[0], "mu"), 0.9)
      << "the coat's own light makes up for it at grazing angles";
  EXPECT_TRUE(v.budgets[1].holds) << sentence(v.budgets[1]);
  j["coating"] = "view";
  v = validate(parse_choice("choice.json", j.dump()));
  EXPECT_TRUE(v.budgets[0].holds) << sentence(v.budgets[0]);
  EXPECT_FALSE(v.budgets[1].holds) << "the budgets conflict";
}

TEST(Defects,
     AFormThatDividesByAVanishingCosineHasNoValueInHalf) {  // of the kind of openpbr-bsdf 33
  json j = shipped("no_value_at_grazing");
  const auto b = checked(j);
  EXPECT_FALSE(b.holds) << sentence(b);
  EXPECT_LT(at(b, "nol") * at(b, "nov"), 1e-4) << "both graze";
  EXPECT_GT(at(b, "alpha"), 0.2501) << "not of the first roughness alone";
  EXPECT_NEAR(at(b, "cos_phi"), -1, 0.1) << "from opposite sides";
  j["model"] = smith;
  EXPECT_TRUE(checked(j).holds) << sentence(checked(j));
  j["model"] = "ggx/unity_mobile/schlick";
  j["number"] = "float";
  EXPECT_TRUE(checked(j).holds) << sentence(checked(j));
}

/// Albedo of a model as a plain sum over the hemisphere.
double summed_albedo(const BoundModel& b, double mu) {
  const auto nodes = cosine_hemisphere(200, 200);
  std::vector<FrameAngles<double>> angles;
  for (const auto& n : nodes)
    angles.push_back(frame_angles({n.direction, direction(std::acos(mu), 0)}));
  const auto f = evaluate(b, angles);
  double sum = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) sum += nodes[i].weight * f[0][i];
  return sum;
}

TEST(Defects, EnergyThatAFormulaGainsIsTheFormulasOwn) {
  struct Case {
    std::string model;
    json parameters;
    double white;  ///< F0 at which the sum is taken
    const char* why;
  };
  for (const auto& [model, parameters, white, why] :
       {Case{
            "lambert.coupled+" + smith, {{"kd", 1}, {"f0", 0.04}}, 0.04, "The diffuse term leaves"},
        Case{"gtr1/smith_gtr.correlated/schlick", json::object(), 1, "gamma 2"}}) {
    const auto b = checked({{"model", model},
                            {"parameters", parameters},
                            {"domain", {{"roughness", 0.6}, {"mu", {0.05, 1}}}},
                            {"budgets", {{"energy_gain", 1e-3}}}});
    EXPECT_FALSE(b.holds) << model;
    EXPECT_NE(b.words.find(why), b.words.npos) << b.words;
    std::vector<Setting> settings{{"alpha", {0.36}}, {"f0", {white}}};
    if (parameters.contains("kd")) settings.push_back({"kd", {1}});
    EXPECT_NEAR(b.found, summed_albedo(bind_model(model, settings, 1), at(b, "mu")) - 1, 2e-3)
        << model;
  }
}

TEST(Defects, NoReferenceOfTheCatalogueRaisesAnAlarm) {
  std::size_t lobes = 0, diffuse = 0;
  const auto expect_quiet = [](const std::string& model, const json& parameters,
                               const char* substance) {
    json j = {{"schema", "gonio.choice/1"},
              {"model", model},
              {"parameters", parameters},
              {"reference_parameters", parameters},
              {"reference", model},
              {"domain", {{"roughness", 0.6}, {"mu", {0.1, 1}}}},
              // Hammon's fit of what bounces below gains 3 % at kd = 1: docs/document/choice.md.
              {"budgets",
               {{"albedo_error", 0},
                {"energy_gain", model == "hammon" ? 0.04 : 1e-3},
                {"reciprocity", 1e-9}}}};
    if (std::getenv("GONIO_LONG")) j["budgets"]["nonfinite"] = 0;  // a proof each
    if (std::string_view(substance) == "eta") j["domain"]["eta"] = {1.2, 2};
    if (std::string_view(substance) == "metal") j["domain"]["metal"] = {"Au", "Fe"};
    if (std::string_view(substance) == "f0") j["domain"]["f0"] = {0.04, 0.9};
    const Choice c = parse_choice("choice.json", j.dump());
    for (const auto& check : validating::checks_of(c, validating::coarse())) {
      const auto b = check.check({});
      EXPECT_TRUE(b.holds) << model << ": " << sentence(b);
    }
  };
  // Of each distribution that approximates no other, under Smith's masking of its own shape, with
  // exact Fresnel and Schlick's.
  for (const auto& ndf : catalogue()) {
    if (ndf.role() != Role::ndf || !ndf.about->reference().empty() || ndf.as_shipped) continue;
    for (const auto& masking : catalogue()) {
      if (masking.role() != Role::masking || masking.anisotropic != ndf.anisotropic ||
          !short_id(masking.id()).starts_with("smith_") || !masking.about->reference().empty() ||
          shape_of_term(masking.id()) != shape_of_term(ndf.id()))
        continue;
      const auto shape =
          std::string(short_id(ndf.id())) + '/' + std::string(short_id(masking.id())) + '/';
      // Berry's is GTR of γ = 1, which its masking has to know.
      const json parameters = shape.starts_with("gtr1/") ? json{{"gamma", 1}} : json::object();
      expect_quiet(shape + "schlick", parameters, "f0");
      if (ndf.anisotropic) continue;
      expect_quiet(shape + "dielectric", parameters, "eta");
      expect_quiet(shape + "conductor", parameters, "metal");
      ++lobes;
    }
  }
  for (const auto& term : catalogue())
    if (term.role() == Role::diffuse && !term.coupled && !term.as_shipped &&
        term.about->reference().empty()) {
      expect_quiet(std::string(short_id(term.id())), json{{"kd", 1}}, "");
      ++diffuse;
    }
  EXPECT_GE(lobes, 8U);
  EXPECT_GE(diffuse, 4U);
}

}  // namespace
}  // namespace gonio
