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

TEST(Stands, AFresnelTermByVectorsIsOneOfVoh) {
  SKIP_WITHOUT_SHADERS;
  const auto of = [](const std::string& name, const std::string& arguments,
                     const std::string& half = "") {
    return Written("vec3 " + name + "(" + arguments + ", vec3 F0) { " + half +
                   " return F0 + (1.0 - F0) * pow(1.0 - max(dot(H, V), 0.0), 5.0); }\n")
        .function();
  };
  const auto schlick = of("F_Schlick", "vec3 H, vec3 V");
  EXPECT_EQ(schlick.stands, Stands::fresnel);
  EXPECT_TRUE(reads_angle(schlick, "voh"));
  EXPECT_FALSE(reads_angle(schlick, "noh"));
  EXPECT_EQ(of("edge", "vec3 V, vec3 H").stands, Stands::fresnel) << "by its values";
  EXPECT_EQ(of("fresnel", "vec3 L, vec3 V", "vec3 H = normalize(L + V);").stands, Stands::fresnel);
  EXPECT_EQ(Written("float phase(vec3 V, vec3 H) { return 0.5 * dot(V, H); }\n").function().stands,
            Stands::lobe);
  EXPECT_EQ(Written("float F_local(vec3 V, vec3 H) { return V.z * H.z; }\n").function().stands,
            Stands::lobe);
}

TEST(Stands, GByVectorsIsMaskingWhereItsNameAndItsValuesSaySo) {
  SKIP_WITHOUT_SHADERS;
  const auto of = [](const std::string& name, const std::string& value,
                     const std::string& reading = "") {
    return Written("float " + name +
                   "(vec3 L, vec3 V, vec3 N) { vec3 H = normalize(L + V); float x = 2.0 * dot(N, "
                   "H) / dot(V, H); return " +
                   value + "; }\n")
        .function(reading);
  };
  const std::string groove = "min(1.0, min(x * dot(N, V), x * dot(N, L)))";
  const auto g = of("cookTorranceG", groove);
  EXPECT_EQ(g.stands, Stands::masking);
  EXPECT_TRUE(g.is_g);
  EXPECT_EQ(of("light", groove).stands, Stands::lobe);
  EXPECT_EQ(of("light", groove, ":light{includes=g}").stands, Stands::masking);
  EXPECT_EQ(of("GlossG", "0.7 * x * dot(N, V) * dot(N, L)").stands, Stands::lobe);
}

TEST(Stands, AFunctionCalledGThatFallsTowardsTheHorizonIsG) {
  SKIP_WITHOUT_SHADERS;
  const auto f = Written(
                     "// alpha 0.1 1 0.5\nfloat g1(float c, float a) { return c / (c + sqrt(a * a "
                     "+ (1.0 - a * a) * c * c)); }\nfloat G_Smith(float NoL, float NoV, float "
                     "alpha) { return g1(NoL, alpha) * g1(NoV, alpha); }\n")
                     .function(":G_Smith");
  EXPECT_TRUE(f.is_g) << "a quarter along the normal, as V has";
}

}  // namespace
}  // namespace gonio::foreign
