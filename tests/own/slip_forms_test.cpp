// Slips that no factor and no map makes a form of ours: each is named, in a term and in a whole
// model.
#include "reports/own/slip_forms.h"

#include "own/own_shaders.h"
#include "refusal.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

std::string distribution_of(const std::string& name, const std::string& body) {
  return "// " + name + " 0.1 1 0.5\nfloat D_term(float NoH, float " + name + ") {\n  " + body +
         "\n}\n";
}
std::string masking_of(const std::string& body) {
  return "// alpha 0.1 1 0.5\nfloat lambda(float c, float alpha) { return 0.5 * (-1.0 + "
         "sqrt(1.0 + alpha * alpha * (1.0 / (c * c) - 1.0))); }\n"
         "float V_term(float NoL, float NoV, float alpha) {\n  float a2 = alpha * alpha;\n  " +
         body + "\n}\n";
}
/// The second function's audit, which takes the first as a help.
const FunctionAudit& masking(const std::string& body) {
  static std::map<std::string, FunctionAudit> known;
  const auto [at, fresh] = known.try_emplace(body);
  if (fresh) {
    const test::Folder folder;
    at->second = audit_file(folder.write("case.glsl", masking_of(body)) + ":V_term", {}, false)[0];
  }
  return at->second;
}

TEST(SlipForms, ACosineOfTheHalfVectorThatIsSquaredTwiceOrNotAtAllIsNamed) {
  SKIP_WITHOUT_SHADERS;
  const auto ggx_with = [](const std::string& square) {
    return slips(audited(distribution_of(
        "alpha", "float a2 = alpha * alpha, c = " + square +
                     ", d = c * (a2 - 1.0) + 1.0;\n  return a2 / (3.14159265358979 * d * d);")));
  };
  EXPECT_EQ(ggx_with("NoH * NoH"), "");
  EXPECT_EQ(ggx_with("pow(NoH, 2.0)"), "");
  EXPECT_HAS(ggx_with("pow(NoH * NoH, 2.0)"), "NoH is squared twice");
  EXPECT_HAS(ggx_with("NoH"), "NoH stands where NoH² belongs");
  const auto beckmann_with = [](const std::string& square, const std::string& fourth) {
    return slips(audited(distribution_of(
        "m", "float m2 = m * m, c = " + square +
                 ";\n  return exp((c - 1.0) / (m2 * c)) / (3.14159265358979 * m2 * " + fourth +
                 ");")));
  };
  EXPECT_EQ(beckmann_with("NoH * NoH", "c * c"), "");
  EXPECT_HAS(beckmann_with("NoH * NoH * NoH * NoH", "c * c"), "NoH is squared twice");
  EXPECT_HAS(beckmann_with("NoH * NoH", "1.0"), "the division by NoH⁴ is missing");
  EXPECT_HAS(beckmann_with("NoH * NoH", "c"), "NoH² stands below where NoH⁴ belongs");
  const auto whole = OwnSlips(model_of(
      "float roughness 0.1 1 0.5, vec3 f0 0 1 0.04",
      "(f0 + (1.0 - f0) * p) * D_GGX(NoH * NoH, roughness * roughness) * V_Smith(NoL, NoV, "
      "roughness * roughness)"));
  EXPECT_HAS(whole.slips, "NoH is squared twice");
}

TEST(SlipForms, ANormOverDirectionsIsNamed) {
  SKIP_WITHOUT_SHADERS;
  const auto phong = [](const std::string& norm) {
    return slips(audited("// n 1 200 20\nfloat D(float NoH, float n) { return " + norm +
                         " * pow(NoH, n); }\n"));
  };
  EXPECT_EQ(phong("(n + 2.0) / 6.28318530717959"), "");
  EXPECT_HAS(phong("(n + 1.0) / 6.28318530717959"), "normalised over the hemisphere, ∫ D dω = 1");
  EXPECT_HAS(phong("(n + 1.0) / 12.5663706143592"), "normalised over the whole sphere");
  EXPECT_HAS(slips(audited(distribution_of(
                 "alpha",
                 "float k = 2.0 / (alpha * alpha);\n  return k / (6.28318530717959 * (1.0 - "
                 "exp(-k))) * exp(k * (NoH - 1.0));"))),
             "normalised over the hemisphere");
}

/// The slips of a whole model with a highlight of such D and V, and F0.
std::string whole_of(const std::string& d, const std::string& v, const std::string& half = "") {
  auto text = model_of("float roughness 0.1 1 0.5, vec3 f0 0 1 0.04",
                       "(f0 + (1.0 - f0) * p) * " + d + " * " + v);
  if (!half.empty()) text = replaced(text, "normalize(L + V)", half);
  return OwnSlips(text).slips;
}
constexpr const char* own_d = "D_GGX(NoH, roughness * roughness)";
constexpr const char* own_v = "V_Smith(NoL, NoV, roughness * roughness)";

TEST(SlipForms, ASlipOfDOrVIsNamedInAWholeModel) {
  SKIP_WITHOUT_SHADERS;
  EXPECT_EQ(whole_of(own_d, own_v), "");
  const std::string n = "(2.0 / pow(roughness, 4.0) - 2.0)";
  EXPECT_EQ(whole_of("(" + n + " + 2.0) / (2.0 * PI) * pow(NoH, " + n + ")", own_v), "");
  EXPECT_HAS(whole_of("(" + n + " + 1.0) / (2.0 * PI) * pow(NoH, " + n + ")", own_v),
             "n + 1 stands above where n + 2 belongs");
  const auto g1 = [](const std::string& c) {
    return "(2.0 * " + c + " / (" + c + " + sqrt(pow(roughness, 4.0) * (1.0 - " + c + " * " + c +
           ") + " + c + " * " + c + ")))";
  };
  const auto over = [](const std::string& g) { return g + " / (4.0 * NoL * NoV)"; };
  EXPECT_EQ(whole_of(own_d, over(g1("NoL") + " * " + g1("NoV"))), "");
  EXPECT_HAS(whole_of(own_d, over(g1("NoV"))), "that of the view only");
  EXPECT_HAS(whole_of(own_d, over(g1("NoV") + " * " + g1("NoV"))), "NoV stands in both factors");
  const auto grooves = [&](const std::string& clamp) {
    return whole_of(own_d, over(clamp + "2.0 * NoH * NoV / VoH, 2.0 * NoH * NoL / VoH))"));
  };
  EXPECT_EQ(grooves("min(1.0, min("), "");
  EXPECT_HAS(grooves("max(1.0, min("), "max stands where min belongs");
  EXPECT_HAS(whole_of(own_d, own_v, "normalize(N + L)"), "its half vector is that of N and L");
}

TEST(SlipForms, ASumInTheDenominatorOfG1IsNamed) {
  SKIP_WITHOUT_SHADERS;
  const auto smith = [](const std::string& sum) {
    const auto g1 = [&](const std::string& c) {
      return "2.0 * " + c + " / (" + c + " + sqrt(a2 + (1.0 - a2) * " + c + " * " + c + ")" + sum +
             ")";
    };
    return slips(masking("return " + g1("NoL") + " * " + g1("NoV") + " / (4.0 * NoL * NoV);"));
  };
  EXPECT_EQ(smith(""), "");
  EXPECT_EQ(smith(" + 1e-6"), "");
  EXPECT_HAS(smith(" + 0.05"), "0.05 is added to G1's denominator");
}

TEST(SlipForms, ADistributionsWidthMayHaveAnyNameAndMap) {
  SKIP_WITHOUT_SHADERS;
  const auto charlie = [](const std::string& parameter, const std::string& inverse) {
    const auto name = parameter.substr(0, parameter.find(' '));
    return audited("// " + parameter + "\nfloat D_term(float NoH, float " + name +
                   ") {\n  return (2.0 + " + inverse + ") * pow(1.0 - NoH * NoH, 0.5 * " + inverse +
                   ") / 6.28318530717959;\n}\n");
  };
  for (const auto& [parameter, inverse] :
       {std::pair<std::string, std::string>{"roughness 0.1 1 0.5", "(1.0 / roughness)"},
        {"softness 0 0.9 0.5", "(1.0 / (1.0 - softness))"},
        {"fibres 1 10 2", "fibres"},
        {"q 0.3 1 0.5", "(1.0 / (q * q))"}}) {
    const auto a = charlie(parameter, inverse);
    EXPECT_EQ(nearest(a), "ndf.charlie") << parameter;
    EXPECT_EQ(slips(a), "") << parameter;
  }
  EXPECT_HAS(slips(charlie("sheenRoughness 0.07 1 0.5", "sheenRoughness")),
             "its width is inverted");
  EXPECT_HAS(slips(audited(ggx("float a2 = pow(1.0 - roughness, 4.0);", whole, "roughness"))),
             "roughness is used as a smoothness");
}

TEST(SlipForms, ASquareRootThatIsMissingInSmithsMaskingIsNamed) {
  SKIP_WITHOUT_SHADERS;
  const std::string tan2 = "float tl = 1.0 / (NoL * NoL) - 1.0, tv = 1.0 / (NoV * NoV) - 1.0;\n  ";
  const auto over = [](const std::string& g) { return "return (" + g + ") / (4.0 * NoL * NoV);"; };
  // The same form in four spellings.
  for (const auto& right :
       {over("1.0 / (1.0 + lambda(NoL, alpha) + lambda(NoV, alpha))"),
        std::string("return 0.5 / (NoV * sqrt(NoL * NoL * (1.0 - a2) + a2) + NoL * sqrt(NoV * NoV "
                    "* (1.0 - a2) + a2));"),
        tan2 + over("2.0 / (sqrt(1.0 + a2 * tl) + sqrt(1.0 + a2 * tv))"),
        over("2.0 * NoL / (NoL + sqrt(a2 + (1.0 - a2) * NoL * NoL)) * 2.0 * NoV / (NoV + sqrt(a2 "
             "+ (1.0 - a2) * NoV * NoV))")})
    EXPECT_EQ(slips(masking(right)), "") << right;
  for (const auto& wrong :
       {std::string("return 0.5 / (NoV * (NoL * NoL * (1.0 - a2) + a2) + NoL * (NoV * NoV * (1.0 - "
                    "a2) + a2));"),
        tan2 + over("1.0 / (1.0 + 0.5 * a2 * tl + 0.5 * a2 * tv)"),
        tan2 + over("2.0 / (1.0 + (1.0 + a2 * tl)) * 2.0 / (1.0 + (1.0 + a2 * tv))"),
        over("2.0 * NoL / (NoL + a2 + (1.0 - a2) * NoL * NoL) * 2.0 * NoV / (NoV + a2 + (1.0 - a2) "
             "* NoV * NoV)")})
    EXPECT_HAS(slips(masking(wrong)), "the square root of Smith's masking is missing");
  EXPECT_HAS(slips(masking(tan2 + over("1.0 / (1.0 + 0.5 * sqrt(1.0 + a2 * tl) + 0.5 * sqrt(1.0 + "
                                       "a2 * tv))"))),
             "−1 is missing in Smith's Λ");
  EXPECT_HAS(slips(masking("return 0.5 / (NoV * sqrt(NoL * NoL + a2) + NoL * sqrt(NoV * NoV + "
                           "a2));")),
             "(1 − alpha²) is missing");
  EXPECT_HAS(
      slips(audited("// alpha 0.1 1 0.5\nfloat G1_Smith(float NoV, float alpha) { float t = 1.0 / "
                    "(NoV * NoV) - 1.0; return 2.0 / (1.0 + 1.0 + alpha * alpha * t); }\n")),
      "the square root of Smith's masking is missing");
  const auto whole = OwnSlips(replaced(
      model_of("float roughness 0.1 1 0.5, vec3 f0 0 1 0.04",
               "(f0 + (1.0 - f0) * p) * D_GGX(NoH, roughness * roughness) * V_Smith(NoL, NoV, "
               "roughness * roughness)"),
      "NoL * sqrt(NoV * NoV * (1.0 - q) + q)", "NoL * (NoV * NoV * (1.0 - q) + q)"));
  EXPECT_EQ(whole.slips, "") << "one root of two is none of the forms";
}

TEST(SlipForms, AClampThatHoldsACosineIsNamed) {
  SKIP_WITHOUT_SHADERS;
  const std::string smith =
      "return 0.5 / (NoV * sqrt(NoL * NoL * (1.0 - a2) + a2) + NoL * sqrt(NoV * NoV * (1.0 - a2) + "
      "a2));";
  EXPECT_EQ(slips(masking("NoV = max(NoV, 1e-4);\n  " + smith)), "");
  EXPECT_HAS(slips(masking("NoV = min(NoV, 1e-4);\n  " + smith)),
             "NoV changes nothing: it is not read, or a clamp holds it");
  EXPECT_EQ(slips(audited("// alpha 0.1 1 0.5\nfloat G1_GGX(float NoV, float alpha) { float a2 = "
                          "alpha * alpha; return 2.0 * NoV / (NoV + sqrt(a2 + (1.0 - a2) * NoV * "
                          "NoV)); }\n")),
            "")
      << "it takes one cosine";
  EXPECT_HAS(slips(masking("a2 = min(a2, 0.001);\n  " + smith)), "alpha changes nothing");
  const auto grooves = [](const std::string& g) {
    return slips(
        audited("float G_CT(float NoL, float NoV, float NoH, float VoH) {\n  float a = 2.0 * NoH * "
                "NoV / VoH, b = 2.0 * NoH * NoL / VoH;\n  return " +
                g + ";\n}\n"));
  };
  EXPECT_EQ(grooves("min(1.0, min(a, b))"), "");
  EXPECT_EQ(grooves("clamp(min(a, b), 0.0, 1.0)"), "");
  EXPECT_HAS(grooves("max(1.0, min(a, b))"), "max stands where min belongs");
  EXPECT_HAS(grooves("min(1.0, max(a, b))"), "max stands where min belongs");
  EXPECT_HAS(grooves("min(a, b)"), "the 1 is missing");
}

TEST(SlipForms, LightOfOnePolarisationIsNamed) {
  SKIP_WITHOUT_SHADERS;
  const auto of = [](const std::string& value) {
    return slips(
        audited("// eta 1.1 2.5 1.5\nfloat F_Dielectric(float VoH, float eta) {\n  float t = "
                "sqrt(1.0 - (1.0 - VoH * VoH) / (eta * eta));\n  float s = (VoH - eta * t) / (VoH "
                "+ eta * t), p = (eta * VoH - t) / (eta * VoH + t);\n  return " +
                value + ";\n}\n"));
  };
  EXPECT_EQ(of("0.5 * (s * s + p * p)"), "");
  EXPECT_EQ(of("(s * s + p * p) / 2.0"), "");
  EXPECT_HAS(of("s * s"), "across the plane of incidence (s)");
  EXPECT_HAS(of("p * p"), "in the plane of incidence (p)");
  EXPECT_HAS(of("s * s + p * p"), "the sum of both polarisations");
  const auto whole = [](const std::string& f) {
    return OwnSlips(
               "float fresnel(float c, float eta) { float t = sqrt(1.0 - (1.0 - c * c) / (eta "
               "* eta)), s = (c - eta * t) / (c + eta * t), p = (eta * c - t) / (eta * c + "
               "t); return " +
               f + "; }\n" +
               model_of("float roughness 0.1 1 0.5, float eta 1.1 2.5 1.5, vec3 kd 0 1 0.3",
                        "kd / PI + vec3(fresnel(VoH, eta) * D_GGX(NoH, roughness * roughness) "
                        "* V_Smith(NoL, NoV, roughness * roughness))"))
        .slips;
  };
  EXPECT_EQ(whole("0.5 * (s * s + p * p)"), "");
  EXPECT_HAS(whole("s * s"), "(s)");
}

std::string metal(const std::string& f) {
  return OwnSlips(model_of("float roughness 0.1 1 0.5, float metallic 0 1 0, vec3 albedo 0 1 0.5",
                           "albedo * (1.0 - metallic) * (1.0 - p) / PI + D_GGX(NoH, roughness * "
                           "roughness) * V_Smith(NoL, NoV, roughness * roughness) * " +
                               f))
      .slips;
}

TEST(SlipForms, AnF0ThatIsMixedInAfterFresnelsTermIsNamed) {
  SKIP_WITHOUT_SHADERS;
  EXPECT_EQ(metal("mix(mix(vec3(0.04), albedo, metallic), vec3(1.0), p)"), "");
  EXPECT_EQ(metal("mix(vec3(0.04 + 0.96 * p), albedo + (1.0 - albedo) * p, metallic)"), "")
      << "the same: Schlick's term is linear in F0";
  EXPECT_HAS(metal("mix(vec3(0.04 + 0.96 * p), albedo, metallic)"),
             "its metals have no Fresnel term");
}

TEST(SlipForms, ACosineOfTheSurfaceInFresnelsTermIsNamed) {
  SKIP_WITHOUT_SHADERS;
  const auto of = [](const std::string& power) {
    return OwnSlips(model_of("float roughness 0.1 1 0.5, vec3 f0 0 1 0.04",
                             "D_GGX(NoH, roughness * roughness) * V_Smith(NoL, NoV, roughness * "
                             "roughness) * (f0 + (1.0 - f0) * " +
                                 power + ")"))
        .slips;
  };
  EXPECT_EQ(of("exp2((-5.55473 * VoH - 6.98316) * VoH)"), "");
  EXPECT_EQ(of("pow5(1.0 - clamp(dot(L, H), 0.0, 1.0))"), "");
  EXPECT_HAS(of("pow5(1.0 - NoL)"), "takes NoL where VoH belongs");
  EXPECT_HAS(of("exp2((-5.55473 * NoV - 6.98316) * NoV)"), "takes NoV where VoH belongs");
  EXPECT_HAS(of("pow5(1.0 - max(dot(L, V), 0.0))"), "takes LoV where VoH belongs");
}

TEST(SlipForms, TheKOfImageLightIsAskedAsThatOfLampsIs) {
  SKIP_WITHOUT_SHADERS;
  const auto schlick = [](const std::string& k) {
    return OwnSlips("float g1(float c, float k) { return c / (c * (1.0 - k) + k); }\n" +
                    model_of("float roughness 0.1 1 0.5, vec3 f0 0 1 0.04",
                             "D_GGX(NoH, roughness * roughness) * g1(NoL, " + k + ") * g1(NoV, " +
                                 k + ") / (4.0 * NoL * NoV) * (f0 + (1.0 - f0) * p)"));
  };
  const auto asked = [](const OwnSlips& s) {
    std::string all;
    if (s.model)
      for (const auto& c : to_check(
               *s.model,
               OwnModel(model_of("float roughness 0.1 1 0.5", "vec3(roughness)")).parameters[0]))
        all += c + "\n";
    return all;
  };
  const auto image = schlick("0.5 * roughness * roughness");
  EXPECT_EQ(image.slips, "");
  EXPECT_HAS(asked(image), "its k is that of image light, alpha/2");
  const auto lamps = schlick("(roughness + 1.0) * (roughness + 1.0) / 8.0");
  EXPECT_EQ(lamps.slips, "");
  EXPECT_HAS(asked(lamps), "its k is that of direct light");
  EXPECT_HAS(schlick("0.5 * pow(roughness, 4.0)").slips,
             "alpha is roughness² in D and roughness⁴ in V");
  EXPECT_HAS(schlick("roughness * roughness").slips,
             "k is alpha: Schlick's masking has k = alpha/2");
}

TEST(Slips, OfSheensAndOfDiffuseFunctionsAreNamed) {
  SKIP_WITHOUT_SHADERS;
  const auto charlie = [](const std::string& exponent) {
    return slips(audited(
        "// roughness 0.3 1 0.5\nfloat D_Charlie(float roughness, float NoH) { float inv = 1.0 / "
        "(roughness * roughness); return (2.0 + inv) * pow(1.0 - NoH * NoH, " +
        exponent + ") / (2.0 * 3.14159265358979); }\n"));
  };
  EXPECT_EQ(charlie("inv * 0.5"), "");
  EXPECT_HAS(charlie("inv"), "½ is missing in Charlie's exponent");
  EXPECT_HAS(slips(audited("float V_Neubelt(float NoV, float NoL) { return 1.0 / (4.0 * (NoL + NoV "
                           "+ NoL * NoV)); }\n")),
             "+ NoL NoV stands below where − NoL NoV belongs");
  const auto burley = [](const std::string& facing) {
    return slips(audited(
        "// roughness 0 1 0.5\n// albedo 0 1 0.8\nvec3 diffuse(vec3 n, vec3 v, vec3 l, float "
        "roughness, vec3 albedo) { float NoL = dot(n, l), NoV = dot(n, v), LoH = dot(l, "
        "normalize(l + v)), f = 2.0 * roughness * " +
        facing +
        " - 0.5; return albedo / 3.14159265358979 * (1.0 + f * pow(1.0 - NoL, 5.0)) * (1.0 + f * "
        "pow(1.0 - NoV, 5.0)); }\n"));
  };
  EXPECT_EQ(burley("LoH * LoH"), "");
  EXPECT_HAS(burley("LoH"), "VoH is not squared in F90");
  const auto oren_nayar = [](const std::string& t) {
    return slips(audited(
        "// sigma 0 1 0.3\n// albedo 0 1 0.8\nvec3 diffuse(vec3 l, vec3 v, vec3 n, float sigma, "
        "vec3 albedo) { float NoL = dot(n, l), NoV = dot(n, v), q = sigma * sigma, s = dot(l, v) - "
        "NoL * NoV; return albedo * (1.0 - 0.5 * q / (q + 0.33) + 0.45 * q / (q + 0.09) * max(s, "
        "0.0) / (s > 0.0 ? " +
        t + "(NoL, NoV) : 1.0)) / 3.14159265358979; }\n"));
  };
  EXPECT_EQ(oren_nayar("max"), "");
  EXPECT_HAS(oren_nayar("min"), "min stands where max belongs: s/max(NoL, NoV)");
}

TEST(Slips, ARootThatG1LacksAndASignInAGaussianOfFresnelAreNamed) {
  SKIP_WITHOUT_SHADERS;
  EXPECT_HAS(
      slips(audited("// alpha 0.05 1 0.4\nfloat G1(float NoV, float alpha) { float a2 = alpha "
                    "* alpha; return 2.0 * NoV / (NoV + a2 + (1.0 - a2) * NoV * NoV); }\n")),
      "the square root of Smith's masking is missing");
  const auto gaussian = [](const std::string& sign) {
    return slips(
        audited("float F(float F0, float VoH) { return F0 + (1.0 - F0) * exp2((-5.55473 * "
                "VoH " +
                sign + " 6.98316) * VoH); }\n"));
  };
  EXPECT_EQ(gaussian("-"), "");
  EXPECT_HAS(gaussian("+"), "+ 6.98316 stands where − 6.98316 belongs");
}

TEST(Slips, AnF0ThatIsMixedTwiceIsNamed) {
  SKIP_WITHOUT_SHADERS;
  const auto with = [](const std::string& f0) {
    return OwnSlips(model_of("vec3 albedo 0 1 0.5, float metallic 0 1 0, float roughness 0.1 1 0.4",
                             "albedo * (1.0 - metallic) / PI + D_GGX(NoH, roughness * roughness) * "
                             "V_Smith(NoL, NoV, roughness * roughness) * (" +
                                 f0 + " + (1.0 - " + f0 + ") * p)"))
        .slips;
  };
  EXPECT_EQ(with("mix(vec3(0.04), albedo, metallic)"), "");
  EXPECT_HAS(with("mix(vec3(0.04), mix(vec3(0.04), albedo, metallic), metallic)"),
             "its F0 is mixed twice");
}

TEST(SlipForms, ClampsOfAWholeHighlightAreNamed) {
  SKIP_WITHOUT_SHADERS;
  const std::string arguments = "float alpha 0.05 1 0.3, vec3 f0 0 1 0.04",
                    light = "D_GGX(NoH, alpha) * V_Smith(NoL, NoV, alpha) * (f0 + (1.0 - f0) * p)";
  EXPECT_HAS(OwnSlips(model_of(arguments, "clamp(" + light + ", 0.0, 1.0)")).slips,
             "a guard or a clamp cuts the peak below alpha");
  EXPECT_HAS(OwnSlips(model_of(arguments, replaced(light, "(NoH,", "(min(NoH, 0.0),"))).slips,
             "NoH is 0 everywhere: a clamp holds it, as min in the place of max");
  EXPECT_EQ(OwnSlips(model_of(arguments, light)).slips, "");
}

TEST(SlipForms, AFunctionWithoutValuesOfAFormIsAccusedOfNone) {
  SKIP_WITHOUT_SHADERS;
  EXPECT_EQ(
      OwnSlips(replaced(model_of("float alpha 0.05 1 0.3, vec3 f0 0 1 0.04",
                                 "D_GGX(NoH, alpha) * V_Smith(NoL, NoV, alpha) * (f0 + (1.0 - "
                                 "f0) * p)"),
                        "L + V)", "V - L)"))
          .slips,
      "");
  const auto twice = audited(
      "// alpha 0.1 1 0.5\nfloat V_Smith(float NoL, float NoV, float alpha) { return 0.25 / (NoL * "
      "sqrt(NoV * NoV * (1.0 - alpha * alpha) + alpha * alpha)); }\n");
  EXPECT_HAS(slips(twice), "its term of the view stands twice");
}

TEST(SlipForms, AMetalThatKeepsItsDiffusePartHasOurHighlight) {
  SKIP_WITHOUT_SHADERS;
  const auto of = [](const std::string& diffuse, const std::string& f0) {
    return OwnSlips(model_of("float alpha 0.05 1 0.3, vec3 baseColor 0 1 0.5, float metallic 0 1 0",
                             diffuse +
                                 " / PI + D_GGX(NoH, alpha) * V_Smith(NoL, NoV, alpha) * mix(" +
                                 f0 + ", vec3(1.0), p)"));
  };
  const auto kept = of("baseColor", "mix(vec3(0.04), baseColor, metallic)");
  ASSERT_TRUE(kept.model) << kept.why;
  EXPECT_EQ(kept.model->spec, "lambert+ggx/smith_ggx.correlated/schlick");
  EXPECT_HAS(kept.slips, "its diffuse part is left where metallic is 1");
  EXPECT_NEAR(kept.highlight->value, 1, 0.01);
  const auto swapped = of("baseColor * (1.0 - metallic)", "mix(baseColor, vec3(0.04), metallic)");
  ASSERT_TRUE(swapped.model) << swapped.why;
  EXPECT_HAS(swapped.slips, "baseColor is F0 where metallic is 0: expected where it is 1");
  EXPECT_NEAR(swapped.highlight->value, 1, 0.01);
}

TEST(SlipForms, LambertUnderTheHighlightsFresnelTermIsOurs) {
  SKIP_WITHOUT_SHADERS;
  const OwnSlips s(model_of("float alpha 0.05 1 0.3, vec3 f0 0 1 0.04, vec3 kd 0 1 0.5",
                            "(1.0 - f0 - (1.0 - f0) * p) * kd / PI + D_GGX(NoH, alpha) * "
                            "V_Smith(NoL, NoV, alpha) * (f0 + (1.0 - f0) * p)"));
  ASSERT_TRUE(s.model) << s.why;
  EXPECT_EQ(s.model->spec, "lambert.coupled+ggx/smith_ggx.correlated/schlick");
  EXPECT_EQ(s.slips, "");
}

TEST(SlipForms, PiThatOnlyAGuessTookOutIsLeftIn) {
  SKIP_WITHOUT_SHADERS;
  const auto a = audited(replaced(whole_model("a * a", "a * a", "VoH"), "/ (4.0 * NoL * NoV)", ""));
  EXPECT_EQ(slips(a), "G stands where V belongs: its highlight lacks the division by 4 NoL NoV\n");
  EXPECT_EQ(a.of.function->includes, "nothing");
}

TEST(SlipForms, TypicalSlipsOfPartsAreNamed) {
  SKIP_WITHOUT_SHADERS;
  const auto fresnel = [](const std::string& value) {
    return slips(
        audited("// f0 0 1 0.04\nfloat F_Schlick(float f0, float VoH) { float p = pow(1.0 - "
                "VoH, 5.0); return " +
                value + "; }\n"));
  };
  EXPECT_HAS(fresnel("f0 + (1.0 - f0) * exp((-5.55473 * VoH - 6.98316) * VoH)"), "exp2 belongs");
  EXPECT_HAS(fresnel("f0 + (1.0 - f0) * pow(1.0 + VoH, 5.0)"), "1 + VoH stands");
  EXPECT_HAS(fresnel("f0 - (1.0 - f0) * p"), "F0 − (1 − F0)");
  EXPECT_HAS(fresnel("f0 + (1.0 + f0) * p"), "(1 + F0)");
  EXPECT_HAS(fresnel("f0 * (1.0 - f0) * p"), "F0 (1 − F0)");
  EXPECT_EQ(fresnel("f0 + (1.0 - f0) * p"), "");
  const auto burley = [](const std::string& f90, const std::string& factor) {
    auto text =
        "// roughness 0.05 1 0.5\nfloat Fd(float NoV, float NoL, float LoH, float NoH, float "
        "roughness) { float f = " +
        f90 + "; return (1.0 + f * " + factor + ") * (1.0 + f * " +
        (factor == "pow(NoL, 5.0)" ? "pow(NoV, 5.0)" : "pow(1.0 - NoV, 5.0)") +
        ") / 3.14159265358979; }\n";
    return slips(audited(text));
  };
  const std::string right = "2.0 * roughness * LoH * LoH - 0.5", fifth = "pow(1.0 - NoL, 5.0)";
  EXPECT_EQ(burley(right, fifth), "");
  EXPECT_HAS(burley("2.0 * roughness * NoH * NoH - 0.5", fifth), "NoH stands where VoH belongs");
  EXPECT_HAS(burley(right, "pow(NoL, 5.0)"), "NoL⁵ and NoV⁵ stand");
  EXPECT_HAS(burley("2.0 * roughness * LoH * LoH + 0.5", fifth), "F90 − 1 belongs");
  EXPECT_HAS(burley("roughness * LoH * LoH - 0.5", fifth), "the 2 is missing");
  const auto v = audited(
      "// alpha 0.1 1 0.5\nfloat V_Smith(float NoL, float NoV, float alpha) { float q = alpha * "
      "alpha; return 0.5 / (NoL * sqrt(NoV * NoV * (1.0 + q) + q) + NoV * sqrt(NoL * NoL * (1.0 + "
      "q) "
      "+ q)); }\n");
  EXPECT_HAS(slips(v), "1 + alpha² stands");
}

TEST(SlipForms, TypicalSlipsOfWholeModelsAreNamed) {
  SKIP_WITHOUT_SHADERS;
  const std::string arguments = "float alpha 0.05 1 0.3, vec3 f0 0 1 0.04, vec3 kd 0 1 0.5",
                    lobe = "D_GGX(NoH, alpha) * V_Smith(NoL, NoV, alpha)",
                    f = " * (f0 + (1.0 - f0) * p)";
  EXPECT_HAS(OwnSlips(model_of(arguments, "kd / PI + " + lobe + f + " / (4.0 * NoL * NoV)")).slips,
             "4 NoL NoV stands below twice");
  EXPECT_HAS(OwnSlips(model_of(arguments, "(1.0 - f0 - (1.0 - f0) * p) * kd / PI + " + lobe)).slips,
             "its Fresnel term is missing");
  EXPECT_HAS(OwnSlips(model_of(arguments, "kd / PI" + f + " + " + lobe + f)).slips,
             "its diffuse part is multiplied by F");
  EXPECT_EQ(OwnSlips(model_of(arguments, "kd / PI + " + lobe + f)).slips, "");
}

}  // namespace
}  // namespace gonio
