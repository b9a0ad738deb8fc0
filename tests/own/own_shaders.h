#pragma once
/// \file
/// Small shaders of our own, right ones and with slips, and their audits.

#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "brdf/catalogue/foreign_terms.h"
#include "foreign/compile.h"
#include "reports/own/audit_file.h"
#include "reports/own/parts.h"
#include "support.h"

namespace gonio {

#define SKIP_WITHOUT_SHADERS \
  if (!foreign::can_compile()) GTEST_SKIP() << "this build reads no shaders"

/// The audit of a text's first function, or of another, but for what it keeps in half, once in a run.
inline const FunctionAudit& audited(const std::string& text, std::size_t function = 0) {
  static std::map<std::pair<std::string, std::size_t>, FunctionAudit> known;
  const auto [at, fresh] = known.try_emplace({text, function});
  if (fresh) {
    const test::Folder folder;
    at->second = audit_file(folder.write("case.glsl", text), {}, false)[function];
  }
  return at->second;
}
inline std::string half_of(const std::string& text) {
  const test::Folder folder;
  return audit_file(folder.write("case.glsl", text))[0].half;
}
inline std::string slips(const FunctionAudit& a) {
  std::string all;
  for (const auto& s : a.slips) all += s + "\n";
  return all;
}
inline std::string nearest(const FunctionAudit& a) {
  return a.nearest && is_same(*a.nearest) ? std::string(catalogue()[a.nearest->term].id()) : "none";
}
inline std::string ggx(const std::string& before,
                       const std::string& numerator,
                       const std::string& name) {
  return "// " + name + " 0.05 1 0.5\nfloat D_GGX(float NoH, float " + name + ") {\n  " + before +
         "\n  float d = NoH * NoH * (a2 - 1.0) + 1.0;\n  return " + numerator + ";\n}\n";
}
inline constexpr const char* whole = "a2 / (3.14159265358979 * d * d)";

inline std::string replaced(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);
}

/// A text's function "model", read in some way, and what an audit asks of it.
struct OwnModel {
  test::Folder folder;
  std::string name;
  std::size_t term;
  std::vector<Parameter> parameters;
  const foreign::Function& function;
  OwnAlbedo albedo;

  explicit OwnModel(const std::string& text, const std::string& reading = "")
      : name(folder.write("case.glsl", text) + ":model" + reading),
        term(foreign_term_named(name)),
        parameters(known_parameters(term)),
        function(*foreign_term(term)->function),
        albedo(name, parameters, function.programs.size(), function.anisotropic) {}
};
/// Its slips as a whole model and in its parts, and what is to be checked.
struct OwnSlips {
  std::string slips, to_check, why;
  std::optional<NearestModel> model;
  std::optional<FoundAt> highlight;

  explicit OwnSlips(const std::string& text, const std::string& reading = "") {
    const OwnModel own(text, reading);
    model = nearest_model(own.term, why);
    const bool guessed_pi = own.function.includes.find("pi") != std::string::npos;
    const auto parts =
        audit_parts(own.term, own.albedo, model, model && is_sheen(*model), guessed_pi);
    highlight = parts.highlight;
    auto all = parts.slips;
    if (model)
      for (auto& s : likely_slips(*model, own.parameters[model->width], guessed_pi))
        all.push_back(s);
    for (const auto& s : all) slips += s + "\n";
    for (const auto& s : parts.to_check) to_check += s + "\n";
  }
};

/// Functions that parts of models are made of.
inline constexpr const char* terms =
    "const float PI = 3.14159265358979;\n"
    "float pow5(float u) { return u * u * u * u * u; }\n"
    "float D_GGX(float NoH, float a) { float d = NoH * NoH * (a * a - 1.0) + 1.0; return a * a / "
    "(PI * d * d); }\n"
    "float V_Smith(float NoL, float NoV, float a) { float q = a * a; return 0.5 / (NoV * sqrt(NoL "
    "* "
    "NoL * (1.0 - q) + q) + NoL * sqrt(NoV * NoV * (1.0 - q) + q)); }\n"
    "float burley(float NoL, float NoV, float VoH, float r) { float f = 2.0 * r * VoH * VoH - 0.5; "
    "return (1.0 + f * pow5(1.0 - NoL)) * (1.0 + f * pow5(1.0 - NoV)); }\n";
/// A whole model of these: parameters with their bounds, as "float roughness 0.1 1 0.4, …", and its value.
inline std::string model_of(const std::string& parameters, const std::string& value) {
  std::string text = terms, arguments;
  std::istringstream all(parameters);
  for (std::string one; std::getline(all, one, ',');) {
    std::istringstream words(one);
    std::string type, name, bounds;
    words >> type >> name;
    std::getline(words, bounds);
    text += "// " + name + bounds + "\n";
    arguments += ", " + type + " " + name;
  }
  return text + "vec3 model(vec3 N, vec3 L, vec3 V, vec3 T, vec3 B" + arguments +
         ") {\n  vec3 H = normalize(L + V);\n  float NoL = dot(N, L), NoV = dot(N, V), NoH = "
         "dot(N, "
         "H), VoH = dot(V, H), p = pow5(1.0 - VoH);\n  return " +
         value + ";\n}\n";
}

/// Lambert and GGX with separate masking, as many tutorials have it.
inline std::string tutorial(const std::string& over) {
  return "// roughness 0.05 1 0.5\n// f0 0 1 0.04\n// albedo 0 1 0.5\n"
         "vec3 brdf(vec3 L, vec3 V, vec3 N, float roughness, vec3 f0, vec3 albedo) {\n"
         "  vec3 H = normalize(L + V);\n"
         "  float NoL = dot(N, L), NoV = dot(N, V), NoH = dot(N, H), VoH = dot(V, H);\n"
         "  float a2 = pow(roughness, 4.0), d = NoH * NoH * (a2 - 1.0) + 1.0;\n"
         "  float D = a2 / (3.14159265358979 * d * d);\n"
         "  float G = 2.0 * NoV / (NoV + sqrt(a2 + (1.0 - a2) * NoV * NoV)) * 2.0 * NoL / (NoL + "
         "sqrt(a2 + (1.0 - a2) * NoL * NoL));\n"
         "  vec3 F = f0 + (1.0 - f0) * pow(1.0 - VoH, 5.0);\n"
         "  return albedo / 3.14159265358979 + D * G * F / (" +
         over + " * NoL * NoV);\n}\n";
}

/// Three functions of N, V and L: what D and V divide by, and Fresnel's cosine, are put in.
inline std::string whole_model(const std::string& d_of,
                               const std::string& v_of,
                               const std::string& cosine,
                               const std::string& over = "") {
  return "// roughness 0.05 1 0.4\n// F0 0 1 0.04\nvec3 f(vec3 N, vec3 V, vec3 L, float roughness, "
         "vec3 F0) "
         "{\n  vec3 H = normalize(V + L);\n  float NoL = dot(N, L), NoV = dot(N, V), NoH = dot(N, "
         "H), VoH = dot(V, H);\n"
         "  float a = roughness * roughness, d2 = " +
         d_of + ", v2 = " + v_of +
         ";\n"
         "  float d = NoH * NoH * (d2 - 1.0) + 1.0;\n"
         "  float G = 2.0 * NoL * NoV / (NoV * sqrt(NoL * NoL * (1.0 - v2) + v2) + NoL * sqrt(NoV "
         "* NoV * (1.0 - v2) + v2));\n"
         "  return d2 / (3.14159265358979 * d * d) * G * (F0 + (1.0 - F0) * pow(1.0 - " +
         cosine + ", 5.0)) / (4.0 * NoL * NoV" + over + ");\n}\n";
}

}  // namespace gonio
