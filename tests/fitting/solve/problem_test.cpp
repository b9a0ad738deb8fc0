// The problem that options and a table pose, or why they pose none.
#include "fitting/solve/problem.h"

#include "base/error.h"
#include "fitting/fit.h"
#include "fitting/support.h"
#include "foreign/compile.h"
#include "refusal.h"
#include "support.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

constexpr const char* paint = "lambert+ggx/smith_ggx.correlated/schlick";

std::vector<Setting> settings(const std::string& text) {
  return parse_settings(std::vector<std::string>{text});
}

TEST(Problem, HoldsWhatIsFixedAndFreesTheRestInOrder) {
  const Table t = synthesize(test::bind(paint, "kd=0.2", 3), {.layout = Layout::random});
  FitOptions o;
  o.fixed = settings("roughness=0.5");
  const Problem p = pose(t, o);
  const auto* alpha = p.start.model.find("alpha");
  EXPECT_EQ(p.start.values[alpha->first], 0.25);
  EXPECT_FALSE(p.free.mask()[alpha->first]);
  EXPECT_EQ(p.free.size(), 6U);  // f0 and kd of three channels
  auto values = p.start.values;
  p.free.put(std::vector<double>{1, 2, 3, 4, 5, 6}, values);
  EXPECT_EQ(p.free.of(values), (std::vector<double>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(values[alpha->first], 0.25);
}

TEST(Problem, TakesBoundsOfRoughnessAsThoseOfAlpha) {
  const Table t = synthesize(test::bind(paint, "kd=0.2", 3), {.layout = Layout::random});
  FitOptions o;
  o.bounds = {{"roughness", {0.3, 0.5}}};
  const Problem p = pose(t, o);
  const std::size_t i = p.free.index(p.start.model.find("alpha")->first);
  EXPECT_NEAR(p.bounds.low[i], 0.09, 1e-15);
  EXPECT_NEAR(p.bounds.high[i], 0.25, 1e-15);
  EXPECT_TRUE(p.narrowed[i]);
  EXPECT_FALSE(p.narrowed[p.free.index(p.start.model.find("kd")->first)]);
}

TEST(Problem, TakesBoundsOfAColourThatAShaderMixesForItsThreeChannels) {
  if (!foreign::can_compile()) GTEST_SKIP() << "this build reads no shaders";
  const test::Folder folder;
  folder.write("mixed.glsl",
               "// f0 0 1 0.5\nvec3 brdf(vec3 N, vec3 L, vec3 V, vec3 f0) { return f0 + f0.yzx * "
               "dot(N, L) * dot(N, V); }\n");
  FitOptions o;
  o.model = folder / "mixed.glsl";
  o.bounds = {{"f0", {0.1, 0.6}}};
  const Problem p = pose(synthesize(test::bind(paint, "kd=0.2", 3), {.layout = Layout::random}), o);
  for (const char* name : {"f0_r", "f0_g", "f0_b"})
    EXPECT_EQ(p.bounds.high[p.free.index(p.start.model.find(name)->first)], 0.6);
}

TEST(Problem, RefusesBoundsThatSayNothingOrTooMuch) {
  const auto refused = [](std::vector<Setting> bounds, std::vector<Setting> fixed = {}) {
    FitOptions o;
    o.bounds = std::move(bounds);
    o.fixed = std::move(fixed);
    try {
      check(o);
    } catch (const Error&) {
      return true;
    }
    return false;
  };
  EXPECT_FALSE(refused({{"alpha", {0.1, 0.5}}}));
  EXPECT_TRUE(refused({{"alpha", {0.5, 0.1}}}));
  EXPECT_TRUE(refused({{"alpha", {0.1}}}));
  EXPECT_TRUE(refused({{"gamma", {1, 2}}}));
  EXPECT_TRUE(refused({{"kd", {-1, 2}}}));
  EXPECT_TRUE(refused({{"alpha", {0.1, 0.5}}}, settings("alpha=0.2")));
}

TEST(Problem, RefusesTiesThatContradictOrAreHalfTold) {
  const auto refusal = [](const char* model, std::vector<std::string> fixed,
                          std::vector<std::string> bounds) {
    FitOptions o;
    o.model = model;
    o.fixed = parse_settings(fixed);
    o.bounds = parse_settings(bounds);
    return test::refusal([&] { check(o); }, Exit::usage);
  };
  constexpr const char* coupled = "lambert.coupled+ggx/smith_ggx.correlated/schlick";
  EXPECT_EQ(refusal(coupled, {"base_color=0.5", "metallic=0"}, {}), "");
  EXPECT_EQ(refusal(coupled, {"base_color=0.5"}, {}),
            "base_color is held at a value and metallic is not: fix metallic=0 (or 1) too, or kd "
            "and f0");
  EXPECT_EQ(refusal("gltf", {"base_color=0.5"}, {}), "");
  EXPECT_EQ(refusal("gltf", {"metallic=0.5"}, {"base_color=0.2,0.9"}), "");
  EXPECT_NE(refusal("gltf", {"f0=0.5"}, {}), "");
  EXPECT_EQ(refusal(coupled, {"metallic=0.5"}, {}), "metallic needs base_color");
  EXPECT_NE(refusal(coupled, {"base_color=0.5", "metallic=0", "kd=0.2"}, {}), "");
  EXPECT_NE(refusal(paint, {"alpha=0.2", "roughness=0.9"}, {}), "");
  EXPECT_EQ(refusal(paint, {}, {"alpha=0.5,0.6", "roughness=0.1,0.2"}),
            "bounds: alpha and roughness are the same parameter");
  EXPECT_EQ(refusal(paint, {"alpha=2"}, {}), "alpha = 2 is outside [0.0001, 1]");
  EXPECT_EQ(refusal(paint, {"roughness=1.5"}, {}), "alpha = 2.25 is outside [0.0001, 1]");
  EXPECT_NE(refusal("ggx/smith_ggx.correlated/dielectric", {"f0=1"}, {}), "");
  EXPECT_NE(refusal("ggx/smith_ggx.correlated/conductor", {"metal=Au", "k=3"}, {}), "");
}

TEST(Problem, OfAPresetIsInItsOwnParametersOrHoldsWhatThePresetDoes) {
  FitOptions o;
  o.model = "gltf";
  EXPECT_EQ(expanded(o).model, "lambert.metallic.coupled+ggx/smith_ggx.separable/schlick.metallic");
  EXPECT_TRUE(expanded(o).fixed.empty());
  o.model = "ue_mobile";
  EXPECT_EQ(expanded(o).model, "ggx.ue_mobile/ue_joint.clamped/schlick.ue");
  EXPECT_EQ(expanded(o).fixed.size(), 1U);
  o.model = paint;
  EXPECT_EQ(expanded(o).model, paint);
}

TEST(Problem, KnowsModelsThatStayTheSameWithLightAndViewerExchanged) {
  EXPECT_TRUE(is_reciprocal(test::bind(paint, "alpha=0.2", 3)));
  EXPECT_TRUE(is_reciprocal(
      test::bind("lambert.coupled+gtr/smith_ggx.separable/dielectric", "alpha=0.5", 1)));
}

}  // namespace
}  // namespace gonio
