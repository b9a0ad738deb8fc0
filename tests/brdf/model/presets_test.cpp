// Every whole model against numbers worked out by hand: l and v at cosine 0.6 on either side of the
// normal, so that h = n, NoH = 1 and VoH = 0.6; r = 0.5, so that alpha = 1/4 and GGX's D = 16/π.
#include "brdf/model/presets.h"

#include <algorithm>
#include <cmath>

#include "brdf/model/evaluate.h"
#include "brdf/model/model.h"
#include "constants.h"
#include "geometry/half_difference.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

using test::pi;
constexpr double m5 = 0.4 * 0.4 * 0.4 * 0.4 * 0.4;      // (1 − VoH)⁵
constexpr double schlick = 0.04 + 0.96 * m5;            // F at f0 = 0.04
constexpr double d = 16 / pi;                           // GGX at its peak
const double root = std::sqrt(0.0625 + 0.9375 * 0.36);  // √(α² + (1 − α²) c²) = √0.4
const double separable = 1 / ((0.6 + root) * (0.6 + root));
const double correlated = 1 / (2 * (0.6 * root + 0.6 * root));

double preset_value(const std::string& model, const std::vector<std::string>& settings) {
  const std::vector<FrameAngles<double>> at{frame_angles({{0.8, 0, 0.6}, {-0.8, 0, 0.6}})};
  return evaluate(bind_model(model, parse_settings(settings), 1), at)[0][0];
}

TEST(Preset, GltfIsTheSpecificationsAppendixB) {
  EXPECT_NEAR(preset_value("gltf", {"base_color=0.5", "roughness=0.5"}),
              (1 - schlick) * 0.5 / pi + d * separable * schlick, 1e-12);
  // A metal has the colour as its F0 and no diffuse.
  EXPECT_NEAR(preset_value("gltf", {"base_color=0.5", "metallic=1", "roughness=0.5"}),
              d * separable * (0.5 + 0.5 * m5), 1e-12);
}

TEST(Preset, CookTorranceHasTheCorrelatedMasking) {
  EXPECT_NEAR(preset_value("model.cook_torrance", {"base_color=0.5", "roughness=0.5"}),
              (1 - schlick) * 0.5 / pi + d * correlated * schlick, 1e-12);
}

TEST(Preset, FilamentsF90FallsForWhatNoDielectricReflects) {
  EXPECT_NEAR(preset_value("filament", {"base_color=0.5", "roughness=0.5"}),
              0.5 / pi + d * correlated * schlick, 1e-12);
  // reflectance 0.1: f0 = 0.0016 and f90 = 50 · 0.33 · 3 · 0.0016
  const double f0 = 0.0016, f90 = 16.5 * 3 * f0;
  EXPECT_NEAR(preset_value("filament", {"base_color=0.5", "roughness=0.5", "reflectance=0.1"}),
              0.5 / pi + d * correlated * (f0 + (f90 - f0) * m5), 1e-12);
}

TEST(Preset, DisneyIsABaseACoatAndItsDiffuse) {
  // alpha_g = (0.5 + r/2)² = 0.5625, whose root at 0.6 is 0.75
  const double base = d / (1.35 * 1.35) * schlick;
  const double edge = 1 - 0.14 * m5;  // F_D90 = 0.5 + 2 · 0.5 · 0.36 = 0.86
  const double diffuse = 0.5 / pi * edge * edge;
  EXPECT_NEAR(preset_value("disney", {"base_color=0.5", "roughness=0.5"}), diffuse + base, 1e-12);
  // GTR1 at its peak, alpha = 0.001, with Smith's masking of alpha = 0.25
  const double a2 = 1e-6, gtr1 = (a2 - 1) / (pi * std::log(a2) * a2);
  const double coat = 0.25 * gtr1 * separable * schlick;
  EXPECT_NEAR(preset_value("disney", {"base_color=0.5", "roughness=0.5", "clearcoat=1"}),
              diffuse + base + coat, 1e-9 * coat);
}

TEST(Preset, DisneyOf2017IsMaskedByItsOwnWidths) {
  const double edge = 1 - 0.14 * m5, diffuse = 0.5 / pi * edge * edge;
  EXPECT_NEAR(preset_value("disney2017", {"base_color=0.5", "roughness=0.5"}),
              diffuse + d * separable * schlick, 1e-12);
  // aspect = √0.1: l and v lie over the tangent, where the width is α_x = 0.25/aspect
  const double root_x = std::sqrt(0.64 * 0.0625 / 0.1 + 0.36);
  EXPECT_NEAR(preset_value("disney2017", {"base_color=0.5", "roughness=0.5", "anisotropy=1"}),
              diffuse + d / ((0.6 + root_x) * (0.6 + root_x)) * schlick, 1e-12);
}

TEST(Preset, DisneyRemapsARoughnessOfNothingToAQuarter) {
  // alpha_g = (0.5 + 0/2)²; the widths of D end at 0.001
  const double root_g = std::sqrt(0.0625 + 0.9375 * 0.36),
               per = 1 / ((0.6 + root_g) * (0.6 + root_g));
  EXPECT_NEAR(preset_value("disney", {"base_color=0", "roughness=0"}) * pi * 1e-6 / schlick, per,
              1e-5 * per);
  const double root_r = std::sqrt(std::pow(0.5025, 4) * 0.64 + 0.36);
  const double at_5e_3 = 1 / ((0.6 + root_r) * (0.6 + root_r));
  EXPECT_NEAR(preset_value("disney", {"base_color=0", "roughness=0.005"}) * pi * 1e-6 / schlick,
              at_5e_3, 1e-12);
}

TEST(Preset, DisneysAnisotropyMovesTheWidthsApart) {
  // at the peak D = 1/(π alpha_x alpha_y), and the product of the widths stays
  EXPECT_NEAR(preset_value("disney", {"base_color=0", "roughness=0.5", "anisotropy=1"}),
              preset_value("disney", {"base_color=0", "roughness=0.5"}), 1e-12);
  EXPECT_GT(preset_value("disney", {"base_color=0", "roughness=1", "anisotropy=1"}), 0);
}

TEST(Preset, UnrealsMobileLacksItsPiAndRaisesNov) {
  const double nov = 0.60001;
  const double sum = 0.6 * (nov * 0.75 + 0.25) + nov * (0.6 * 0.75 + 0.25);
  EXPECT_NEAR(preset_value("ue_mobile", {"specular_color=0.04", "roughness=0.5"}),
              16 * 0.5 / sum * schlick, 1e-6);
  // Below 2 % the edge fades: saturate(50 · 0.01) = 0.5
  EXPECT_NEAR(preset_value("ue_mobile", {"specular_color=0.01", "roughness=0.5"}),
              16 * 0.5 / sum * (0.5 * m5 + (1 - m5) * 0.01), 1e-6);
  // 2048 is the most that D may be.
  const double smooth = 2048 * 0.5 / (0.6 * (nov * 0.9999 + 1e-4) + nov * (0.6 * 0.9999 + 1e-4));
  EXPECT_NEAR(preset_value("ue_mobile", {"specular_color=0.04", "roughness=0.01"}),
              smooth * schlick, 1e-4 * smooth * schlick);
}

TEST(Preset, UnrealsSimplestHasNoAnglesButNoH) {
  EXPECT_NEAR(preset_value("ue_mobile_simple", {"specular_color=0.04", "roughness=0.5"}),
              (0.25 * 0.5 + 0.25) * 16 * 0.04, 1e-6);
}

TEST(Preset, UnitysMobileDividesByLoHSquared) {
  EXPECT_NEAR(preset_value("unity_mobile", {"specular_color=0.04", "roughness=0.5"}),
              d / (0.36 * (0.5 + 0.5)) / 4 * 0.04, 1e-12);
}

TEST(Preset, TakesItsOwnParametersOrThoseOfItsSpec) {
  const auto b = bind_model("gltf", parse_settings(std::vector<std::string>{"f0=0.1"}), 1);
  EXPECT_EQ(b.given, std::vector<std::string>{"f0"});
  EXPECT_EQ(b.values[b.model.find("f0")->first], 0.1);
  const auto bind = [](const std::vector<std::string>& words) {
    return bind_model("disney", parse_settings(words), 1);
  };
  EXPECT_ANY_THROW(bind({"base_color=0.5", "f0=0.1"}));
  EXPECT_ANY_THROW(bind({"base_color=2"}));
  EXPECT_ANY_THROW(bind({"sheen=1"}));
  // What a preset holds is given; what follows from defaults is free to a fit.
  const auto held = bind({}).given;
  EXPECT_NE(std::ranges::find(held, "f0_2"), held.end());
  EXPECT_EQ(std::ranges::find(held, "alpha"), held.end());
}

TEST(Preset, LeavesTheTermOfItsNameToTheWholeId) {
  EXPECT_EQ(bind_model("disney", {}, 1).model.lobes.size(), 2U);
  EXPECT_TRUE(bind_model("diffuse.disney", {}, 1).model.lobes.empty());
}

TEST(Preset, EachComposesAndNamesItsSource) {
  for (const auto& p : presets()) {
    EXPECT_TRUE(find_preset(p.about.id) == &p && !p.about.source.empty()) << p.about.id;
    EXPECT_NO_THROW(bind_model(p.about.id, {}, 3)) << p.about.id;
  }
}

}  // namespace
}  // namespace gonio
