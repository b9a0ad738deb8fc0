#include "scene/plan/document.h"

#include "base/json/reader.h"
#include "refusal.h"
#include "scene/plan/scenes.h"
#include "support.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gonio::scene {
namespace {

using gonio::test::Folder;
using gonio::test::refusal;

Scene scene() {
  return test::sphere(test::red_plastic(), test::front());
}
const Plan& plan() {
  static const Plan p = plan_scene(
      scene(), {.samples = 512, .fresh = 1024, .directions = 1, .cost = Cost::operations});
  return p;
}
PlannedForms read_forms(const std::string& text, const Scene& s = scene()) {
  const Folder folder;
  return read_plan(folder.write("plan.json", text), s, {s.materials.begin(), s.materials.end()});
}
/// The document, changed.
std::string changed(auto&& change) {
  auto document = Json::parse(to_json(plan()));
  change(document);
  return document.dump();
}
Json& effect(Json& document, const std::string& name) {
  for (auto& e : document["materials"]["it"]["effects"])
    if (e["effect"] == name) return e;
  return document;
}

TEST(PlanDocument, GivesItsFormsBack) {
  const auto forms = read_forms(to_json(plan()));
  ASSERT_EQ(forms.by_material.size(), 1U);
  EXPECT_EQ(forms.by_material[0], plan().materials[0].forms);
}

TEST(PlanDocument, HasTheKeysOfTheContract) {
  const auto document = Json::parse(to_json(plan()));
  EXPECT_EQ(document["schema"], "gonio.plan/2");
  EXPECT_EQ(document["holds"], true);
  EXPECT_EQ(document["scene_sha256"], scene().sha256);
  const auto& m = document["materials"]["it"];
  for (const char* key : {"effects", "spec", "speedup", "error_quantile", "error_upper", "samples"})
    EXPECT_TRUE(m.contains(key)) << key;
  for (const auto& e : m["effects"])
    for (const char* key :
         {"effect", "keep", "form", "why", "error_if_dropped", "ns_saved", "ops_saved"})
      EXPECT_TRUE(e.contains(key)) << key;
}

TEST(PlanDocument, IsRefusedForAnotherScene) {
  Scene other = scene();
  other.sha256 = "of another";
  EXPECT_HAS(refusal([&] { read_forms(to_json(plan()), other); }), "/scene_sha256");
}

TEST(PlanDocument, IsRefusedWhereSpecAndFormsDisagree) {
  EXPECT_HAS(refusal([] {
               read_forms(changed([](Json& d) {
                 auto& e = effect(d, "fresnel");
                 e["keep"] = e["form"] != "exact";
                 e["form"] = e["keep"] ? "exact" : "schlick";
               }));
             }),
             "/materials/it/spec");
  EXPECT_HAS(refusal([] {
               read_forms(changed([](Json& d) { d["materials"]["it"]["spec"] = "lambert"; }));
             }),
             "/materials/it/spec");
}

TEST(PlanDocument, IsRefusedWhereKeepAndFormDisagree) {
  EXPECT_HAS(
      refusal([] { read_forms(changed([](Json& d) { effect(d, "diffuse")["keep"] = false; })); }),
      "/keep");
}

TEST(PlanDocument, IsRefusedWithAFormThatTheMaterialHasNot) {
  EXPECT_HAS(
      refusal([] { read_forms(changed([](Json& d) { effect(d, "tail")["form"] = "gtr"; })); }),
      "a form that this material offers: ggx");
}

TEST(PlanDocument, IsRefusedWithASetOfFormsThatNoEffectHas) {
  const auto with = [](const char* name, const char* form) {
    return refusal([&] {
      read_forms(changed([&](Json& d) {
        d["materials"]["it"]["front"][0]["forms"] = {{name, form}};
      }));
    });
  };
  EXPECT_HAS(with("tail", "ggx2"), "/materials/it/front/0/forms/tail");
  EXPECT_HAS(with("tails", "ggx"), "/materials/it/front/0/forms/tails");
}

TEST(PlanDocument, IsRefusedWithAnEffectTwice) {
  EXPECT_HAS(refusal([] {
               read_forms(changed([](Json& d) {
                 auto& e = d["materials"]["it"]["effects"];
                 e[1] = e[0];
               }));
             }),
             "each effect once");
}

TEST(PlanDocument, IsRefusedWithoutAMaterialOrWithOneTooMany) {
  EXPECT_HAS(refusal([] { read_forms(changed([](Json& d) { d["materials"] = Json::object(); })); }),
             "no 'it'");
  EXPECT_HAS(refusal([] {
               read_forms(changed([](Json& d) { d["materials"]["other"] = d["materials"]["it"]; }));
             }),
             "a material of the scene");
}

TEST(PlanDocument, IsRefusedOfALaterVersion) {
  EXPECT_HAS(refusal([] { read_forms(changed([](Json& d) { d["schema"] = "gonio.plan/3"; })); }),
             "gonio.plan/2");
}

TEST(PlanDocument, OfTheVersionBeforeIsRefusedWithTheCommandThatMakesANewOne) {
  const auto said = refusal([] {
    read_forms(changed([](Json& d) {
      d["schema"] = "gonio.plan/1";
      d.erase("holds");
    }));
  });
  EXPECT_HAS(said, "/schema");
  EXPECT_HAS(said, "gonio plan SCENE -o PLAN");
}

TEST(PlanDocument, NamesItsReferenceAndClaimsABoundOnlyOfWalks) {
  const Json made = Json::parse(to_json(plan()));
  const auto& m = made["materials"]["it"];
  EXPECT_EQ(m["reference"], "tabulated");
  EXPECT_TRUE(m.contains("error_upper") && m.contains("exceeding_bound"));
  const Scene s = test::sphere(
      test::material("gtr/smith_gtr.correlated/schlick", {"gamma=1.5", "alpha=0.3", "f0=0.9"}),
      test::front());
  const auto gtr =
      plan_scene(s, {.samples = 512, .fresh = 1024, .directions = 1, .cost = Cost::operations});
  const auto text = to_json(gtr);
  const Json document = Json::parse(text);
  const auto& other = document["materials"]["it"];
  EXPECT_EQ(other["reference"], "kulla_conty");
  EXPECT_FALSE(other.contains("error_upper") || other.contains("exceeding_bound"));
  for (const auto& set : other["front"]) EXPECT_FALSE(set.contains("error_upper"));
  EXPECT_EQ(read_forms(text, s).by_material[0], gtr.materials[0].forms);
}

}  // namespace
}  // namespace gonio::scene
