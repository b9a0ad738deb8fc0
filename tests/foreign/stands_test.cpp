// What a function stands for.
#include "foreign/guesses.h"
#include "foreign/written.h"

namespace gonio::foreign {
namespace {

TEST(Stands, AVisibilityOfAnyNameIsMaskingAndADiffuseFormIsNot) {
  SKIP_WITHOUT_SHADERS;
  const auto stands = [](const std::string& value) {
    return Written("float cloth_term(float NoV, float NoL) { return " + value + "; }\n")
        .function()
        .stands;
  };
  EXPECT_EQ(stands("0.25 / (NoL + NoV - NoL * NoV)"), Stands::masking);
  EXPECT_EQ(stands("1.0 / (NoL + NoV - NoL * NoV)"), Stands::masking) << "its 4 stands elsewhere";
  EXPECT_EQ(stands("0.25 * (2.0 - pow(1.0 - NoL, 5.0)) * (1.0 - pow(1.0 - NoV, 5.0))"),
            Stands::lobe);
}

TEST(Stands, AHelperTakesNoDirectionAndAnAlbedoNoLight) {
  SKIP_WITHOUT_SHADERS;
  const auto helper = Written("float sqr(float x) { return x * x; }\n").function();
  EXPECT_FALSE(takes_direction(helper));
  EXPECT_EQ(helper.includes, "nothing");
  const auto tangent = Written("vec3 to_linear(vec3 x) { return x * x; }\n").function();
  EXPECT_FALSE(takes_direction(tangent));
  const auto albedo = Written(
                          "// f0 0 1 0.04\nvec3 env(vec3 f0, float NoV) { return f0 + (1.0 - f0) * "
                          "exp(-9.0 * NoV); }\n")
                          .function();
  EXPECT_TRUE(takes_direction(albedo));
  EXPECT_FALSE(takes_light(albedo));
}

TEST(Stands, MaskingOfTwoWidthsIsMasking) {
  SKIP_WITHOUT_SHADERS;
  const auto f =
      Written(
          "// at 0.05 1 0.2\n// ab 0.05 1 0.5\nfloat V_Smith(float at, float ab, float "
          "ToV, float BoV, float ToL, float BoL, float NoV, float NoL) {\n  return 0.5 / "
          "(NoL * length(vec3(at * ToV, ab * BoV, NoV)) + NoV * length(vec3(at * ToL, ab "
          "* BoL, NoL)));\n}\n")
          .function();
  EXPECT_EQ(f.stands, Stands::masking);
  EXPECT_FALSE(f.is_g);
  EXPECT_TRUE(f.anisotropic);
}

}  // namespace
}  // namespace gonio::foreign
