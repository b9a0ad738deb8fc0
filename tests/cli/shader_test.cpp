#include "cli/program.h"
#include "integrate/light/split_sum_table.h"

namespace gonio::test {
namespace {

constexpr const char* paint_shader =
    "shader lambert.coupled+ggx/smith_ggx.correlated/schlick --without-evidence";

TEST(ShaderCommand, PrintsTheSourceOrWritesIt) {
  const Folder f;
  const auto printed = gonio(f, std::string(paint_shader) + " --language glsl");
  ASSERT_EQ(printed.code, 0) << printed.err;
  EXPECT_NE(printed.out.find("vec3 brdf_of_cosines(vec3 kd, float alpha, vec3 f0, float NoL"),
            std::string::npos)
      << printed.out;
  EXPECT_NE(printed.out.find("vec3 brdf(vec3 kd, float alpha, vec3 f0, vec3 n, vec3 l, vec3 v)"),
            std::string::npos);
  const auto written = gonio(f, std::string(paint_shader) + " --language glsl -o a.glsl");
  ASSERT_EQ(written.code, 0) << written.err;
  EXPECT_EQ(read_bytes(f / "a.glsl"), printed.out);
}

TEST(ShaderCommand, TellsWhatIsKnownOfTheError) {
  const Folder f;
  const auto o = gonio(f, "shader ndf.ggx --language glsl --json");
  ASSERT_EQ(o.code, 0) << o.err;
  const auto j = o.json();
  ASSERT_EQ(j["remarks"].size(), 1U);
  const std::string remark = j["remarks"][0];
  EXPECT_NE(remark.find("finite (proved)"), std::string::npos) << remark;
  EXPECT_NE(remark.find("on any GPU"), std::string::npos) << remark;
  EXPECT_EQ(j["of_directions"], nullptr);
  EXPECT_EQ(j["angles"].size(), 2U);
}

TEST(ShaderCommand, TellsOfAProductThatOverflowsThoughItsTermsDoNot) {
  const Folder f;
  const auto o = gonio(f,
                       "shader ggx/smith_ggx.separable/schlick --language glsl --precision half "
                       "--set alpha=0.05 f0=0.9 --json");
  ASSERT_EQ(o.code, 0) << o.err;
  const std::string whole = o.json()["remarks"].back();
  EXPECT_TRUE(whole.starts_with("The whole, ")) << whole;
  EXPECT_NE(whole.find("0 where it should not be"), std::string::npos) << whole;
}

TEST(ShaderCommand, WritesAMapsOutputsAsAStructure) {
  const Folder f;
  const auto o = gonio(f, "shader aniso.disney --language glsl --name widths --json");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(o.json()["results"], (nlohmann::json{"alpha_x", "alpha_y"}));
  EXPECT_NE(o.json()["source"].get<std::string>().find("WidthsValues widths(float roughness"),
            std::string::npos)
      << o.json()["source"];
  const auto slope = gonio(f, "shader f0.from_ior --language glsl --derivatives n1 --json").json();
  EXPECT_EQ(slope["results"], (nlohmann::json{"f0", "by_n1"}));
}

TEST(ShaderCommand, WritesADerivativeOnce) {
  const Folder f;
  const auto o = gonio(f,
                       "shader ndf.ggx --language glsl --derivatives alpha,alpha --json "
                       "--without-evidence");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(o.json()["results"].size(), 2U);
  EXPECT_NE(o.json()["source"].get<std::string>().find("derivatives is unknown"),
            std::string::npos);
}

TEST(ShaderCommand, FoldsAFitsParametersInButForThoseNamed) {
  const Folder f;
  ASSERT_EQ(gonio(f,
                  "synth ggx/smith_ggx.correlated/schlick --set alpha=0.3 f0=0.9,0.6,0.4 "
                  "--layout in_plane -o t.csv")
                .code,
            0);
  ASSERT_EQ(gonio(f, "fit t.csv --model ggx/smith_ggx.correlated/schlick -o fit.json").code, 0);
  const auto o =
      gonio(f, "shader fit.json --language wgsl --inputs alpha --without-evidence --json");
  ASSERT_EQ(o.code, 0) << o.err;
  ASSERT_EQ(o.json()["parameters"].size(), 1U);
  EXPECT_EQ(o.json()["parameters"][0]["name"], "alpha");
  EXPECT_NEAR(o.json()["constants"]["f0"][0], 0.9, 1e-6);
}

TEST(ShaderCommand, WritesTheTableThatACompensationReads) {
  const Folder f;
  const auto o = gonio(f,
                       "shader ggx/smith_ggx.correlated/schlick --language glsl --compensation "
                       "turquin --table e.exr --without-evidence -o metal.glsl");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_NE(read_bytes(f / "metal.glsl").find("float E_view"), std::string::npos);
  EXPECT_NE(read_bytes(f / "metal.glsl").find("gonio split_sum"), std::string::npos);
  EXPECT_EQ(read_split_sum_table(f / "e.exr").width, 64U);
  expect_one_line_each(
      f, 2,
      {{"shader gtr/smith_gtr.correlated/schlick --language glsl --compensation turquin --table "
        "e.exr --without-evidence",
        "--table"},
       {"shader ggx/smith_ggx.correlated/schlick --language glsl --table t.exr",
        "--compensation"}});
}

TEST(ShaderCommand, WritesWhatAPlanShips) {
  const Folder f;
  const auto material = [](const std::string& compensation, const std::string& coat) {
    auto effects = nlohmann::json::array();
    for (const auto& [effect, form] : {std::pair<std::string, std::string>{"fresnel", "schlick"},
                                       {"compensation", compensation},
                                       {"masking", "correlated"},
                                       {"anisotropy", "off"},
                                       {"coat", coat},
                                       {"tail", "ggx"},
                                       {"diffuse", "none"},
                                       {"coupling", "off"},
                                       {"spectrum", "rgb"},
                                       {"environment", "split_sum"},
                                       {"precision", "float"}})
      effects.push_back({{"effect", effect},
                         {"keep", false},
                         {"form", form},
                         {"why", "measured"},
                         {"error_if_dropped", 0},
                         {"ns_saved", 0},
                         {"ops_saved", 0}});
    return nlohmann::json{{"effects", effects},
                          {"spec", "ggx/smith_ggx.correlated/schlick"},
                          {"parameters", {{"alpha", {0.2}}, {"f0", {1.0, 0.7, 0.4}}}},
                          {"speedup", 1},
                          {"holds", true},
                          {"error_quantile", 0},
                          {"samples", 4096}};
  };
  f.write("plan.json", nlohmann::json{{"schema", "gonio.plan/2"},
                                      {"holds", true},
                                      {"scene_sha256", std::string(64, '0')},
                                      {"materials",
                                       {{"gold", material("turquin", "off")},
                                        {"plain", material("none", "off")},
                                        {"coated", material("none", "on")},
                                        {"newer", material("walk", "off")}}}}
                           .dump());
  const auto of = [&](const std::string& name) {
    return gonio(f,
                 "shader plan.json --language glsl --json --without-evidence --material " + name);
  };
  const auto gold = of("gold");
  ASSERT_EQ(gold.code, 0) << gold.err;
  ASSERT_EQ(gold.json()["parameters"].size(), 1U);
  EXPECT_EQ(gold.json()["parameters"][0]["name"], "E_view");
  EXPECT_EQ(of("plain").json()["parameters"].size(), 0U);
  EXPECT_LT(of("plain").json()["operations"]["mul"], gold.json()["operations"]["mul"]);
  const std::string call = "shader plan.json --language glsl --without-evidence --material ";
  expect_one_line_each(f, 2, {{call + "gould", "gold"}, {call + "coated", "coat"}});
  expect_one_line_each(f, 3, {{call + "newer", "walk"}});
}

TEST(ShaderCommand, RefusesWhatItCannotWriteInOneLine) {
  const Folder f;
  expect_one_line_each(
      f, 2,
      {{"shader lambert --language hlsl", "hlsl"},
       {"shader lambart --language glsl", "lambart"},
       {"shader scattering.walk --language glsl", "--compensation"},
       {"shader model.split_sum --language glsl", "gonio split_sum"},
       {"shader lambert --language glsl --name 1st", "--name"},
       {"shader lambert --language glsl --name gl__x", "--name"},
       {"shader lambert --language glsl --name main", "--name"},
       {"shader lambert --language wgsl --name fn", "--name"},
       {"shader lambert --language glsl --name a_", "--name"},
       {"shader lambert --language wgsl --name self", "--name"},
       {"shader lambert --language glsl --name smoothstep", "--name"},
       {"shader f0.from_ior --language wgsl --set n1=1.5", "--set"},
       {"shader aniso.disney --language wgsl --derivatives roughness", "2 outputs"},
       {"shader lambert --language glsl -o a.glsl --table ./a.glsl", "two outputs"},
       {"shader lambert --language glsl --albedo fit", "--albedo"},
       {"shader lambert --language glsl --material gold", "--material"},
       {"shader lambert --language glsl --set kd=0.5 --derivatives kd", "--inputs kd"},
       {"shader ndf.ggx --language glsl --set alpha=0.1", "--set"},
       {"shader lambert --language glsl --derivatives alpha", "alpha"},
       {"shader masking.smith_gtr.correlated --language glsl --precision half", "half"}});
  expect_one_line_each(f, 3, {{"shader none.json --language glsl", "none.json"}});
}

}  // namespace
}  // namespace gonio::test
