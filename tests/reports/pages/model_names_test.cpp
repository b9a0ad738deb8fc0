#include "brdf/model/model_names.h"

#include <set>

#include "fitting/choice/choice.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

using Names = std::vector<std::string>;

Names names(const Names& models) {
  return model_names(models);
}

TEST(ModelNames, SayDiffuseDistributionAndFresnel) {
  EXPECT_EQ(
      names({"lambert+ggx/smith_ggx.correlated/schlick", "lambert",
             "disney.coupled+ggx/smith_ggx.correlated/dielectric",
             "eon+beckmann/smith_beckmann.correlated/f82"}),
      (Names{"Lambert + GGX (Schlick)", "Lambert", "Disney's diffuse (coupled) + GGX (dielectric)",
             "Energy-preserving Oren–Nayar + Beckmann (F82-tint: Schlick's with an edge tint "
             "for metals)"}));
}

TEST(ModelNames, CountLobesThatAreAlike) {
  const std::string ggx = "ggx/smith_ggx.correlated/schlick",
                    gtr = "gtr/smith_ggx.correlated/schlick";
  EXPECT_EQ(names({ggx + "+" + ggx, gtr + "+" + ggx}),
            (Names{"two GGX (Schlick)", "GTR (Schlick) + GGX (Schlick)"}));
}

TEST(ModelNames, TellMaskingOnlyWhereItTellsThemApart) {
  EXPECT_EQ(
      names({"ggx/smith_ggx.correlated/schlick", "ggx/smith_ggx.separable/schlick", "lambert"}),
      (Names{"GGX (Schlick; Smith for GGX, height-correlated)",
             "GGX (Schlick; Smith for GGX, separable)", "Lambert"}));
}

TEST(ModelNames, AreTheSpecsWhereNoTitleTellsThemApart) {
  const std::string a = "lambert.metallic+ggx/smith_ggx.correlated/schlick.metallic",
                    b = "lambert.metallic+ggx/smith_ggx.correlated/schlick.reflectance";
  const auto n = names({a, b, "lambert"});
  EXPECT_NE(n[0], n[1]);
  EXPECT_EQ(n[2], "Lambert");
}

TEST(ModelNames, CountNoLobesOfDifferentMasking) {
  EXPECT_EQ(names({"ggx/smith_ggx.correlated/schlick+ggx/smith_ggx.separable/schlick"})[0],
            "GGX (Schlick) + GGX (Schlick)");
}

TEST(ModelNames, OfPresetsAreTheirTitles) {
  const auto n = names({"gltf", "filament"});
  EXPECT_NE(n[0].find("glTF"), std::string::npos) << n[0];
  EXPECT_NE(n[1].find("Filament"), std::string::npos) << n[1];
}

TEST(ModelNames, OfTheUsualModelsAreEachOnceAndNoIds) {
  const auto n = names({usual_models().begin(), usual_models().end()});
  EXPECT_EQ(std::set(n.begin(), n.end()).size(), n.size());
  for (const auto& name : n) EXPECT_EQ(name.find_first_of("/_."), std::string::npos) << name;
}

}  // namespace
}  // namespace gonio
