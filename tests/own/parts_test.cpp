// Slips that one part of a model shows beside another.
#include "reports/own/parts.h"

#include "own/own_shaders.h"
#include "refusal.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

constexpr const char* highlight =
    "D_GGX(NoH, roughness * roughness) * V_Smith(NoL, NoV, roughness * roughness)";
const std::string of_f0 = std::string(highlight) + " * (f0 + (1.0 - f0) * p)";

TEST(OwnParts, ACoatThatTakesNothingFromTheBaseIsNamed) {
  SKIP_WITHOUT_SHADERS;
  const auto coated = [](const std::string& base_times, const std::string& coat_times) {
    return OwnSlips(model_of(
        "float roughness 0.2 1 0.5, float coat 0 1 0, float coatRough 0.1 0.6 0.2, vec3 f0 0 1 0.5",
        "(" + of_f0 + ") * " + base_times +
            " + vec3(coat * (0.04 + 0.96 * p) * D_GGX(NoH, coatRough * coatRough) * V_Smith(NoL, "
            "NoV, coatRough * coatRough) * " +
            coat_times + ")"));
  };
  EXPECT_HAS(coated("1.0", "1.0").slips, "its coat is added and takes nothing");
  EXPECT_EQ(coated("(1.0 - coat * (0.04 + 0.96 * p))", "1.0").slips, "");
  const auto weak = coated("1.0", "0.25");
  EXPECT_EQ(weak.slips, "") << "as Disney's";
  EXPECT_HAS(weak.to_check, "its coat takes nothing from what lies below");
}

TEST(OwnParts, ACosineInOnePartIsNamed) {
  SKIP_WITHOUT_SHADERS;
  const auto of = [](const std::string& diffuse, const std::string& highlight_times) {
    return OwnSlips(model_of("float roughness 0.1 1 0.5, vec3 f0 0 1 0.04, vec3 color 0 1 0.5",
                             "color / PI * (1.0 - f0) * burley(NoL, NoV, VoH, roughness)" +
                                 diffuse + " + " + of_f0 + highlight_times))
        .slips;
  };
  EXPECT_HAS(of(" * NoL", ""), "its diffuse part has the cosine NoL in it");
  EXPECT_HAS(of("", " * NoL"), "its highlight has the cosine NoL in it");
  EXPECT_EQ(of("", ""), "");
  EXPECT_EQ(of(" * NoL", " * NoL"), "");
}

TEST(OwnParts, AMissingPiOfADiffusePartIsNamedWhateverItsForm) {
  SKIP_WITHOUT_SHADERS;
  const auto of = [](const std::string& diffuse) {
    return OwnSlips(
               model_of("float roughness 0.1 1 0.5, float metallic 0 1 0, vec3 baseColor 0 1 0.5",
                        "baseColor * (1.0 - metallic) * " + diffuse + " + " + highlight +
                            " * mix(mix(vec3(0.04), baseColor, metallic), vec3(1.0), p)"))
        .slips;
  };
  EXPECT_HAS(of("burley(NoL, NoV, VoH, roughness)"),
             "its diffuse part is π times too large: 1/π is missing");
  EXPECT_EQ(of("burley(NoL, NoV, VoH, roughness) / PI"), "");
  EXPECT_EQ(of("(1.0 - p) / PI"), "");
}

/// A dielectric's highlight by its eta, times something, above a diffuse part.
std::string plastic(const std::string& diffuse, const std::string& times) {
  return "float fresnel(float c, float eta) { float g = sqrt(eta * eta - 1.0 + c * c), a = (g - c) "
         "/ "
         "(g + c), b = (c * (g + c) - 1.0) / (c * (g - c) + 1.0); return 0.5 * a * a * (1.0 + b * "
         "b); }\n" +
         model_of("float roughness 0.1 1 0.5, float eta 1.1 2.5 1.5, vec3 kd 0 1 0.3",
                  diffuse + " + vec3(fresnel(VoH, eta) * " + highlight + times + ")");
}

TEST(OwnParts, SlipsOfADielectricThatIsGivenByEtaAreNamed) {
  SKIP_WITHOUT_SHADERS;
  const OwnSlips right(plastic("kd / PI", ""));
  EXPECT_EQ(right.slips, "");
  ASSERT_TRUE(right.model) << right.why;
  EXPECT_EQ(right.model->spec, "lambert+ggx/smith_ggx.correlated/dielectric");
  EXPECT_HAS(OwnSlips(plastic("kd / PI", " * 4.0")).slips, "a 4 is missing");
  EXPECT_HAS(OwnSlips(plastic("kd", "")).slips, "1/π is missing; or, if its value includes π");
}

TEST(OwnParts, ANormThatIsWrongWhereALobeIsStretchedIsNamed) {
  SKIP_WITHOUT_SHADERS;
  const auto of = [](const std::string& norm) {
    return OwnSlips(
               "float D(float ToH, float BoH, float NoH, float x, float y, float norm) { float s = "
               "ToH * "
               "ToH / (x * x) + BoH * BoH / (y * y) + NoH * NoH; return 1.0 / (3.14159265358979 * "
               "norm * s "
               "* s); }\n" +
               model_of("float roughness 0.2 1 0.4, float anisotropy -0.9 0.9 0, vec3 f0 0 1 0.9",
                        "D(dot(T, H), dot(B, H), NoH, roughness * roughness * (1.0 + anisotropy), "
                        "roughness * roughness * (1.0 - anisotropy), " +
                            norm +
                            ") * V_Smith(NoL, NoV, roughness * roughness) * (f0 + (1.0 - f0) * p)"))
        .slips;
  };
  EXPECT_HAS(of("pow(roughness, 4.0)"), "the norm of its D is wrong where anisotropy is -0.9");
  EXPECT_EQ(of("pow(roughness, 4.0) * (1.0 - anisotropy * anisotropy)"), "");
}

TEST(OwnParts, ASmoothnessUsedAsARoughnessIsNamed) {
  SKIP_WITHOUT_SHADERS;
  const auto of = [](const std::string& name, const std::string& alpha) {
    const std::string a = "max(" + alpha + ", 0.002)";
    return OwnSlips(model_of("float " + name + " 0.05 1 0.5, vec3 f0 0 1 0.04",
                             "D_GGX(NoH, " + a + ") * V_Smith(NoL, NoV, " + a +
                                 ") * (f0 + (1.0 - f0) * p)"))
        .slips;
  };
  EXPECT_HAS(of("smoothness", "smoothness * smoothness"), "smoothness is used as a roughness");
  EXPECT_HAS(of("roughness", "(1.0 - roughness) * (1.0 - roughness)"),
             "roughness is used as a smoothness");
  EXPECT_EQ(of("smoothness", "(1.0 - smoothness) * (1.0 - smoothness)"), "");
  EXPECT_EQ(of("roughness", "roughness * roughness"), "");
}

TEST(OwnParts, AMetalThatKeepsItsDiffusePartIsNamed) {
  SKIP_WITHOUT_SHADERS;
  const auto of = [](const std::string& kd) {
    return OwnSlips(
               model_of("float roughness 0.1 1 0.5, float metallic 0 1 0, vec3 baseColor 0 1 0.5",
                        kd + "baseColor / PI + " + highlight +
                            " * mix(mix(vec3(0.04), baseColor, metallic), vec3(1.0), p)"))
        .slips;
  };
  EXPECT_HAS(of(""), "its diffuse part is left where metallic is 1");
  EXPECT_EQ(of("(1.0 - metallic) * "), "");
}

}  // namespace
}  // namespace gonio
