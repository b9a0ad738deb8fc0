#include "brdf/model/reflectances.h"

#include <string>
#include <vector>

#include "brdf/model/evaluate.h"
#include "brdf/model/presets.h"
#include "geometry/half_difference.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

const std::vector<FrameAngles<double>> at{frame_angles({{0.8, 0, 0.6}, {-0.6, 0, 0.8}}),
                                          frame_angles({{0, 0.6, 0.8}, {0.96, 0, 0.28}})};

BoundModel bound_by_words(const std::string& model, const std::vector<std::string>& settings) {
  return bind_model(model, parse_settings(settings), 3);
}
std::vector<std::string> joined(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

TEST(Reflectances, OfAPresetsOwnTermsAreThoseThatThePresetResolvesTo) {
  const std::vector<std::string> workflow{"base_color=0.7,0.4,0.1", "metallic=0.3"};
  for (const auto& p : presets()) {
    if (p.own_spec.empty()) continue;
    const bool reflects = p.about.id == "model.filament";
    const auto own = reflects ? joined(workflow, {"reflectance=0.6"}) : workflow;
    const auto a = bound_by_words(std::string(p.about.id), joined(own, {"roughness=0.5"}));
    const auto b = bound_by_words(std::string(p.own_spec), joined(own, {"alpha=0.25"}));
    const auto c = in_reflectances(b);
    if (!reflects) {
      EXPECT_EQ(to_text(c.model.spec), p.spec);
    }
    EXPECT_TRUE(c.model.find("f0") && c.model.find("kd"));
    const auto fa = evaluate(a, at), fb = evaluate(b, at), fc = evaluate(c, at);
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t i = 0; i < at.size(); ++i) {
        EXPECT_NEAR(fb[k][i], fa[k][i], 1e-13 * fa[k][i]) << p.about.id;
        EXPECT_NEAR(fc[k][i], fa[k][i], 1e-13 * fa[k][i]) << p.about.id;
      }
  }
}

TEST(Reflectances, OfALaterLobeAreItsOwn) {
  const auto b = bound_by_words(
      "lambert.metallic+ggx/smith_ggx.correlated/schlick.metallic+ggx/smith_ggx.correlated/"
      "schlick.reflectance",
      {"base_color=0.7,0.4,0.1", "metallic=0.3", "alpha=0.2", "alpha_2=0.5", "base_color_2=0.5",
       "metallic_2=0", "reflectance_2=0.75"});
  const auto c = in_reflectances(b);
  EXPECT_EQ(to_text(c.model.spec),
            "lambert+ggx/smith_ggx.correlated/schlick+ggx/smith_ggx.correlated/schlick");
  EXPECT_NEAR(c.values[c.model.find("f0_2")->first], 0.09, 1e-15);
  EXPECT_NEAR(c.values[c.model.find("f0")->slot(2)], 0.04 * 0.7 + 0.1 * 0.3, 1e-15);
  EXPECT_NEAR(c.values[c.model.find("kd")->slot(1)], 0.4 * 0.7, 1e-15);
  EXPECT_EQ(c.values[c.model.find("alpha_2")->first], 0.5);
}

TEST(Reflectances, OfAModelThatHasThemAreItself) {
  const auto b =
      bound_by_words("lambert+ggx/smith_ggx.correlated/schlick.f90", {"alpha=0.2", "f90=0.5"});
  const auto c = in_reflectances(b);
  EXPECT_EQ(to_text(c.model.spec), to_text(b.model.spec));
  EXPECT_EQ(c.values, b.values);
}

}  // namespace
}  // namespace gonio
