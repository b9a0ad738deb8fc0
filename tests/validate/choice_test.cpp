// Choice of a model, as its file says it.
#include "validate/choice.h"

#include <cmath>
#include <filesystem>

#include "base/error.h"
#include "foreign/compile.h"
#include "optics/refractive_index.h"
#include "refusal.h"
#include "support.h"
#include "validate/words.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

using nlohmann::json;

json plain() {
  return {{"schema", "gonio.choice/1"},
          {"model", "ggx/schlick_ggx.half_alpha/schlick"},
          {"reference", "ggx/smith_ggx.correlated/schlick"},
          {"domain", {{"roughness", {0.1, 1}}, {"f0", 0.04}}},
          {"budgets", {{"albedo_error", 0.1}}}};
}
Choice parsed(const json& j) {
  return parse_choice("c.json", j.dump());
}
double value(const BoundModel& b, const std::string& name, std::size_t channel = 0) {
  return b.values[b.model.find(name)->slot(channel)];
}

TEST(Choice, IsReadWithWhatItLeavesOutAsTheDesignSays) {
  const Choice c = parsed(plain());
  EXPECT_EQ(c.shipped.model, "ggx/schlick_ggx.half_alpha/schlick");
  EXPECT_EQ(c.shipped.scattering, Bounces::single);
  EXPECT_EQ(c.number, Number::float_);
  EXPECT_TRUE(c.has_reference);
  EXPECT_EQ((*c.domain.f0)[0], 0.04);
  EXPECT_EQ((*c.domain.f0)[1], 0.04);
  EXPECT_FALSE(c.domain.mu);
  EXPECT_EQ(*c.budgets.albedo_error, 0.1);
  EXPECT_FALSE(c.budgets.ns);
}

TEST(Choice, NamesThePlaceOfWhatItDoesNotTake) {
  const auto refused = [](const std::string& pointer, const json& value, const std::string& line) {
    json j = plain();
    j[json::json_pointer(pointer)] = value;
    try {
      parsed(j);
      ADD_FAILURE() << pointer << " = " << value << " was taken";
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), Exit::bad_input);
      EXPECT_NE(std::string(e.what()).find(line), std::string::npos) << e.what();
      EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
    }
  };
  refused("/budgets", json::object(), "c.json: /budgets: found ");
  refused("/budgets/albedo_error", -1, "c.json: /budgets/albedo_error: found -1");
  refused("/budgets/speed", 1, "speed");
  refused("/model", "ggx/smith_gx/schlick", "c.json: /model: found ");
  refused("/parameters", {{"gamma", 2}},
          "c.json: /parameters/gamma: found 2, expected a parameter of "
          "ggx/schlick_ggx.half_alpha/schlick (");
  refused("/reference_parameters", {{"gamma", 2}}, "c.json: /reference_parameters/gamma: found 2");
  refused("/domain/roughness", {0.5, 0.2}, "c.json: /domain/roughness: found ");
  refused("/domain/mu", {0, 1}, "expected [low, high] within 0.0001 to 1, not [0, 1]");
  refused("/domain/metal", "unobtainium", "c.json: /domain/metal: found ");
  refused("/domain/eta", {1.3, 2}, "only one of eta, f0, metal and fits");
  refused("/number", "wide", "c.json: /number: found ");
  refused("/scattering", "walks", "c.json: /scattering: found ");
  refused("/schema", "gonio.choice/2", "c.json: /schema: found ");
  refused("/budgets/fresnel_error", 0.1, "eta or metal");
  refused("/budgets/ns", {{"limit", 2}, {"baseline", "gg"}},
          "c.json: /budgets/ns/baseline: found ");
  for (const auto& [name, value] :
       {std::pair("alpha", json(2)), std::pair("f0", json(-1)), std::pair("alpha", json(1e-9)),
        std::pair("alpha", json("wide"))})
    refused("/parameters", {{name, value}}, "c.json: /parameters");
  refused("/reference_parameters", {{"f0", 1.5}}, "c.json: /reference_parameters: found ");
  refused("/coating", "view", "c.json: /coating: found ");
  refused("/coating", "inside", "c.json: /coating: found ");
  refused("/model", "lambert+coat:ggx/smith_ggx.correlated/schlick", "view or both, beside a coat");
  std::string lobes = plain()["model"];
  for (int i = 1; i < 500; ++i) lobes += "+" + std::string(plain()["model"]);
  refused("/model", lobes, "16 lobes");
  for (const char* budget : {"fresnel_error", "energy_loss"}) {
    json j = {{"schema", "gonio.choice/1"}, {"model", "lambert"}, {"domain", {{"eta", 1.5}}}};
    j["budgets"][budget] = 0.1;
    EXPECT_THROW(parsed(j), Error) << budget << " of a model without a lobe";
  }
  json j = plain();
  j.erase("reference");
  EXPECT_THROW(parsed(j), Error) << "albedo_error compares with nothing";
}

TEST(Choice, NamesNoFileOutsideItsFolder) {
  const test::Folder f;
  f.write("key.glsl", "words that nobody shall see");
  std::filesystem::create_directory(f / "in");
  const auto refused = [&](const json& j) {
    return test::refusal([&] { parse_choice(f / "in/c.json", j.dump()); });
  };
  for (const std::string& name : {std::string("../key.glsl:brdf"), (f / "key.glsl") + ":brdf"}) {
    json j = plain();
    j["budgets"]["ns"] = {{"limit", 2}, {"baseline", name}};
    EXPECT_HAS(refused(j), "--follow-paths");
    for (const char* key : {"model", "reference"}) {
      json k = plain();
      k[key] = name;
      EXPECT_HAS(refused(k), "--follow-paths") << key;
    }
  }
}

TEST(Choice, LaysACoatOnDiffuseTermsAlone) {
  const auto refused = [](const char* model, const json& more, const std::string& line) {
    json j = plain();
    j["model"] = model;
    j["coating"] = "both";
    if (more.is_object()) j.update(more);
    try {
      parsed(j);
      ADD_FAILURE() << model << " was taken";
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), Exit::bad_input);
      EXPECT_NE(std::string(e.what()).find(line), std::string::npos) << e.what();
    }
  };
  const char* const good = "lambert+coat:ggx/smith_ggx.correlated/schlick";
  refused("coat:ggx/smith_ggx.correlated/schlick", {}, "what the model takes");
  refused("lambert.coupled+coat:ggx/smith_ggx.correlated/schlick", {}, "uncoupled");
  refused("lambert+ggx/smith_ggx.correlated/schlick+coat:ggx/smith_ggx.correlated/schlick", {},
          "DIFFUSE+coat:LOBE");
  refused("lambert+coat:ggx/smith_ggx.correlated/schlick+eon", {}, "what the model takes");
  refused("lambert+ggx/smith_ggx.correlated/coat:schlick", {}, "what the model takes");
  refused(good, {{"scattering", "turquin"}}, "c.json: /scattering: found ");
  for (const char* budget : {"energy_loss", "nonfinite", "operations", "table_bytes"})
    refused(good, {{"budgets", {{budget, 0}}}},
            std::string("c.json: /budgets/") + budget + ": found ");
  json j = plain();
  j["model"] = good;
  j["coating"] = "view";
  const Choice c = parsed(j);
  EXPECT_EQ(c.shipped.coating, Coating::view);
  EXPECT_EQ(to_text(c.shipped.spec()), "lambert+ggx/smith_ggx.correlated/schlick");
}

TEST(Choice, OfARangeHasBothEndsAndWhatLiesBetween) {
  json j = plain();
  j["domain"] = {{"eta", {1.3, 1.7}}};
  const auto all = substances(parsed(j));
  ASSERT_EQ(all.size(), 5U);
  EXPECT_EQ(all.front().name, "IOR 1.3");
  EXPECT_EQ(all[2].name, "IOR 1.5");
  EXPECT_EQ(all.back().name, "IOR 1.7");
  EXPECT_EQ(substances(parsed(plain())).size(), 1U);
}

TEST(Choice, GivesEachModelTheParametersOfTheSubstance) {
  json j = plain();
  j["domain"] = {{"roughness", {0.5, 1}}, {"metal", {"Au", "Fe"}}};
  j["reference"] = "ggx/smith_ggx.correlated/conductor";
  const Choice c = parsed(j);
  const auto all = substances(c);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].name, "gold");
  const auto shipped = bound(c, c.shipped, all[0], 0.5), exact = bound(c, c.reference, all[0], 0.5);
  EXPECT_EQ(value(shipped, "alpha"), 0.25);
  const Index green = find_metal("Au")->rgb()[1];
  EXPECT_EQ(value(exact, "eta", 1), green.n);
  EXPECT_EQ(value(exact, "k", 1), green.k);
  EXPECT_NEAR(value(shipped, "f0", 1), f0_of_index(green), 1e-12);
  EXPECT_GT(value(shipped, "f0", 0), value(shipped, "f0", 2)) << "gold is yellow";
}

TEST(Choice, TakesPresetsByTheirOwnParametersOrByThoseOfTheirTerms) {
  json j = plain();
  j["model"] = "gltf";
  j["reference"] = "disney";
  j["budgets"]["ns"] = {{"limit", 2}, {"baseline", "ue_mobile"}};
  const Choice by_terms = parsed(j);
  const auto b = bound(by_terms, by_terms.shipped, substances(by_terms)[0], 0.5);
  EXPECT_EQ(value(b, "alpha"), 0.25);
  EXPECT_EQ(value(b, "f0"), 0.04);
  j["domain"].erase("f0");
  j["parameters"] = j["reference_parameters"] = {{"base_color", {0.8, 0.4, 0.2}}, {"metallic", 1}};
  j["alpha"] = "roughness";
  const Choice own = parsed(j);
  const auto metal = bound(own, own.shipped, substances(own)[0], 0.25);
  EXPECT_EQ(value(metal, "alpha"), 0.25);
  EXPECT_EQ(value(metal, "f0", 1), 0.4);
  EXPECT_NEAR(value(bound(own, own.reference, substances(own)[0], 0.5), "f0", 0), 0.8, 1e-12);
  j["parameters"]["f0"] = 0.5;
  EXPECT_THROW(parsed(j), Error) << "base_color says it already";
}

TEST(Choice, MapsRoughnessToTheWidthAsItSays) {
  json j = plain();
  const auto alpha = [&](const char* map) {
    j["alpha"] = map;
    const Choice c = parsed(j);
    return value(bound(c, c.shipped, substances(c)[0], 0.5), "alpha");
  };
  EXPECT_EQ(alpha("roughness"), 0.5);
  EXPECT_EQ(alpha("roughness^2"), 0.25);
  EXPECT_EQ(alpha("roughness^4"), 0.0625);
  j["parameters"] = {{"alpha", 0.3}};
  EXPECT_EQ(alpha("roughness^2"), 0.3) << "what the choice sets is not the domain's";
}

/// Values of a parameter that each side has at a roughness of 0.5.
std::pair<double, double> both(const json& j, const std::string& name) {
  const Choice c = parsed(j);
  const auto of = [&](const Shipped& s) { return value(bound(c, s, substances(c)[0], 0.5), name); };
  return {of(c.shipped), of(c.reference)};
}
using Pair = std::pair<double, double>;

TEST(Choice, GivesWhatModelAndReferenceShareToBoth) {
  json j = plain();
  j["model"] = "lambert+" + std::string(plain()["model"]);
  j["reference"] = "lambert+" + std::string(plain()["reference"]);
  j["parameters"] = {{"kd", 0.5}};
  EXPECT_EQ(both(j, "kd"), Pair(0.5, 0.5));
  j["reference_parameters"] = {{"kd", 0.3}};
  EXPECT_EQ(both(j, "kd"), Pair(0.5, 0.3)) << "the reference's own";
  j["reference_parameters"] = json::object();
  j["parameters"]["alpha"] = 0.09;
  EXPECT_EQ(both(j, "alpha"), Pair(0.09, 0.25)) << "the domain says the reference's roughness";
  j["domain"].erase("roughness");
  EXPECT_EQ(both(j, "alpha"), Pair(0.09, 0.09));
  j["parameters"] = {{"roughness", 0.5}};
  EXPECT_EQ(both(j, "alpha"), Pair(0.25, 0.25)) << "by another name";
  j["reference_parameters"] = {{"alpha", 0.04}};
  EXPECT_EQ(both(j, "alpha"), Pair(0.25, 0.04)) << "the reference sets the same by another name";
}

TEST(Choice, GivesAParameterToTheOnlySideThatKnowsIt) {
  json j = plain();
  j["reference"] = "gtr/smith_gtr.correlated/schlick";
  j["parameters"] = {{"gamma", 1.5}};
  const Choice c = parsed(j);
  EXPECT_EQ(value(bound(c, c.reference, substances(c)[0], 0.5), "gamma"), 1.5);
  EXPECT_TRUE(c.shipped.parameters.empty());
  j["parameters"]["gamma"] = 1e9;
  EXPECT_THROW(parsed(j), Error);
}

TEST(Choice, RefusesADomainThatNothingReads) {
  const auto refused = [](const json& j) -> std::string {
    try {
      parsed(j);
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), Exit::bad_input);
      return e.what();
    }
    return "";
  };
  json j = plain();
  j["parameters"] = j["reference_parameters"] = {{"alpha", 0.3}};
  EXPECT_NE(refused(j).find("c.json: /domain/roughness: found "), std::string::npos) << refused(j);
  EXPECT_NE(refused(j).find("parameters sets alpha"), std::string::npos) << refused(j);
  j = plain();
  j["domain"]["f0"] = {0.04, 0.9};
  j["parameters"] = j["reference_parameters"] = {{"f0", 0.5}};
  EXPECT_NE(refused(j).find("c.json: /domain/f0: found "), std::string::npos) << refused(j);
  j["reference_parameters"] = json::object();
  EXPECT_EQ(refused(j), "") << "the reference has the domain's";
}

/// A choice of a shader that mixes F0 from its baseColor.
struct OfShader {
  test::Folder folder;
  json choice = plain();

  OfShader() {
    folder.write(
        "metal.glsl",
        "// Roughness 0.1 1 0.4\n// baseColor 0 1 0.6\n// metallic 0 1 0\n"
        "vec3 shade(vec3 n, vec3 v, vec3 l, vec3 baseColor, float metallic, float "
        "Roughness) {\n  vec3 f0 = mix(vec3(0.04), baseColor, metallic);\n"
        "  return baseColor * (1.0 - metallic) / 3.1416 + f0 * Roughness * dot(n, l);\n}\n");
    choice["model"] = "metal.glsl:shade";
    choice["reference"] = "lambert+ggx/smith_ggx.correlated/schlick";
    choice["domain"] = {{"roughness", {0.2, 1}}};
  }
  /// Every parameter of the model, then of the reference, as it is printed; or the refusal.
  std::string printed() const {
    std::string all;
    try {
      const Choice c = parse_choice(folder / "c.json", choice.dump());
      for (const auto* side : {&c.shipped, &c.reference})
        for (const auto& p : used_parameters(c, *side)) all += p.name + " " + value_text(p) + "; ";
    } catch (const Error& e) {
      all = e.what();
    }
    return all;
  }
};

TEST(Choice, GivesAShaderItsOwnColourAndMetallicWhateverItsReferenceMakesOfThem) {
  if (!foreign::can_compile()) GTEST_SKIP() << "this build reads no shaders";
  OfShader of;
  of.choice["parameters"] = {{"baseColor", 0.3}, {"metallic", 0.5}};
  of.choice["reference_parameters"] = {{"kd", 0.3}, {"f0", 0.32}};
  EXPECT_HAS(of.printed(), "baseColor 0.3; metallic 0.5; Roughness from the domain");
  EXPECT_HAS(of.printed(), "kd 0.3; ");
  of.choice["reference_parameters"] = {{"base_color", 0.3}};
  EXPECT_HAS(of.printed(), "kd 0.15; ");
  of.choice["reference_parameters"] = {{"kd", 0.3}, {"f0", 0.32}};
  of.choice["parameters"] = {{"base_color", 0.1}, {"metallic", 0.5}};
  EXPECT_HAS(of.printed(), "/parameters/base_color: found ");
  EXPECT_HAS(of.printed(), "expected baseColor, as ");
  of.choice["parameters"] = {{"base_color", 0.1}, {"baseColor", 0.3}, {"metallic", 0.5}};
  EXPECT_HAS(of.printed(), "expected a parameter that reference_parameters does not set otherwise");
  of.choice["reference_parameters"] = json::object();
  EXPECT_HAS(of.printed(), "baseColor 0.3; metallic 0.5; ");
  EXPECT_HAS(of.printed(), "kd 0.05; ");
  of.choice["parameters"] = {{"baseColor", 0.3}, {"metallic", 0.5}};
  of.choice["reference"] = "lambert.metallic+ggx/smith_ggx.correlated/schlick.metallic";
  EXPECT_HAS(of.printed(), "base_color 0.3; ") << "the same letters";
}

TEST(Choice, AWidthThatItGivesAShaderIsUsedWhateverItsCase) {
  if (!foreign::can_compile()) GTEST_SKIP() << "this build reads no shaders";
  OfShader of;
  of.choice["parameters"] = {{"Roughness", 0.9}};
  EXPECT_HAS(of.printed(), "Roughness 0.9; ");
  EXPECT_HAS(of.printed(), "alpha from the domain");
  of.choice.erase("reference");
  of.choice["budgets"] = {{"energy_gain", 0.1}};
  EXPECT_HAS(of.printed(), "/domain/roughness: found ");
  EXPECT_HAS(of.printed(), "parameters sets Roughness");
}

TEST(Choice, SaysWhoSetsEachParameterOfASide) {
  json j = plain();
  j["model"] = "lambert+" + std::string(plain()["model"]);
  j["domain"]["f0"] = {0.04, 0.9};
  j["parameters"] = {{"kd", 0.5}};
  const Choice c = parsed(j);
  const auto used = used_parameters(c, c.shipped);
  using From = UsedParameter::From;
  const auto of = [&](const std::string& name) {
    return *std::ranges::find(used, name, &UsedParameter::name);
  };
  EXPECT_EQ(of("kd").from, From::choice);
  EXPECT_EQ(of("kd").values[0], 0.5);
  EXPECT_EQ(of("f0").from, From::domain);
  EXPECT_TRUE(of("f0").values.empty());
  EXPECT_EQ(of("alpha").from, From::domain);
  j["domain"] = json::object();
  const Choice bare = parsed(j);
  EXPECT_EQ(used_parameters(bare, bare.shipped)[1].from, From::default_value);
}

}  // namespace
}  // namespace gonio
