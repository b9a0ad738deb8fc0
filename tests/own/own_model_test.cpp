// A person's function as a term and as a whole model: values, derivatives, albedo, fits.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <thread>

#include "brdf/catalogue/foreign_terms.h"
#include "brdf/cost/model_operations.h"
#include "brdf/in_number/one_term.h"
#include "brdf/model/derivatives.h"
#include "brdf/model/evaluate.h"
#include "data_synth/synth.h"
#include "fitting/fit.h"
#include "foreign/compile.h"
#include "geometry/half_difference.h"
#include "integrate/albedo/directional_albedo.h"
#include "refusal.h"
#include "stability/answer.h"
#include "support.h"

#include <fmt/format.h>

namespace gonio {
namespace {

using test::Folder;
using test::refusal;

#define SKIP_WITHOUT_SHADERS \
  if (!foreign::can_compile()) GTEST_SKIP() << "this build reads no shaders"

constexpr const char* usual =
    "// alpha 0.001 1 0.2\n// f0 0 1 0.04\n// kd 0 1 0.5\n"
    "const float PI = 3.14159265358979323846;\n"
    "float D_GGX(float NoH, float alpha) {\n  float a2 = alpha * alpha;\n"
    "  float d = NoH * NoH * (a2 - 1.0) + 1.0;\n  return a2 / (PI * d * d);\n}\n"
    "float V_Smith(float NoL, float NoV, float alpha) {\n  float a2 = alpha * alpha;\n"
    "  return 0.5 / (NoV * sqrt(NoL * NoL * (1.0 - a2) + a2) + NoL * sqrt(NoV * NoV * (1.0 - a2) + "
    "a2));\n}\n"
    "vec3 F_Schlick(vec3 f0, float VoH) { return f0 + (1.0 - f0) * pow(1.0 - VoH, 5.0); }\n"
    "vec3 brdf(vec3 l, vec3 v, vec3 n, float alpha, vec3 f0, vec3 kd) {\n"
    "  float NoL = dot(n, l), NoV = dot(n, v);\n"
    "  if (NoL <= 0.0 || NoV <= 0.0) return vec3(0.0);\n  vec3 h = normalize(l + v);\n"
    "  float NoH = clamp(dot(n, h), 0.0, 1.0), VoH = clamp(dot(v, h), 0.0, 1.0);\n"
    "  return kd / PI + D_GGX(NoH, alpha) * V_Smith(NoL, NoV, alpha) * F_Schlick(f0, VoH);\n}\n";
constexpr const char* ours = "lambert+ggx/smith_ggx.correlated/schlick";

/// One file for all tests: each of its functions is a term once in a run.
const std::string& file() {
  static const Folder folder;
  static const std::string path = folder.write("usual.glsl", usual);
  return path;
}

std::vector<FrameAngles<double>> drawn(std::size_t n) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> mu(0.05, 0.999), phi(0, 2 * std::numbers::pi);
  std::vector<FrameAngles<double>> all;
  for (std::size_t i = 0; i < n; ++i)
    all.push_back(frame_angles({direction(std::acos(mu(random)), phi(random)),
                                direction(std::acos(mu(random)), phi(random))}));
  return all;
}
std::vector<Setting> settings(double alpha) {
  return {{"alpha", {alpha}}, {"f0", {0.6, 0.5, 0.4}}, {"kd", {0.1, 0.2, 0.3}}};
}

void expect_close(const std::vector<std::vector<double>>& f,
                  const std::vector<std::vector<double>>& g,
                  double within) {
  ASSERT_EQ(f.size(), g.size());
  for (std::size_t c = 0; c < f.size(); ++c)
    for (std::size_t i = 0; i < f[c].size(); ++i)
      EXPECT_NEAR(f[c][i] / g[c][i], 1, within) << c << ' ' << i;
}

/// A highlight without tails lies between the nodes of a rule for diffuse terms, which agree on 0.
TEST(OwnModel, TheAlbedoOfANarrowHighlightIsSeen) {
  SKIP_WITHOUT_SHADERS;
  const Folder folder;
  const auto path = folder.write("narrow.glsl",
                                 "// alpha 0.001 1 0.1\n// kd 0 1 0\nfloat f(vec3 N, vec3 V, vec3 "
                                 "L, float alpha, float kd) {\n"
                                 "  vec3 H = normalize(V + L);\n  float nl = dot(N, L), nv = "
                                 "dot(N, V), c = dot(N, H), m2 = alpha * alpha;\n"
                                 "  float tan2 = (H.x * H.x + H.y * H.y) / (c * c), D = exp(-tan2 "
                                 "/ m2) / (3.14159265358979 * m2 * c * c * c * c);\n"
                                 "  return kd / 3.14159265358979 + D * min(1.0, min(nl, nv) * 2.0 "
                                 "* c / dot(V, H)) / (4.0 * nl * nv);\n}\n");
  const std::vector<double> mu{0.05, 0.1, 0.2, 0.7, 1};
  for (const std::string alpha : {"0.001", "0.005", "0.03", "0.2", "1"}) {
    const std::vector<std::string> own{"alpha=" + alpha, "kd=0.3"},
        other{"alpha=" + alpha, "f0=1", "kd=0.3"};
    const auto mine = directional_albedo(bind_model(path, parse_settings(own), 1), mu);
    const auto known = directional_albedo(
        bind_model("lambert+beckmann/cook_torrance/schlick", parse_settings(other), 1), mu);
    for (std::size_t i = 0; i < mu.size(); ++i)
      EXPECT_NEAR(mine[i].value[0], known[i].value[0], mine[i].error + known[i].error + 1e-6)
          << alpha << " " << mu[i];
  }
}

/// A file's default colour has three channels; one whose channels it mixes is set by its name, too.
TEST(OwnModel, AColourOfAFileKeepsItsChannels) {
  SKIP_WITHOUT_SHADERS;
  const Folder folder;
  const auto file_of = [&](const char* name, const std::string& value) {
    return folder.write(
        name,
        "analytic\n::begin parameters\ncolor tint 0.5 0.2 0.1\n::end parameters\n::begin shader\n"
        "vec3 BRDF(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y) { return " +
            value + " / 3.14159265358979; }\n::end shader\n");
  };
  const std::array mu{0.5};
  const auto own = directional_albedo(bind_model(file_of("own.brdf", "tint"), {}), mu)[0].value;
  EXPECT_NEAR(own[0], 0.5, 1e-6);
  EXPECT_NEAR(own[1], 0.2, 1e-6);
  EXPECT_NEAR(own[2], 0.1, 1e-6);
  const auto mixed = file_of("mixed.brdf", "mix(tint, vec3(dot(tint, vec3(1.0)) / 3.0), 0.5)");
  const std::vector<std::string> words{"tint=0.6,0.3,0.3"};
  const auto set = directional_albedo(bind_model(mixed, parse_settings(words)), mu)[0].value;
  EXPECT_NEAR(set[0], 0.5, 1e-6);
  EXPECT_NEAR(set[1], 0.35, 1e-6);
  EXPECT_HAS(
      refusal(
          [&] {
            bind_model(mixed, parse_settings(std::vector<std::string>{"tint=1", "tint_r=1"}));
          },
          Exit::usage),
      "same parameter");
}

/// A parameter of a file is what the file says, also where the catalogue has one of that name.
TEST(OwnModel, MetallicAndRoughnessBesideAlphaAreTheFilesOwn) {
  SKIP_WITHOUT_SHADERS;
  const Folder folder;
  const auto path =
      folder.write("names.glsl",
                   "// metallic 0 1 0.5\n// roughness 0 1 0.5\n// alpha 0 1 0.5\n// metal 0 1 "
                   "0.5\n// f0 0 1 0.5\n// eta 1 2 1.5\n"
                   "float brdf(float NoL, float NoV, float NoH, float metallic, float roughness, "
                   "float alpha, float metal, float f0, float eta) {\n"
                   "  return 0.01 * (metallic + 2.0 * roughness + 4.0 * alpha + 8.0 * metal + f0 + "
                   "eta) + 0.0 * NoL * NoV * NoH;\n}\n");
  const std::vector<std::string> words{"metallic=1", "roughness=1", "alpha=0",
                                       "metal=0.5",  "f0=0",        "eta=1"};
  const auto b = bind_model(path + "{includes=nothing}", parse_settings(words), 1);
  EXPECT_NEAR(evaluate(b, drawn(1))[0][0], 0.08, 1e-12);
}

TEST(OwnModel, IsTheModelThatItsTextSays) {
  SKIP_WITHOUT_SHADERS;
  const auto at = drawn(300);
  const auto own = evaluate(bind_model(file() + ":brdf", settings(0.3)), at);
  expect_close(own, evaluate(bind_model(ours, settings(0.3)), at), 1e-11);
}

TEST(OwnModel, NeedsNoFrameWhereItDoesNotCareHowTheSurfaceIsTurned) {
  SKIP_WITHOUT_SHADERS;
  const auto at = drawn(300);
  const std::vector<Angles<double>> angles(at.begin(), at.end());
  const auto m = bind_model(file() + ":brdf", settings(0.05));
  expect_close(evaluate(m, angles), evaluate(m, at), 1e-9);
}

TEST(OwnModel, ATermOfOnesOwnStandsInASpec) {
  SKIP_WITHOUT_SHADERS;
  const auto at = drawn(300);
  const auto wanted = evaluate(
      bind_model("ggx/smith_ggx.correlated/schlick", {{"alpha", {0.3}}, {"f0", {0.6, 0.5, 0.4}}}),
      at);
  for (const auto& spec :
       {file() + ":D_GGX/smith_ggx.correlated/schlick", "ggx/" + file() + ":V_Smith/schlick",
        "ggx/smith_ggx.correlated/" + file() + ":F_Schlick",
        file() + ":D_GGX/" + file() + ":V_Smith/" + file() + ":F_Schlick"}) {
    const auto m = bind_model(spec, {{"alpha", {0.3}}, {"f0", {0.6, 0.5, 0.4}}});
    expect_close(evaluate(m, at), wanted, 1e-11);
  }
}

TEST(OwnModel, DerivativesAreThoseOfOurs) {
  SKIP_WITHOUT_SHADERS;
  const auto at = drawn(64);
  const auto derivatives = [&](const std::string& spec) {
    const auto b = bind_model(spec, settings(0.3));
    AngleColumns<double> x(at.size());
    for (std::size_t i = 0; i < at.size(); ++i) x.set(i, at[i]);
    const std::vector<bool> free(b.model.value_count, true);
    ModelDerivatives<double> d(b.model, free, kernels<double>());
    d.set(b.values);
    std::map<std::pair<std::string, std::size_t>, std::vector<double>> all;
    d.run(x.block(), [&](std::size_t c) {
      for (const auto& [slot, column] : d.channel(c).d)
        for (const auto& p : b.model.parameters)
          if (p.slot(c) == slot) all[{p.name, c}].assign(column, column + at.size());
    });
    return all;
  };
  const auto own = derivatives(file() + ":brdf"), wanted = derivatives(ours);
  ASSERT_EQ(own.size(), wanted.size());
  for (const auto& [of, column] : wanted)
    for (std::size_t i = 0; i < column.size(); ++i)
      EXPECT_NEAR(own.at(of)[i], column[i], 1e-8 * (1 + std::abs(column[i]))) << of.first;
}

TEST(OwnModel, AlbedoIsThatOfOurs) {
  SKIP_WITHOUT_SHADERS;
  constexpr std::array mu{0.2, 0.9};
  const auto own = directional_albedo(bind_model(file() + ":brdf", settings(0.3)), mu);
  const auto wanted = directional_albedo(bind_model(ours, settings(0.3)), mu);
  for (std::size_t i = 0; i < mu.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(own[i].value[c], wanted[i].value[c], 1e-4);
}

TEST(OwnModel, AFitFindsItsParametersAgain) {
  SKIP_WITHOUT_SHADERS;
  for (const double alpha : {0.05, 0.5}) {
    SynthOptions s;
    s.layout = Layout::random;
    s.samples = 3000;
    const Table t = synthesize(bind_model(ours, settings(alpha)), s);
    FitOptions o;
    o.model = file() + ":brdf";
    const auto r = fit(t, o);
    const auto named = named_values(r.model);
    const auto value = [&](std::string_view name, std::size_t c) {
      return std::ranges::find(named, name, [](const auto& n) { return n.first; })->second[c];
    };
    EXPECT_NEAR(value("alpha", 0), alpha, 1e-5);
    EXPECT_NEAR(value("f0", 2), 0.4, 1e-4);
    EXPECT_NEAR(value("kd", 0), 0.1, 1e-4);
  }
}

TEST(OwnModel, AFitNamesTheSamplesWhereThereIsNoValue) {
  SKIP_WITHOUT_SHADERS;
  const Folder folder;
  FitOptions o;
  o.model = folder.write(
      "rim.glsl",
      "// kd 0 1 0.5\nfloat f(float NoL, float NoV, float NoH, float kd) { return kd / "
      "3.14159265 + 0.0 * NoH * NoL * sqrt(NoV - 0.2); }\n");
  SynthOptions s;
  s.layout = Layout::random;
  s.samples = 300;
  const Table t = synthesize(bind_model("lambert", {{"kd", {0.5}}}), s);
  const auto said = refusal([&] { fit(t, o); });
  EXPECT_HAS(said, "of 300 samples");
  EXPECT_HAS(said, "found no value, first at");
}

TEST(OwnModel, AFreeParameterWithoutBoundsIsNamed) {
  SKIP_WITHOUT_SHADERS;
  const Folder folder;
  const auto path = folder.write(
      "bare.glsl", "float f(float NoL, float NoV, float width) { return width / (NoL + NoV); }\n");
  SynthOptions s;
  s.layout = Layout::random;
  s.samples = 200;
  const Table t = synthesize(bind_model("lambert", {{"kd", {0.5}}}), s);
  FitOptions o;
  o.model = path;
  EXPECT_HAS(refusal([&] { fit(t, o); }, Exit::usage), "width is free and has no bounds");
  o.bounds = {{"width", {0.1, 2}}};
  EXPECT_GT(named_values(fit(t, o).model)[0].second[0], 0.1);
}

TEST(OwnModel, IsLookedAtInHalfAndInFiftyDigits) {
  SKIP_WITHOUT_SHADERS;
  const auto term = file() + ":D_GGX";
  const auto at = [&](const char* number, double noh) {
    return evaluate_term(find_term(term), value_of<Number>(number, "number"), {{"alpha", 0.01}},
                         {{"noh", {noh}}})
        .values[0];
  };
  EXPECT_TRUE(std::isinf(at("half", 1)));  // α² − 1 rounds to −1
  EXPECT_NEAR(at("wide", 1), 1 / (std::numbers::pi * 1e-4), 1e-10);
  stability::Question q;
  q.subject = stability::subjects_of(term).front();
  stability::set_domain(q.subject, "alpha", {0.005, 0.1});
  const auto a = stability::answer(q);
  EXPECT_FALSE(a.holds);
  ASSERT_TRUE(a.safe_from && a.safe_from->value);
  EXPECT_NEAR(*a.safe_from->value, 0.0156, 0.002);
}

TEST(OwnModel, ASmoothnessIsSafeInHalfUpToAValue) {
  SKIP_WITHOUT_SHADERS;
  const auto safe_up_to = [](const std::string& tint, stability::Evidence evidence) {
    const Folder folder;
    stability::Question q;
    q.subject =
        stability::subjects_of(
            folder.write("smooth.glsl",
                         "// tint 0 1 0.5\n// smoothness 0 0.95 0.5\nfloat D(float NoH" +
                             (tint.empty() ? "" : ", float " + tint) +
                             ", float smoothness) {\n  float r = 1.0 - smoothness, a2 = r * r * "
                             "r * r, d = NoH * NoH * (a2 - 1.0) + 1.0;\n  return " +
                             (tint.empty() ? "" : tint + " * ") +
                             "a2 / (3.14159265 * d * d);\n}\n") +
            ":D")
            .back();
    EXPECT_TRUE(q.subject.narrows);
    const auto a = stability::answer(q);
    EXPECT_FALSE(a.holds);
    EXPECT_EQ(a.safe_from->evidence, evidence);
    return a.safe_from->value.value_or(-1);
  };
  // α² − 1 rounds to −1 from there on.
  const double exhaustive = safe_up_to("", stability::Evidence::exhaustive);
  EXPECT_NEAR(exhaustive, 0.85, 0.03);
  EXPECT_NEAR(safe_up_to("tint", stability::Evidence::searched), exhaustive, 0.02);
}

TEST(OwnModel, OperationsAreTheSameWheneverTheyAreCounted) {
  SKIP_WITHOUT_SHADERS;
  const auto m = compose(file() + ":brdf", 3);
  std::size_t first = 0, second = 0;
  std::thread([&] {  // where nothing has run yet
    first = operations_of(m).total();
    second = operations_of(m).total();
  })
      .join();
  EXPECT_EQ(first, second);
  // What channels share is counted once, as ours is.
  const std::size_t one = operations_of(compose(file() + ":brdf", 1)).total();
  EXPECT_LT(first, 2 * one);
}

TEST(OwnModel, AWholeModelIsNoDistribution) {
  SKIP_WITHOUT_SHADERS;
  EXPECT_HAS(refusal([] { bind_model(file() + ":D_GGX", {}); }, Exit::usage),
             "smith_ggx.correlated");
  EXPECT_HAS(
      refusal([] { bind_model(file() + ":brdf/smith_ggx.correlated/schlick", {}); }, Exit::usage),
      "one number");
}

/// A program that runs for days, as one in Python may, sees any number of functions.
TEST(OwnModel, AnyNumberOfFunctionsMayBeNamedOneAfterAnother) {
  SKIP_WITHOUT_SHADERS;
  const Folder folder;
  std::string text = "// kd 0 1 0.5\n";
  for (std::size_t k = 0; k < 4 * most_foreign_terms; ++k)
    text += fmt::format(
        "float f{0}(float NoL, float NoV, float kd) {{ return kd * {0}.0 + 0.0 * NoL * NoV; }}\n",
        k);
  const auto path = folder.write("many.glsl", text);
  const auto value_of = [](const BoundModel& m) { return evaluate(m, drawn(1))[0][0]; };
  const std::vector<std::string> half{"kd=0.5"};
  const auto bound = [&](std::size_t k) {
    return bind_model(fmt::format("{}:f{}{{includes=nothing}}", path, k), parse_settings(half), 1);
  };
  const auto held = bound(1);
  std::vector<double> values;
  for (std::size_t k = 2; k < most_foreign_terms + 20; ++k) values.push_back(value_of(bound(k)));
  for (std::size_t k = 0; k < values.size(); ++k)
    EXPECT_EQ(values[k], 0.5 * static_cast<double>(k + 2))
        << "another function stands in its place";
  EXPECT_EQ(value_of(held), 0.5) << "a model keeps its functions";
  EXPECT_EQ(value_of(bound(2)), 1) << "it is read again";
  // Those that are held at one time have an end.
  std::vector<BoundModel> all;
  EXPECT_HAS(refusal(
                 [&] {
                   for (std::size_t k = 200; k < 200 + most_foreign_terms; ++k)
                     all.push_back(bound(k));
                 },
                 Exit::usage),
             "functions of files are in use at once");
  EXPECT_EQ(value_of(all.back()), 0.5 * static_cast<double>(200 + all.size() - 1));
}

}  // namespace
}  // namespace gonio
