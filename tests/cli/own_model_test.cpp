// A person's shader in every command that takes a model: validate, plan, render, fit_map, export,
// shader.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/sha256.h"
#include "cli/program.h"
#include "foreign/compile.h"
#include "image/exr.h"

namespace gonio::test {
namespace {

using nlohmann::json;

#define SKIP_WITHOUT_SHADERS \
  if (!foreign::can_compile()) GTEST_SKIP() << "this build reads no shaders"

/// A whole model as its own reference, a distribution, and a model with a sine, which no other shader is written of.
constexpr const char* own =
    "#version 450\n// alpha 0.001 1 0.3\n// f0 0 1 0.04\n// kd 0 1 0.5\n"
    "const float PI = 3.14159265358979323846;\n"
    "float D_GGX(float NoH, float alpha) {\n  float a2 = alpha * alpha;\n"
    "  float d = NoH * NoH * (a2 - 1.0) + 1.0;\n  return a2 / (PI * d * d);\n}\n"
    "vec3 brdf(vec3 l, vec3 v, vec3 n, float alpha, vec3 f0, vec3 kd) {\n"
    "  float NoL = dot(n, l), NoV = dot(n, v);\n"
    "  if (NoL <= 0.0 || NoV <= 0.0) return vec3(0.0);\n  vec3 h = normalize(l + v);\n"
    "  float NoH = clamp(dot(n, h), 0.0, 1.0), VoH = clamp(dot(v, h), 0.0, 1.0);\n"
    "  float a2 = alpha * alpha;\n"
    "  float V = 0.5 / (NoV * sqrt(NoL * NoL * (1.0 - a2) + a2) + NoL * sqrt(NoV * NoV * (1.0 - "
    "a2) + a2));\n"
    "  return kd / PI + D_GGX(NoH, alpha) * V * (f0 + (1.0 - f0) * pow(1.0 - VoH, 5.0));\n}\n"
    "float wavy(float NoL, float NoV, float kd) { return kd * (1.0 + 0.1 * sin(NoL) * sin(NoV)); "
    "}\n";

/// The file in a folder of its own, beside a scene or a choice.
void write_own(const Folder& f) {
  std::filesystem::create_directories(f / "assets/mats");
  f.write("assets/mats/mine.glsl", own);
}
std::string own_hash() {
  return sha256(own);
}
/// A document's only shader, by its name there.
void expect_shader(const json& document, const std::string& file) {
  ASSERT_TRUE(document.contains("shaders")) << document.dump().substr(0, 300);
  ASSERT_EQ(document["shaders"].size(), 1U);
  EXPECT_EQ(document["shaders"][0]["file"], file);
  EXPECT_EQ(document["shaders"][0]["sha256"], own_hash());
}

json choice(const std::string& model) {
  return {
      {"schema", "gonio.choice/1"},
      {"model", model},
      {"reference", "lambert+ggx/smith_ggx.correlated/schlick"},
      {"domain", {{"roughness", {0.4, 1}}, {"f0", 0.04}}},
      {"parameters", {{"kd", 0.4}}},
      {"budgets",
       {{"albedo_error", 1e-4}, {"energy_gain", 0.001}, {"reciprocity", 1e-6}, {"nonfinite", 0}}}};
}

TEST(OwnModelCommands, ValidateFindsItBesideTheChoice) {
  SKIP_WITHOUT_SHADERS;
  const Folder f;
  write_own(f);
  f.write("assets/choice.json", choice("mats/mine.glsl:brdf").dump());
  const auto o = gonio(f, "validate assets/choice.json --json");
  EXPECT_EQ(o.code, 0) << o.out << o.err;
  expect_shader(o.json(), "assets/mats/mine.glsl");
  // With the diffuse term twice as bright the albedo is off.
  std::string bright = own;
  bright.replace(bright.find("return kd / PI"), 14, "return kd / 1.5");
  f.write("assets/mats/mine.glsl", bright);
  const auto slip = gonio(f, "validate assets/choice.json --json");
  EXPECT_EQ(slip.code, 1);
  EXPECT_EQ(slip.json()["budgets"][0]["budget"], "albedo_error");
  EXPECT_EQ(slip.json()["budgets"][0]["holds"], false);
}

TEST(OwnModelCommands, ValidateTakesATermAndRefusesWhatLiesOutside) {
  SKIP_WITHOUT_SHADERS;
  const Folder f;
  write_own(f);
  auto c = choice("mats/mine.glsl:D_GGX/smith_ggx.correlated/schlick");
  c["reference"] = "ggx/smith_ggx.correlated/schlick";
  c.erase("parameters");
  f.write("assets/choice.json", c.dump());
  EXPECT_EQ(gonio(f, "validate assets/choice.json").code, 0);
  f.write("assets/mats/choice.json", choice("../mine.glsl:brdf").dump());
  f.write("assets/mine.glsl", own);
  expect_one_line(gonio(f, "validate assets/mats/choice.json"), 3, "below the document's folder");
  f.write("assets/none.json", choice("no.glsl").dump());
  expect_one_line(gonio(f, "validate assets/none.json"), 3, "no.glsl");
}

TEST(OwnModelCommands, ADocumentWhoseShaderIsNotBesideItSaysSo) {
  SKIP_WITHOUT_SHADERS;
  const Folder f;
  write_own(f);
  std::filesystem::create_directories(f / "fits");
  f.write("mine.glsl", own);
  ASSERT_EQ(gonio(f, "synth mine.glsl:brdf --set alpha=0.3 --layout random -o t.csv").code, 0);
  ASSERT_EQ(gonio(f, "fit t.csv --model mine.glsl:brdf -o fits/fit.json").code, 0);
  const auto all_say = [&](const std::string& words) {
    for (const std::string command :
         {"shader fits/fit.json --language glsl", "export fits/fit.json --to gltf -o x.gltf",
          "compare t.csv fits/fit.json", "explore fits/fit.json -o x.html"})
      expect_one_line(gonio(f, command), 3, words);
  };
  all_say("a shader beside the document, or --follow-paths");
  EXPECT_EQ(gonio(f, "compare t.csv fits/fit.json --follow-paths").code, 0);
  std::filesystem::rename(f / "mine.glsl", f / "other.glsl");
  all_say("found mine.glsl, which is not beside it, expected a copy of that shader there");
  std::filesystem::rename(f / "other.glsl", f / "fits/mine.glsl");
  EXPECT_EQ(gonio(f, "compare t.csv fits/fit.json").code, 0);
}

TEST(OwnModelCommands, ValidateTakesItsNamesWhateverTheirCase) {
  SKIP_WITHOUT_SHADERS;
  const Folder f;
  std::string text = own;
  for (const auto& [from, to] : {std::pair{"f0", "F0"}, {"alpha", "Alpha"}})
    for (auto at = text.find(from); at != text.npos; at = text.find(from, at + 1))
      text.replace(at, std::string_view(from).size(), to);
  f.write("named.glsl", text);
  f.write("choice.json", choice("named.glsl:brdf").dump());
  const auto o = gonio(f, "validate choice.json");
  EXPECT_EQ(o.code, 0) << o.out << o.err;
}

TEST(OwnModelCommands, AGuessThatChangesValuesIsSaidByEveryCommand) {
  SKIP_WITHOUT_SHADERS;
  const Folder f;
  f.write(
      "guess.glsl",
      "// kd 0 1 0.5\nfloat lit(vec3 N, vec3 L, vec3 V, float kd) { return kd * dot(N, L); }\n");
  const std::string says = "guess.glsl: guessed to include the cosine NoL and π";
  for (const std::string words :
       {"albedo guess.glsl --mu 0.5", "synth guess.glsl --set kd=0.5 --layout random -o t.csv",
        "fit t.csv --model guess.glsl"})
    EXPECT_NE(gonio(f, words).err.find(says), std::string::npos) << words;
  EXPECT_EQ(gonio(f, "albedo guess.glsl --includes cosine,pi --mu 0.5").err, "");
  EXPECT_EQ(gonio(f, "stability guess.glsl --domain nol=0.1,1 nov=0.1,1").err, "")
      << "nothing is taken out of its text";
  const auto audit = gonio(f, "audit guess.glsl");
  EXPECT_EQ(audit.err, "") << "its own lines say it";
  EXPECT_NE(audit.out.find("cosine,pi (guessed"), std::string::npos) << audit.out;
}

TEST(OwnModelCommands, APlanWritesMaterialxOfAFunctionOfAFile) {
  SKIP_WITHOUT_SHADERS;
  const Folder f;
  f.write("own.glsl",
          "// alpha 0.05 1 0.3\n// kd 0 1 0.3\n"
          "float brdf(vec3 N, vec3 L, vec3 V, float alpha, float kd) {\n"
          "  float NoH = dot(N, normalize(L + V)), a2 = alpha * alpha, d = NoH * NoH * (a2 - 1.0) "
          "+ 1.0;\n"
          "  return kd / 3.14159265 + 0.01 * a2 / (3.14159265 * d * d);\n}\n");
  f.write("scene.json",
          R"({"schema": "gonio.scene/1", "materials": {"m": {"model": "own.glsl:brdf"}},
    "objects": [{"shape": "sphere", "material": "m"}],
    "lights": [{"type": "directional", "direction": [0.5, 0.6, 0.62], "irradiance": [2, 2, 2]}],
    "view": {"position": [0, 0, 10], "target": [0, 0, 0], "fov_deg": 20},
    "tolerance": {"metric": "delta_e_2000", "quantile": 0.99, "limit": 1, "max": 4}})");
  const auto o = gonio(f, "plan scene.json --write mtlx -o plan.json");
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_NE(read_bytes(f / "plan.mtlx").find("highlight_all"), std::string::npos);
}

TEST(OwnModelCommands, AnAuditThatReadNoFunctionEndsAsBadInput) {
  SKIP_WITHOUT_SHADERS;
  const Folder f;
  const std::string endless =
      "float g(float NoL) {\n  float x = NoL;\n  while (x < 2.0) x *= 1.1;\n  return x;\n}\n";
  f.write("endless.glsl", endless);
  const auto o = gonio(f, "audit endless.glsl");
  EXPECT_EQ(o.code, 3);
  EXPECT_NE(o.err.find("line 3"), std::string::npos) << o.err;
  EXPECT_EQ(o.out, "");
  f.write("one.glsl", endless + "float D(float NoH) { return NoH; }\n");
  EXPECT_EQ(gonio(f, "audit one.glsl").code, 0);
}

TEST(OwnModelCommands, ListsLongFunctionsUpToALimitOfAllAndTheOthersByName) {
  SKIP_WITHOUT_SHADERS;
  const Folder f;
  std::string text =
      "// a 0 1 0.3\nfloat g(float x, float a) { float s = a; for (int j = 0; j < 90; ++j) s += x "
      "* "
      "s; return s; }\n";
  for (int k = 0; k < 60; ++k)
    text += "float f" + std::to_string(k) +
            "(float NoH, float a) { float s = a; for (int i = 0; i < 400; ++i) s += g(NoH * "
            "float(i), a); return s; }\n";
  f.write("many.glsl", text);
  const auto all = gonio(f, "models many.glsl --json").json()["functions"];
  ASSERT_EQ(all.size(), 61U);
  EXPECT_FALSE(all[1].contains("refused")) << all[1];
  EXPECT_NE(all[60]["refused"].get<std::string>().find("8000000 steps"), std::string::npos);
  EXPECT_EQ(gonio(f, "models many.glsl:f59").code, 0);
}

json scene() {
  return json::parse(R"({
    "schema": "gonio.scene/1",
    "materials": {"mine": {"model": "mats/mine.glsl:brdf",
                           "parameters": {"kd": [0.5, 0.03, 0.02], "alpha": 0.3}},
                  "lobe": {"model": "mats/mine.glsl:D_GGX/smith_ggx.correlated/schlick",
                           "parameters": {"alpha": 0.3, "f0": 0.5}}},
    "objects": [{"shape": "sphere", "material": "mine", "center": [-1.1, 0, 0]},
                {"shape": "sphere", "material": "lobe", "center": [1.1, 0, 0]}],
    "lights": [{"type": "directional", "direction": [0.5, 0.6, 0.62], "irradiance": [1.9, 1.9, 1.9]}],
    "view": {"position": [0, 0, 10], "target": [0, 0, 0], "fov_deg": 28},
    "tolerance": {"metric": "delta_e_2000", "limit": 1, "max": 4}
  })");
}

TEST(OwnModelCommands, PlansOfAScenePrintTheFileAsTheSceneNamesIt) {
  SKIP_WITHOUT_SHADERS;
  const Folder f;
  write_own(f);
  f.write("assets/scene.json", scene().dump());
  const auto o =
      gonio(f, "plan assets/scene.json --samples 512 -o assets/plan.json --cost operations");
  ASSERT_EQ(o.code, 0) << o.out << o.err;
  const auto plan = json::parse(read_bytes(f / "assets/plan.json"));
  EXPECT_EQ(plan["materials"]["mine"]["spec"], "mats/mine.glsl:brdf");
  EXPECT_EQ(plan["materials"]["lobe"]["spec"], "mats/mine.glsl:D_GGX/smith_ggx.correlated/schlick");
  expect_shader(plan, "mats/mine.glsl");
  EXPECT_EQ(gonio(f, "verify assets/scene.json assets/plan.json --samples 512").code, 0);
  const auto shader =
      gonio(f, "shader assets/plan.json --material mine --language wgsl --without-evidence");
  EXPECT_EQ(shader.code, 0) << shader.err;
  f.write("assets/mats/mine.glsl", std::string(own) + "// changed\n");
  expect_one_line(gonio(f, "verify assets/scene.json assets/plan.json"), 3, "scene_sha256");
}

TEST(OwnModelCommands, RendersWhatOursRenders) {
  SKIP_WITHOUT_SHADERS;
  const Folder f;
  write_own(f);
  auto s = scene();
  f.write("assets/scene.json", s.dump());
  s["materials"]["mine"]["model"] = "lambert+ggx/smith_ggx.correlated/schlick";
  s["materials"]["mine"]["parameters"]["f0"] = 0.04;
  f.write("ours.json", s.dump());
  // Ours has the light between facets and exact Fresnel, the file what it says: within some
  // percent.
  const auto mean = [&](const std::string& which) {
    const auto o =
        gonio(f, "render " + which + " -o x.exr --width 24 --height 12 --samples 4 --json");
    EXPECT_EQ(o.code, 0) << o.err;
    return o.json()["mean_radiance"][0].get<double>();
  };
  f.write("ours.json", [&] {
    s["materials"].erase("lobe");
    s["objects"].erase(1);
    return s.dump();
  }());
  s["materials"]["mine"] = scene()["materials"]["mine"];
  f.write("assets/one.json", s.dump());
  const double ours = mean("ours.json"), mine = mean("assets/one.json");
  EXPECT_NEAR(mine / ours, 1, 0.05);
  EXPECT_NE(mine, ours);
  EXPECT_GT(mean("assets/scene.json"), 0);
}

TEST(OwnModelCommands, AMapIsFittedByIt) {
  SKIP_WITHOUT_SHADERS;
  const Folder f;
  write_own(f);
  ASSERT_EQ(
      gonio(f,
            "synth lambert+ggx/smith_ggx.correlated/schlick --set alpha=0.3 f0=0.05 kd=0.3,0.2,0.1 "
            "--layout map --size 8,6 --images 16 -o s")
          .code,
      0);
  for (const std::string model :
       {"assets/mats/mine.glsl:brdf",
        "'lambert+assets/mats/mine.glsl:D_GGX/smith_ggx.correlated/schlick'"}) {
    const auto o =
        gonio(f, "fit_map s/stack.json --model " + model + " --fix f0=0.05 -o maps.exr --json");
    ASSERT_EQ(o.code, 0) << o.err;
    const auto d = o.json();
    EXPECT_EQ(d["texels"]["converged"], 48);
    const auto mean = [&](const std::string& name) {
      for (const auto& p : d["parameters"])
        if (p["name"] == name) return p["mean"].get<double>();
      return std::nan("");
    };
    EXPECT_NEAR(mean("alpha"), 0.3, 2e-3) << d["parameters"].dump();
    EXPECT_NEAR(mean("kd.B"), 0.1, 1e-3);
    expect_shader(d, "assets/mats/mine.glsl");
    std::filesystem::remove(f / "maps.exr");
  }
  expect_one_line(
      gonio(f, "fit_map s/stack.json --model assets/mats/mine.glsl:brdf --refine-normals -o m.exr"),
      2, "normals are refined of the catalogue's terms");
}

TEST(OwnModelCommands, AMapOfAnotherTextIsMadeAnew) {
  SKIP_WITHOUT_SHADERS;
  const Folder f;
  write_own(f);
  ASSERT_EQ(
      gonio(f, std::string("synth ") + paint + " --layout map --size 8,6 --images 12 -o s").code,
      0);
  const std::string call =
      "fit_map s/stack.json --model assets/mats/mine.glsl:brdf --fix f0=0.05 --tile-size 8 --tile "
      "0,0 -o tiles";
  ASSERT_EQ(gonio(f, call).code, 0);
  f.write("assets/mats/mine.glsl", std::string(own) + "// changed\n");
  expect_one_line(gonio(f, call), 3, "gonio:shaders");
}

TEST(OwnModelCommands, AKeptFitOfAnotherTextIsFittedAnew) {
  SKIP_WITHOUT_SHADERS;
  const Folder f;
  write_own(f);
  ASSERT_EQ(
      gonio(f, std::string("synth ") + paint + " --layout random --samples 300 -o a.csv").code, 0);
  ASSERT_EQ(
      gonio(f, std::string("synth ") + paint + " --layout random --samples 300 --seed 2 -o b.csv")
          .code,
      0);
  const std::string call = "fit a.csv b.csv --model assets/mats/mine.glsl:brdf -o out/";
  ASSERT_EQ(gonio(f, call).code, 0);
  const auto before = read_bytes(f / "out/a.json");
  expect_shader(json::parse(before), "assets/mats/mine.glsl");
  ASSERT_EQ(gonio(f, call).code, 0);
  EXPECT_EQ(read_bytes(f / "out/a.json"), before);
  f.write("assets/mats/mine.glsl", std::string(own) + "// changed\n");
  ASSERT_EQ(gonio(f, call).code, 0);
  EXPECT_NE(read_bytes(f / "out/a.json"), before);
}

TEST(OwnModelCommands, AFitOfItIsExportedRefitted) {
  SKIP_WITHOUT_SHADERS;
  const Folder f;
  write_own(f);
  ASSERT_EQ(gonio(f,
                  "synth assets/mats/mine.glsl:brdf --set alpha=0.2 f0=0.05 kd=0.3,0.2,0.1 "
                  "--layout hemisphere -o t.csv")
                .code,
            0);
  ASSERT_EQ(gonio(f, "fit t.csv --model assets/mats/mine.glsl:brdf -o fit.json").code, 0);
  for (const std::string target : {"gltf -o m.gltf", "open_pbr -o m.mtlx"}) {
    const auto o = gonio(f, "export fit.json --to " + target + " --json");
    EXPECT_LE(o.code, 1) << o.err;
    EXPECT_EQ(o.json()["refitted"], true);
    EXPECT_LT(o.json()["written"]["rms"].get<double>(), 0.2) << o.out;
    expect_shader(o.json(), "assets/mats/mine.glsl");
  }
}

TEST(OwnModelCommands, ShaderIsTheSameTextWithWhatIsKnownOfIt) {
  SKIP_WITHOUT_SHADERS;
  const Folder f;
  write_own(f);
  const auto o = gonio(f, "shader assets/mats/mine.glsl:D_GGX --language glsl --precision half");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_TRUE(o.out.starts_with("#version 450\n// assets/mats/mine.glsl:D_GGX, as its file has it"))
      << o.out;
  EXPECT_NE(o.out.find("not finite at"), o.out.npos) << o.out;
  EXPECT_NE(o.out.find(std::string(own).substr(std::string(own).find("// alpha"))), o.out.npos);
  // Read back it is the same.
  f.write("again.glsl", o.out);
  const auto beside = gonio(f, "compare again.glsl:D_GGX assets/mats/mine.glsl:D_GGX --json");
  EXPECT_EQ(beside.json()["largest"], 0);
}

TEST(OwnModelCommands, ShaderInAnotherLanguageAndWithParametersFoldedInReadsBack) {
  SKIP_WITHOUT_SHADERS;
  const Folder f;
  write_own(f);
  const auto o = gonio(f,
                       "shader assets/mats/mine.glsl:brdf --set alpha=0.25 --language glsl "
                       "--without-evidence --name mine -o made.glsl");
  ASSERT_EQ(o.code, 0) << o.err;
  f.write("at.csv", "theta_i,phi_i,theta_o,phi_o\n30,0,50,100\n");
  const std::string at = " --set f0=0.04 kd=0.2 --directions at.csv --json";
  const auto value = [&](const std::string& model) {
    const auto v = gonio(f, "eval " + model + at);
    EXPECT_EQ(v.code, 0) << v.err;
    return v.json()["rows"][0]["f"][0].get<double>();
  };
  EXPECT_NEAR(
      value("'made.glsl:mine{f0=0,1;kd=0,1}'") / value("assets/mats/mine.glsl:brdf{alpha=0.25}"), 1,
      1e-6);
  EXPECT_EQ(gonio(f,
                  "shader assets/mats/mine.glsl:brdf --language wgsl --derivatives alpha "
                  "--without-evidence")
                .code,
            0);
  expect_one_line(gonio(f, "shader assets/mats/mine.glsl:wavy --language wgsl --without-evidence"),
                  2, "sin: gonio shader writes");
  EXPECT_EQ(gonio(f, "shader assets/mats/mine.glsl:wavy --language glsl --without-evidence").code,
            0);
}

TEST(OwnModelCommands, ARelativeErrorIsProvedOrSaidWhyNot) {
  SKIP_WITHOUT_SHADERS;
  const Folder f;
  f.write("f.glsl",
          "float F_Schlick(float VoH, float f0) {\n  float x = 1.0 - VoH, y = x * x;\n  return f0 "
          "+ (1.0 - f0) * (y * y * x);\n}\n"
          "float F_gauss(float VoH, float f0) { return f0 + (1.0 - f0) * exp2((-5.55473 * VoH - "
          "6.98316) * VoH); }\n");
  const std::string domain =
      " --number float --domain voh=0,1 f0=0.02,1 --require relative=1e-6 --json";
  const auto proved = gonio(f, "stability f.glsl:F_Schlick" + domain);
  EXPECT_EQ(proved.code, 0) << proved.out << proved.err;
  EXPECT_EQ(proved.json()["evidence"], "proved") << proved.out;
  EXPECT_LT(proved.json()["proved_rel"].get<double>(), 1e-6);
  EXPECT_EQ(proved.json()["shaders"].size(), 1U);
  const auto open = gonio(f, "stability f.glsl:F_gauss" + domain);
  EXPECT_EQ(open.code, 1);
  EXPECT_EQ(open.json()["unproved_because"], "exp2, which Gappa does not know");
}

TEST(OwnModelCommands, AFitOfThirteenParametersSaysWhichTheTableDoesNotTell) {
  SKIP_WITHOUT_SHADERS;
  const Folder f;
  f.write(
      "many.brdf",
      "analytic\n::begin parameters\ncolor baseColor .82 .67 .16\nfloat metallic 0 1 .3\nfloat "
      "subsurface 0 1 .2\n"
      "float specular 0 1 .5\nfloat roughness 0.05 1 .4\nfloat specularTint 0 1 .1\nfloat twin 0 1 "
      ".5\nfloat sheen 0 1 .3\n"
      "float sheenTint 0 1 .5\nfloat clearcoat 0 1 .6\nfloat clearcoatGloss 0.1 1 .7\nfloat idle 0 "
      "1 .5\nfloat scale 0.5 2 1\n"
      "::end parameters\n::begin shader\nconst float PI = 3.14159265358979323846;\n"
      "float g1(float c, float a) { float a2 = a * a; return 1.0 / (c + sqrt(a2 + c * c - a2 * c * "
      "c)); }\n"
      "vec3 BRDF(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y) {\n"
      "  float NoL = dot(N, L), NoV = dot(N, V);\n  if (NoL < 0.0 || NoV < 0.0) return vec3(0.0);\n"
      "  vec3 H = normalize(L + V);\n  float NoH = dot(N, H), LoH = dot(L, H);\n"
      "  float lum = 0.3 * baseColor.x + 0.6 * baseColor.y + 0.1 * baseColor.z;\n  vec3 tint = "
      "baseColor / lum;\n"
      "  vec3 spec0 = mix(specular * 0.08 * mix(vec3(1.0), tint, specularTint), baseColor, "
      "metallic);\n"
      "  float fl = pow(1.0 - NoL, 5.0), fv = pow(1.0 - NoV, 5.0), fh = pow(1.0 - LoH, 5.0);\n"
      "  float fd90 = 0.5 + 2.0 * LoH * LoH * roughness;\n  float fd = mix(1.0, fd90, fl) * "
      "mix(1.0, fd90, fv);\n"
      "  float ss90 = LoH * LoH * roughness;\n  float fss = mix(1.0, ss90, fl) * mix(1.0, ss90, "
      "fv);\n"
      "  float ss = 1.25 * (fss * (1.0 / (NoL + NoV) - 0.5) + 0.5);\n  float a = roughness * "
      "roughness, a2 = a * a;\n"
      "  float t = 1.0 + (a2 - 1.0) * NoH * NoH;\n  float ds = a2 / (PI * t * t);\n"
      "  vec3 fs = mix(spec0, vec3(1.0), fh);\n  float gs = g1(NoL, a) * g1(NoV, a);\n"
      "  vec3 sheenColor = fh * sheen * mix(vec3(1.0), tint, sheenTint);\n"
      "  float c = mix(0.1, 0.001, clearcoatGloss), c2 = c * c;\n"
      "  float dr = (c2 - 1.0) / (PI * log(c2) * (1.0 + (c2 - 1.0) * NoH * NoH));\n"
      "  float fr = mix(0.04, 1.0, fh), gr = g1(NoL, 0.25) * g1(NoV, 0.25);\n"
      "  vec3 f = (1.0 / PI * mix(fd, ss, subsurface) * baseColor + sheenColor) * (1.0 - metallic) "
      "+ gs * fs * ds + 0.25 * clearcoat * gr * fr * dr;\n"
      "  return scale * (0.5 + twin) * f + 0.0 * idle;\n}\n::end shader\n");
  ASSERT_EQ(gonio(f, "synth many.brdf --layout random --samples 4000 -o t.csv").code, 0);
  const auto o = gonio(f, "fit t.csv --model many.brdf --json");
  ASSERT_LE(o.code, 4) << o.err;
  const auto d = o.json();
  const auto status = [&](const char* name) {
    const auto& s = d["parameters"][name]["status"];
    return s.is_array() ? s[0].get<std::string>() : s.get<std::string>();
  };
  EXPECT_LT(d["residuals"]["log_rms"].get<double>(), 1e-3) << o.out.substr(0, 2000);
  EXPECT_EQ(status("scale"), "not_identifiable");  // only its product with (0.5 + twin) is known
  EXPECT_EQ(status("twin"), "not_identifiable");
  EXPECT_EQ(status("roughness"), "free");
  EXPECT_NEAR(d["parameters"]["roughness"]["value"].get<double>(), 0.4, 1e-3);
}

}  // namespace
}  // namespace gonio::test
