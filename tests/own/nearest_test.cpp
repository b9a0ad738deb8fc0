// Right functions of our own are known for the form that they are, and none is accused.
#include "reports/own/nearest.h"

#include "own/own_shaders.h"
#include "refusal.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

/// The form that a function is, or what it has instead.
std::string form_of(const std::string& text) {
  const auto& a = audited(text);
  return nearest(a) + (a.slips.empty() ? "" : ": " + slips(a));
}
std::string of_diffuse(const std::string& value) {
  return "// albedo 0 1 0.8\n// sigma 0 1 0.3\n// roughness 0.1 1 0.5\n"
         "vec3 diffuse(vec3 l, vec3 v, vec3 n, float WIDTH, vec3 albedo) {\n"
         "  float NoL = dot(n, l), NoV = dot(n, v), s = dot(l, v) - NoL * NoV;\n"
         "  float LoH = length(l + v) / 2.0, NoH = dot(n, normalize(l + v));\n  return albedo * (" +
         value + ") / 3.14159265358979;\n}\n";
}

TEST(NearestForm, ADiffuseFunctionOfDirectionsIsTheFormWhoseValuesItHas) {
  SKIP_WITHOUT_SHADERS;
  const auto of = [](const char* width, const std::string& value) {
    return form_of(replaced(of_diffuse(value), "WIDTH", width));
  };
  EXPECT_EQ(of("sigma",
               "1.0 - 0.5 * sigma * sigma / (sigma * sigma + 0.33) + 0.45 * sigma * sigma / (sigma "
               "* sigma + 0.09) * (s > 0.0 ? s / max(NoL, NoV) : 0.0)"),
            "diffuse.oren_nayar");
  EXPECT_EQ(of("sigma",
               "(1.0 + sigma * (s > 0.0 ? s / max(NoL, NoV) : s)) / (1.0 + (0.5 - 2.0 / (3.0 * "
               "3.14159265358979)) * sigma)"),
            "diffuse.oren_nayar.fujii");
  EXPECT_EQ(of("roughness",
               "(1.0 + (2.0 * roughness * LoH * LoH - 0.5) * pow(1.0 - NoL, 5.0)) * (1.0 + (2.0 * "
               "roughness * LoH * LoH - 0.5) * pow(1.0 - NoV, 5.0))"),
            "diffuse.disney");
}

TEST(NearestForm, MaskingByOneDirectionIsComparedWithOurs) {
  SKIP_WITHOUT_SHADERS;
  const auto of = [](const std::string& arguments, const std::string& value) {
    return form_of("// roughness 0.1 1 0.4\nfloat G1(" + arguments + ", float roughness) { " +
                   value + "; }\n");
  };
  const std::string k = "float k = (roughness + 1.0) * (roughness + 1.0) / 8.0; return ";
  EXPECT_EQ(of("float NdotV", k + "NdotV / (NdotV * (1.0 - k) + k)"), "masking.schlick_ggx.direct");
  EXPECT_EQ(of("float NdotL", k + "NdotL / (NdotL * (1.0 - k) + k)"), "masking.schlick_ggx.direct");
  EXPECT_EQ(of("vec3 n, vec3 v",
               "float k = roughness * roughness / 2.0, c = max(dot(n, v), 0.0); return c / (c * "
               "(1.0 - k) + k)"),
            "masking.schlick_ggx.half_alpha");
  const std::string a2 = "float a2 = pow(roughness, 4.0); return ";
  EXPECT_EQ(of("float NoV", a2 + "1.0 / (NoV + sqrt(a2 + NoV * NoV - a2 * NoV * NoV))"),
            "masking.smith_ggx.separable");
  EXPECT_EQ(of("float NoV", a2 + "sqrt((-NoV * a2 + NoV) * NoV + a2)"), "none") << "a part of one";
}

TEST(NearestForm, AFresnelFunctionIsKnownWhateverItsParametersAreCalled) {
  SKIP_WITHOUT_SHADERS;
  const std::string exact =
      "float g = sqrt(N * N + c * c - 1.0), a = (g - c) / (g + c), b = ((g + c) * c - 1.0) / ((g - "
      "c) * c + 1.0); return 0.5 * a * a * (1.0 + b * b);";
  const auto named = [&](std::string cosine, std::string index) {
    auto text = "float fresnelDielectric(float " + cosine + ", float " + index +
                ") { float c = " + cosine + ", N = " + index + "; " + exact + " }\n";
    return form_of(text);
  };
  EXPECT_EQ(named("VoH", "ior"), "fresnel.dielectric");
  EXPECT_EQ(named("cosThetaI", "eta"), "fresnel.dielectric") << "without bounds, too";
  const auto schlick = [](const std::string& arguments, const std::string& f0) {
    return form_of("vec3 F(" + arguments + ", float VoH) { vec3 f0 = vec3(" + f0 +
                   "); float p = pow(1.0 - VoH, 5.0); return f0 + (1.0 - f0) * p; }\n");
  };
  EXPECT_EQ(schlick("vec3 SpecularColor", "SpecularColor"), "fresnel.schlick");
  EXPECT_EQ(schlick("float ior", "(ior - 1.0) * (ior - 1.0) / ((ior + 1.0) * (ior + 1.0))"),
            "fresnel.schlick");
  EXPECT_EQ(form_of("vec3 F_Schlick(vec3 SpecularColor, float VoH) { "
                    "float p = pow(1.0 - VoH, "
                    "5.0); return clamp(50.0 * SpecularColor.g, 0.0, 1.0) * p + (1.0 - p) * "
                    "SpecularColor; }\n"),
            "fresnel.schlick.ue");
}

TEST(NearestForm, MaskingWithoutAWidthIsKnownForMasking) {
  SKIP_WITHOUT_SHADERS;
  EXPECT_EQ(form_of("float V_Kelemen(float LoH) { return 0.25 / (LoH * LoH); }\n"),
            "masking.kelemen");
  EXPECT_EQ(form_of("float V_Implicit(float NoL, float NoV) { return 0.25; }\n"),
            "masking.implicit");
}

TEST(NearestForm, ASheensVHeldBelowOneIsAsked) {
  SKIP_WITHOUT_SHADERS;
  const auto a = audited(
      "// alpha 0.1 1 0.5\n"
      "float l(float x, float a) { float t = (1.0 - a) * (1.0 - a); return mix(21.5473, 25.3245, "
      "t) / (1.0 + mix(3.82987, 3.32435, t) * pow(x, mix(0.19823, 0.16801, t))) + mix(-1.97760, "
      "-1.27393, t) * x + mix(-4.32054, -4.85967, t); }\n"
      "float lambda(float c, float a) { return c < 0.5 ? exp(l(c, a)) : exp(2.0 * l(0.5, a) - "
      "l(1.0 - c, a)); }\n"
      "float V_Sheen(float NoL, float NoV, float alpha) { return clamp(1.0 / ((1.0 + lambda(NoV, "
      "alpha) + lambda(NoL, alpha)) * 4.0 * NoV * NoL), 0.0, 1.0); }\n",
      2);
  EXPECT_EQ(nearest(a), "masking.smith_charlie.correlated");
  EXPECT_EQ(slips(a), "");
  EXPECT_HAS(text_of(a), "check           V is held below 1");
  EXPECT_HAS(text_of(a), "Khronos's sheen does so");
}

TEST(NearestForm, ADistributionWithoutPiIsAskedWhereItsCallerMayDivide) {
  SKIP_WITHOUT_SHADERS;
  const auto with = [](const std::string& name, const std::string& caller) {
    return audited("// alpha 0.1 1 0.5\nfloat " + name +
                   "(float NoH, float alpha) { float d = NoH * NoH * (alpha * alpha - 1.0) + 1.0; "
                   "return alpha * alpha / (d * d); }\n" +
                   caller);
  };
  const auto lobe = [](const std::string& value) {
    return "vec3 lobe(vec3 N, vec3 L, vec3 V, vec3 F0, vec3 kd, float alpha) { vec3 H = "
           "normalize(L + V); "
           "float NoL = dot(N, L), NoV = dot(N, V), a2 = alpha * alpha; return (F0 + (1.0 - F0) * "
           "pow(1.0 - dot(V, H), 5.0)) * D_GGX(dot(N, H), alpha) * 0.5 / (NoV * sqrt(NoL * NoL * "
           "(1.0 - a2) + a2) + NoL * sqrt(NoV * NoV * (1.0 - a2) + a2))" +
           value + "; }\n";
  };
  const std::string asked = "right where its caller divides by π";
  const auto divided = with("D_GGX", lobe(" / 3.14159265358979"));
  EXPECT_EQ(slips(divided), "");
  EXPECT_HAS(text_of(divided), asked + ", as lobe may");
  EXPECT_HAS(slips(with("D_GGX", lobe(""))), "1/π is missing");
  EXPECT_HAS(slips(with("D_GGX", lobe(" + kd / 3.14159265358979"))), "1/π is missing")
      << "the caller lacks it, too";
  const auto named = with("D_GGXNoPI", "");
  EXPECT_EQ(slips(named), "");
  EXPECT_HAS(text_of(named), asked);
}

TEST(NearestForm, NamesThatSaySquareAreAccusedOfNoMissingOne) {
  SKIP_WITHOUT_SHADERS;
  const std::string vis =
      "(float NoV, float NoL, float W) { float k = sqrt(W) * 0.5; return 0.25 / ((NoV * (1.0 - k) "
      "+ k) * (NoL * (1.0 - k) + k)); }\n";
  for (const std::string w : {"a2", "m2", "alphaSq", "roughness4"}) {
    auto text = "// " + w + " 0.01 1 0.5\nfloat Vis_Schlick" + vis;
    for (auto at = text.find('W'); at != text.npos; at = text.find('W')) text.replace(at, 1, w);
    EXPECT_EQ(form_of(text), "masking.schlick_ggx.half_alpha") << w;
  }
  for (const std::string w : {"alphaSquared", "alpha_sq", "roughness2", "mSq"})
    EXPECT_EQ(form_of(ggx("float a2 = " + w + ";", whole, w)), "ndf.ggx") << w;
  EXPECT_EQ(form_of(ggx("float a2 = Roughness2 * Roughness2;", whole, "Roughness2")), "ndf.ggx");
}

TEST(NearestForm, AFormAsItIsShippedIsNoSlipOfAnother) {
  SKIP_WITHOUT_SHADERS;
  const auto a = audited(
      "// Roughness 0.05 1 0.5\nfloat GGX_Mobile(float Roughness, float NoH) { float a = Roughness "
      "* Roughness, n = NoH * a, p = a / (1.0 - NoH * NoH + n * n); return min(p * p, 2048.0); "
      "}\n");
  EXPECT_EQ(nearest(a), "ndf.ggx.mobile");
  EXPECT_EQ(slips(a), "");
  EXPECT_HAS(text_of(a), "1/π is missing; ndf.ggx.mobile ships so");
}

TEST(NearestForm, AScaledDiffuseFormIsAskedAbout) {
  SKIP_WITHOUT_SHADERS;
  const auto scaled = [](const std::string& by) {
    return text_of(
        audited("// roughness 0.05 1 0.5\n" + std::string(terms) +
                    "float Fd(float NoV, float NoL, float LoH, float roughness) { return " + by +
                    " * burley(NoL, NoV, LoH, roughness) / PI; }\n",
                4));
  };
  EXPECT_HAS(scaled("0.8"), "its value is 0.8 times that form's");
  EXPECT_HAS(scaled("0.9"), "its value is 0.9 times that form's");
  EXPECT_EQ(scaled("1.0").find("times that form's"), std::string::npos);
}

TEST(NearestForm, WidthsThatAreSwappedAreNamed) {
  SKIP_WITHOUT_SHADERS;
  const auto of = [](const std::string& x, const std::string& y) {
    return slips(
        audited("// ax 0.05 1 0.3\n// ay 0.05 1 0.3\nfloat D(float NoH, float XoH, float "
                "YoH, float ax, float ay) { float d = XoH * XoH / (" +
                x + " * " + x + ") + YoH * YoH / (" + y + " * " + y +
                ") + NoH * NoH; return 1.0 / (3.14159265358979 * ax * ay * d * d); }\n"));
  };
  EXPECT_EQ(of("ax", "ay"), "");
  EXPECT_EQ(of("ay", "ax"), "ax and ay are swapped: ax belongs to the tangent X\n");
}

TEST(NearestForm, AnotherNormIsPrintedOverTheWholeRange) {
  SKIP_WITHOUT_SHADERS;
  const auto a = audited(
      "// ax 0.1 1 0.3\n// ay 0.1 1 0.3\nfloat D(float NoH, float XoH, float YoH, float ax, float "
      "ay) { float d = XoH * XoH / (ax * ax) + YoH * YoH / (ay * ay) + NoH * NoH; return 1.0 / "
      "(3.14159265358979 * ax * ax * ay * ay * d * d); }\n");
  EXPECT_HAS(slips(a), "∫ D cos θ is 1 to 100, expected 1");
}

TEST(NearestForm, TheFactorOfADistributionIsNotThatOfV) {
  SKIP_WITHOUT_SHADERS;
  const auto a =
      audited(ggx("float a2 = alpha * alpha;", "2.0 * a2 / (3.14159265358979 * d * d)", "alpha"));
  EXPECT_EQ(slips(a), "twice too large: a factor ½ is missing\n");
  const auto g = audited(
      "// alpha 0.1 1 0.5\nfloat g1(float c, float a) { return c / (c + sqrt(a * a + (1.0 - a * a) "
      "* c * c)); }\nfloat G_Smith(float NoL, float NoV, float alpha) { return g1(NoL, alpha) * "
      "g1(NoV, alpha); }\n",
      1);
  EXPECT_EQ(slips(g), "4 times too small: the 2 of each G1 = 2 c/(c + …) is missing\n");
}

}  // namespace
}  // namespace gonio
