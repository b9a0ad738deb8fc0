// gonio export: what it writes, what it says of it, what it refuses.
#include <cmath>
#include <filesystem>
#include <tuple>

#include "base/base64.h"
#include "cli/outside.h"
#include "cli/program.h"
#include "image/display.h"
#include "image/exr.h"
#include "png_pixels.h"

#include <fmt/format.h>

namespace gonio::test {
namespace {

void make_fit(const Folder& f, const std::string& model, const std::string& set) {
  ASSERT_EQ(gonio(f, "synth " + model + " --set " + set + " --layout in_plane -o t.csv").code, 0);
  const auto o = gonio(f, "fit t.csv --model " + model + " -o fit.json");
  ASSERT_EQ(o.code, 0) << o.err;
}

TEST(ExportCommand, RenamesWhatIsTheTargetsOwnModelAndKeepsTheFit) {
  const Folder f;
  make_fit(f, "gltf", "base_color=0.6,0.3,0.1 metallic=0 roughness=0.5");
  const auto o = gonio(f, "export fit.json --to gltf -o m.gltf --json");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_LT(o.json()["written"]["largest"], 1e-6);
  EXPECT_FALSE(o.json()["refitted"]);
  const auto file = nlohmann::json::parse(read_bytes(f / "m.gltf"));
  const auto& m = file["materials"][0];
  EXPECT_NEAR(m["pbrMetallicRoughness"]["roughnessFactor"], 0.5, 1e-3) << "not alpha";
  EXPECT_NEAR(m["pbrMetallicRoughness"]["baseColorFactor"][0], 0.6, 1e-3);
  EXPECT_EQ(m["extras"]["gonio"], nlohmann::json::parse(read_bytes(f / "fit.json")));
}

TEST(ExportCommand, FitsAgainWhereNamesDoNotSuffice) {
  const Folder f;
  make_fit(f, "lambert+ggx/smith_ggx.correlated/schlick", "alpha=0.4 f0=0.12 kd=0.3,0.2,0.1");
  const auto o = gonio(f, "export fit.json --to gltf -o m.gltf --json");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_TRUE(o.json()["refitted"]);
  EXPECT_LT(o.json()["written"]["rms"], o.json()["renamed"]["rms"]);
}

TEST(ExportCommand, WritesAFileThatIsReadAsTheFit) {
  const Folder f;
  make_fit(f, "lambert+ggx/smith_ggx.correlated/schlick", "alpha=0.4 f0=0.12 kd=0.3,0.2,0.1");
  ASSERT_EQ(gonio(f, "export fit.json --to gltf -o m.gltf").code, 0);
  f.write("d.csv", "theta_i,phi_i,theta_o,phi_o\n30,0,35,170\n70,0,60,190\n");
  const auto fit = gonio(f, "eval fit.json --directions d.csv --json");
  const auto file = gonio(f, "eval m.gltf --directions d.csv --json");
  ASSERT_EQ(file.code, 0) << file.err;
  EXPECT_EQ(file.json()["rows"], fit.json()["rows"]);
}

TEST(ExportCommand, SaysTheFitsOwnMisfitFirst) {
  const Folder f;
  make_fit(f, "lambert+ggx/smith_ggx.correlated/schlick", "alpha=0.4 f0=0.12 kd=0.3,0.2,0.1");
  ASSERT_EQ(gonio(f, "fit t.csv --model lambert -o fit.json").code, 0);
  const double log_rms = nlohmann::json::parse(read_bytes(f / "fit.json"))["residuals"]["log_rms"];
  const auto o = gonio(f, "export fit.json --to gltf -o m.gltf --json");
  EXPECT_NEAR(o.json()["misfit"], std::exp(log_rms), 1e-12);
  const auto text = gonio(f, "export fit.json --to gltf -o m.gltf").out;
  EXPECT_LT(text.find("off its table"), text.find("renamed")) << text;
  const auto shader = gonio(f, "shader fit.json --language glsl").out;
  EXPECT_NE(shader.find("off its table by a factor of "), shader.npos) << shader;
}

TEST(ExportCommand, BringsASphereForViewers) {
  const Folder f;
  make_fit(f, "ggx/smith_ggx.correlated/schlick", "alpha=0.3 f0=0.95,0.64,0.54");
  ASSERT_EQ(gonio(f, "export fit.json --to gltf --preview -o m.gltf").code, 0);
  EXPECT_EQ(outside_faults(f, "m.gltf").value_or(""), "");
  const auto file = nlohmann::json::parse(read_bytes(f / "m.gltf"));
  EXPECT_EQ(file["scenes"][0]["nodes"][0], 0);
  const auto& primitive = file["meshes"][0]["primitives"][0];
  EXPECT_EQ(primitive["material"], 0);
  EXPECT_EQ(file["accessors"][2]["count"], 3 * 2 * 64 * (32 - 1))
      << "one triangle a place at the poles";
  f.write("scene.json", R"({"schema": "gonio.scene/1",
      "materials": {"m": {"gltf": "m.gltf", "material": "fit"}},
      "objects": [{"shape": "mesh", "gltf": "m.gltf", "node": "preview", "material": "m"}],
      "lights": [{"type": "directional", "direction": [0, 1, 1], "irradiance": [3, 3, 3]}],
      "view": {"position": [0, 0, 10], "target": [0, 0, 0], "fov_deg": 20}})");
  const auto seen = gonio(f, "render scene.json -o m.png --width 16 --height 16 --samples 1");
  EXPECT_EQ(seen.code, 0) << seen.err;
  expect_one_line(gonio(f, "export fit.json --to mitsuba --preview -o m.xml"), 2, "--preview");
}

TEST(ExportCommand, WritesWhatKhronosValidatorFindsNoFaultWith) {
  const Folder f;
  if (!gltf_messages(f, "none.gltf"))
    GTEST_SKIP() << "gltf-validator is not there: run ./check, which fetches it";
  make_fit(f, "ggx/smith_ggx.correlated/schlick", "alpha=0.3 f0=0.95,0.64,0.54");
  ASSERT_EQ(gonio(f, "export fit.json --to gltf -o m.gltf").code, 0);
  EXPECT_EQ(outside_faults(f, "m.gltf"), "");
  auto beyond = nlohmann::json::parse(read_bytes(f / "m.gltf"));
  beyond["materials"][0]["pbrMetallicRoughness"]["roughnessFactor"] = 1.5;
  f.write("beyond.gltf", beyond.dump());
  EXPECT_NE(outside_faults(f, "beyond.gltf")->find("VALUE_NOT_IN_RANGE"), std::string::npos);
}

TEST(ExportCommand, WritesAMapAsTexturesThatShowItsFits) {
  const Folder f;
  ASSERT_EQ(
      gonio(
          f,
          "synth lambert+ggx/smith_ggx.correlated/schlick --set alpha=0.25 f0=0.04 kd=0.5,0.2,0.1 "
          "--layout map --size 6,4 --images 24 -o s")
          .code,
      0);
  ASSERT_EQ(gonio(f, "fit_map s/stack.json -o maps.exr --refine-normals").code, 0);
  const auto o = gonio(f, "export maps.exr --to gltf -o m.gltf --json");
  ASSERT_EQ(o.code, 0) << o.err;
  const auto said = o.json();
  EXPECT_EQ(said["schema"], "gonio.map_export/1");
  EXPECT_EQ(said["width"], 6);
  EXPECT_EQ(said["metals"], 0);
  EXPECT_NEAR(said["ior"], 1.5, 0.01);
  EXPECT_LT(said["high_residual"], 0.06);
  EXPECT_EQ(outside_faults(f, "m.gltf").value_or(""), "");
  const auto file = nlohmann::json::parse(read_bytes(f / "m.gltf"));
  EXPECT_EQ(file["textures"].size(), 4U);
  const auto pixels = [&](std::size_t k) {
    const auto uri = file["images"][k]["uri"].get<std::string>();
    return png_pixels(from_base64(uri.substr(uri.find(',') + 1))).pixels;
  };
  for (const auto& [base, rough, normal] : {std::tuple{pixels(0)[7], pixels(1)[7], pixels(3)[7]}}) {
    EXPECT_NEAR(base[0], srgb_byte(0.5), 1);
    EXPECT_NEAR(base[1], srgb_byte(0.2), 1);
    EXPECT_NEAR(rough[1], 255 * 0.5, 1) << "the root of alpha";
    EXPECT_EQ(rough[2], 0);
    EXPECT_NEAR(normal[0], 127.5, 1);
    EXPECT_EQ(normal[2], 255);
  }
  expect_one_line(gonio(f, "inspect maps.exr"), 3, "a map of 6 × 4 fits");
  expect_one_line(gonio(f, "export maps.exr --to standard_surface -o m.mtlx"), 2,
                  "gltf, mitsuba, open_pbr and usd_preview");
  expect_one_line(gonio(f, "export s/image_000.exr --to gltf -o m2.gltf"), 3, "image_000.exr");
  EXPECT_FALSE(std::filesystem::exists(f / "m2.gltf"));
}

TEST(ExportCommand, WritesAMapWithTexturesBesideItForOpenPbrAndUsd) {
  const Folder f;
  Image map{3, 2, {"f0", "kd.R", "kd.G", "kd.B", "alpha"}, {}, {}};
  map.planes = {{0.04F, 0.04F, 0.04F, 0.04F, 0.04F, 0.9F},
                {0.5F, 0.4F, 0.3F, 0.2F, 0.1F, 0},
                {0.2F, 0.2F, 0.2F, 0.2F, 0.2F, 0},
                {0.1F, 0.1F, 0.1F, 0.1F, 0.1F, 0},
                {0.25F, 0.16F, 0.16F, 0.16F, 0.16F, 0.09F}};
  map.attributes = {{"gonio:schema", "gonio.map/1"},
                    {"gonio:model", "lambert+ggx/smith_ggx.correlated/schlick"},
                    {"gonio:stack", "none"},
                    {"gonio:channels", "R,G,B"}};
  for (const char* axis : {"normal.X", "normal.Y", "normal.Z"}) {
    map.channels.emplace_back(axis);
    map.planes.emplace_back(6, std::string(axis) == "normal.Z" ? 1.0F : 0.0F);
  }
  write_exr(f / "maps.exr", map);
  const auto pixels = [&](const std::string& name) {
    return png_pixels(read_bytes(f / name)).pixels;
  };
  const auto pbr = gonio(f, "export maps.exr --to open_pbr -o surface.mtlx --json").json();
  EXPECT_EQ(pbr["textures"],
            nlohmann::json({"surface.mtlx_color.png", "surface.mtlx_roughness_metal.png",
                            "surface.mtlx_highlight.png", "surface.mtlx_normal.png"}));
  EXPECT_LT(pbr["median_residual"], 0.1) << "OpenPBR's Fresnel is exact, and its base compensated";
  EXPECT_NEAR(pixels("surface.mtlx_color.png")[0][0], srgb_byte(0.5), 1);
  EXPECT_NEAR(pixels("surface.mtlx_color.png")[5][0], srgb_byte(0.9), 1) << "a metal's";
  EXPECT_NEAR(pixels("surface.mtlx_roughness_metal.png")[0][1], 127.5, 1);
  EXPECT_EQ(pixels("surface.mtlx_roughness_metal.png")[5][2], 255);
  EXPECT_EQ(pixels("surface.mtlx_highlight.png")[0][0], 255);
  EXPECT_EQ(outside_faults(f, "surface.mtlx").value_or(""), "");

  const auto usd = gonio(f, "export maps.exr --to usd_preview -o u.usda --json").json();
  EXPECT_LT(usd["median_residual"], 0.1);
  EXPECT_NEAR(pixels("u.usda_color.png")[0][0], srgb_byte(0.5), 1);
  EXPECT_EQ(pixels("u.usda_color.png")[5][0], 0) << "all of a metal's is in its highlight";
  EXPECT_NEAR(pixels("u.usda_highlight.png")[0][0], srgb_byte(0.04), 1);
  EXPECT_NEAR(pixels("u.usda_highlight.png")[5][0], srgb_byte(0.9), 1);
  EXPECT_EQ(outside_faults(f, "u.usda").value_or(""), "");

  const auto o = gonio(f, "export maps.exr --to usd_preview -o u.usda");
  EXPECT_NE(o.out.find("files     u.usda_color.png"), o.out.npos) << o.out;
  expect_one_line(gonio(f, "export maps.exr --to usd_preview -o 'a@b.usda'"), 2, "without quotes");
  EXPECT_FALSE(std::filesystem::exists(f / "a@b.usda"));
  // A texture is no less an output than the file: no input is replaced by one.
  std::filesystem::copy(f / "maps.exr", f / "v.usda_color.png");
  const std::string bytes = read_bytes(f / "v.usda_color.png");
  expect_one_line(gonio(f, "export v.usda_color.png --to usd_preview -o v.usda"), 2,
                  "v.usda_color.png");
  EXPECT_EQ(read_bytes(f / "v.usda_color.png"), bytes);
}

TEST(ExportCommand, GivesFilesOfOneStemTexturesOfTheirOwn) {
  const Folder f;
  Image map{1, 1, {"alpha", "f0", "kd"}, {{0.1F}, {0.04F}, {0.2F}}, {}};
  map.attributes = {{"gonio:schema", "gonio.map/1"},
                    {"gonio:model", "lambert+ggx/smith_ggx.correlated/schlick"},
                    {"gonio:stack", "none"},
                    {"gonio:channels", "Y"}};
  write_exr(f / "dark.exr", map);
  map.planes[2][0] = 0.7F;
  write_exr(f / "bright.exr", map);
  const auto textures = [&](const std::string& words) {
    return gonio(f, "export " + words + " --json")
        .json()["textures"]
        .get<std::vector<std::string>>();
  };
  const auto first = textures("dark.exr --to open_pbr -o a.mtlx");
  std::vector<std::string> bytes;
  for (const auto& name : first) bytes.push_back(read_bytes(f / name));
  textures("bright.exr --to open_pbr -o a.xml");
  textures("bright.exr --to usd_preview -o a.usda");
  for (std::size_t k = 0; k < first.size(); ++k)
    EXPECT_EQ(read_bytes(f / first[k]), bytes[k]) << first[k];
}

TEST(ExportCommand, WritesAMapForMitsubaInTexturesOfFloats) {
  const Folder f;
  Image map{3, 2, {"f0", "kd.R", "kd.G", "kd.B", "alpha"}, {}, {}};
  map.planes = {{0.04F, 0.05F, 0.04F, 0.04F, 0.04F, 0.9F},
                {0.6F, 0.4F, 0.3F, 0.2F, 0.1F, 0},
                {0.2F, 0.2F, 0.2F, 0.2F, 0.2F, 0},
                {0.1F, 0.1F, 0.1F, 0.1F, 0.1F, 0},
                {0.25F, 0.16F, 0.16F, 0.16F, 0.16F, 0.09F}};
  map.attributes = {{"gonio:schema", "gonio.map/1"},
                    {"gonio:model", "lambert+ggx/smith_ggx.separable/schlick"},
                    {"gonio:stack", "none"},
                    {"gonio:channels", "R,G,B"}};
  const auto exported = [&] {
    write_exr(f / "maps.exr", map);
    const auto o = gonio(f, "export maps.exr --to mitsuba -o m.xml --json");
    EXPECT_EQ(o.code, 0) << o.err;
    return o.json();
  };
  const auto said = exported();
  EXPECT_EQ(said["textures"], nlohmann::json({"m.xml_reflectance.exr", "m.xml_alpha.exr",
                                              "m.xml_eta.exr", "m.xml_k.exr"}));
  EXPECT_LT(said["median_residual"], 0.1) << "Mitsuba's Fresnel is exact";
  EXPECT_EQ(said["metals"], 1);
  EXPECT_EQ(read_exr(f / "m.xml_alpha.exr").planes[0][0], 0.25F) << "alpha, not its root";
  const auto eta = read_exr(f / "m.xml_eta.exr");
  ASSERT_EQ(eta.channels.size(), 1U) << "F0 is grey";
  EXPECT_NEAR(eta.planes[0][0], 1.5F, 1e-5F);
  EXPECT_NEAR(read_exr(f / "m.xml_k.exr").planes[0][0], 0.0F, 1e-6F);
  EXPECT_GT(read_exr(f / "m.xml_k.exr").planes[0][5], 0.5F) << "a metal's";
  const auto kd = read_exr(f / "m.xml_reflectance.exr", 100, {"R", "G", "B"});
  EXPECT_NEAR(kd.planes[0][1] / kd.planes[0][0], 0.4F / 0.6F, 1e-6F);
  for (const auto& line : said["lost"])
    EXPECT_EQ(line.get<std::string>().find("Spectral"), std::string::npos) << line;
  map.planes[0] = {0.04F, 0.05F, 0.04F, 0.04F, 0.04F, 0.04F};
  map.planes[4].assign(6, 0.25F);
  EXPECT_EQ(exported()["textures"].size(), 2U) << "one alpha, and no k";
  map.channels[0] = "f0.R";
  for (const char* other : {"f0.G", "f0.B"}) {
    map.channels.emplace_back(other);
    map.planes.emplace_back(6, 0.06F);
  }
  const std::string lost = exported()["lost"].dump();
  EXPECT_NE(lost.find("Spectral variants: they refuse"), std::string::npos) << lost;
}

TEST(ExportCommand, FillsInWhatTexelsOfAMapDoNotKnowAndLetsNoneSetAllOthersHighlight) {
  const Folder f;
  const std::size_t texels = 400;
  Image map;
  map.width = map.height = 20;
  map.channels = {"kd", "alpha", "f0"};
  map.planes = {std::vector<float>(texels, 0.3F), std::vector<float>(texels, 0.25F),
                std::vector<float>(texels, 0.04F)};
  map.attributes = {{"gonio:schema", "gonio.map/1"},
                    {"gonio:model", "lambert+ggx/smith_ggx.correlated/schlick"},
                    {"gonio:stack", "none"},
                    {"gonio:channels", "Y"}};
  for (std::size_t t = 0; t < 8; ++t) map.planes[1][t] = map.planes[2][t] = std::nanf("");
  map.planes[2][9] = 0.2F;  // one fit that went astray
  const auto exported = [&] {
    write_exr(f / "maps.exr", map);
    return gonio(f, "export maps.exr --to gltf -o m.gltf --json").json();
  };
  auto said = exported();
  EXPECT_NEAR(said["ior"], 1.5, 1e-6);
  EXPECT_EQ(said["unknown"], 8);
  EXPECT_EQ(said["filled"].size(), 2U);
  EXPECT_EQ(said["filled"][0]["parameter"], "alpha");
  EXPECT_EQ(said["filled"][0]["texels"], 8);
  EXPECT_NEAR(said["filled"][0]["value"][0], 0.25, 1e-6);
  const auto file = nlohmann::json::parse(read_bytes(f / "m.gltf"));
  const auto pixel = [&](std::size_t image) {
    const auto uri = file["images"][image]["uri"].get<std::string>();
    return png_pixels(from_base64(uri.substr(uri.find(',') + 1))).pixels[0];
  };
  EXPECT_NEAR(pixel(0)[0], srgb_byte(0.3), 1) << "kd is known there";
  EXPECT_NEAR(pixel(1)[1], 127.5, 1) << "the root of alpha";
  // What hardly any texel knows may be known by chance.
  for (std::size_t t = 0; t + 8 < texels; ++t) map.planes[1][t] = std::nanf("");
  said = exported();
  EXPECT_NE(said["filled"][0]["value"][0], 0.25);
  EXPECT_NE(gonio(f, "export maps.exr --to gltf -o m.gltf").out.find(", its default"),
            std::string::npos);
}

TEST(ExportCommand, RefusesAMapWhoseModelIsNoneOrLiesOutsideItsFolder) {
  const Folder f;
  std::filesystem::create_directories(f / "down");
  f.write("private.glsl", "float D(float NoH, float a) { return my_unreleased_formula * NoH; }\n");
  Image map{1,
            1,
            {"kd"},
            {{0.5F}},
            {{"gonio:schema", "gonio.map/1"}, {"gonio:stack", "none"}, {"gonio:channels", "Y"}}};
  map.attributes["gonio:shaders"] = "";
  for (const auto& [model, says] :
       {std::pair("private.glsl", "--follow-paths"), std::pair("lambXrt", "no diffuse term")}) {
    map.attributes["gonio:model"] = model;
    write_exr(f / "down/map.exr", map);
    const auto o = gonio(f, "export down/map.exr --to gltf -o m.gltf");
    expect_one_line(o, 3, says);
    EXPECT_EQ(o.err.find("my_unreleased_formula"), std::string::npos) << "nothing of it is quoted";
    expect_one_line(o, 3, "down/map.exr");
  }
}

TEST(ExportCommand, RefusesAMapTooLargeForTexturesBeforeItIsRead) {
  const Folder f;
  Image map;  // that its bytes pack to nothing costs nobody gigabytes
  map.width = 8192;
  map.height = 4096;
  map.channels = {"alpha"};
  map.planes.emplace_back(map.width * map.height, 0.5F);
  map.attributes = {
      {"gonio:schema", "gonio.map/1"}, {"gonio:model", "lambert"}, {"gonio:channels", "Y"}};
  write_exr(f / "large.exr", map);
  Image small{1, 1, {"kd"}, {{0.5F}}, map.attributes};
  write_exr(f / "small.exr", small);
  expect_one_line(gonio(f, "export small.exr --to gltf -o m.gltf"), 3, "gonio:stack");
  expect_one_line(gonio(f, "export large.exr --to gltf -o m.gltf"), 3, "8192 × 4096");
}

TEST(ExportCommand, WritesAMetalsMapAsMetal) {
  const Folder f;
  ASSERT_EQ(
      gonio(f,
            "synth ggx/smith_ggx.correlated/schlick --set alpha=0.3 f0=0.95,0.64,0.54 --layout map "
            "--size 4,4 --images 24 -o s")
          .code,
      0);
  ASSERT_EQ(
      gonio(f, "fit_map s/stack.json --model ggx/smith_ggx.correlated/schlick -o maps.exr").code,
      0);
  const auto said = gonio(f, "export maps.exr --to gltf -o m.gltf --json").json();
  EXPECT_EQ(said["metals"], 16);
  EXPECT_LT(said["high_residual"], 0.05);
}

TEST(ExportCommand, WritesExtensionsOfGltfWhereTheyMakeTheFitExpressible) {
  const Folder f;
  const auto exported = [&](const std::string& model, const std::string& parameters) {
    f.write("fit.json", R"({"schema": "gonio.fit/1", "channels": ["r", "g", "b"], "model": ")" +
                            model + R"(", "parameters": {)" + parameters + "}}");
    const auto o = gonio(f, "export fit.json --to gltf -o m.gltf --json");
    EXPECT_EQ(o.code, 0) << o.err;
    EXPECT_EQ(outside_faults(f, "m.gltf").value_or(""), "");
    return o.json();
  };
  const auto extensions = [&] {
    return nlohmann::json::parse(read_bytes(f / "m.gltf"))["materials"][0]["extensions"];
  };
  auto said = exported(
      "lambert.coupled+ggx/smith_ggx.separable/schlick",
      R"("alpha": {"value": 0.3}, "kd": {"value": [0.3, 0.2, 0.1]}, "f0": {"value": 0.08})");
  EXPECT_LT(said["written"]["largest"], 1e-9);
  EXPECT_NEAR(extensions()["KHR_materials_ior"]["ior"],
              (1 + std::sqrt(0.08)) / (1 - std::sqrt(0.08)), 1e-9);
  EXPECT_EQ(extensions().size(), 1U);

  said =
      exported("ggx_aniso/smith_ggx_aniso.correlated/schlick",
               R"("alpha_x": {"value": 0.15}, "alpha_y": {"value": 0.4}, "tangent": {"value": 20},
                     "f0": {"value": [0.9, 0.6, 0.3]})");
  EXPECT_LT(said["written"]["largest"], 1e-9);
  const auto strength =
      extensions()["KHR_materials_anisotropy"]["anisotropyStrength"].get<double>();
  EXPECT_NEAR(0.15 + (1 - 0.15) * strength * strength, 0.4, 1e-9);
  EXPECT_NEAR(extensions()["KHR_materials_anisotropy"]["anisotropyRotation"],
              -70 * std::acos(-1) / 180, 1e-9);

  said = exported(
      "lambert+ggx/smith_ggx.separable/schlick.weighted+ggx/smith_ggx.separable/schlick.weighted",
      R"("alpha": {"value": 0.5}, "kd": {"value": [0.3, 0.7, 0.1]}, "f0": {"value": [0.06, 0.08, 0.07]},
                     "weight": {"value": 0.9}, "alpha_2": {"value": 0.1}, "f0_2": {"value": 0.04},
                     "weight_2": {"value": 0.5})");
  EXPECT_LT(said["written"]["rms"], 0.09);
  EXPECT_TRUE(extensions().contains("KHR_materials_clearcoat"));

  exported("lambert.coupled+ggx/smith_ggx.separable/schlick.weighted",
           R"("alpha": {"value": 0.3}, "kd": {"value": 0.3}, "f0": {"value": 0.06},
              "weight": {"value": 0.6})");
  EXPECT_TRUE(extensions()["KHR_materials_specular"].contains("specularFactor"));
}

TEST(ExportCommand, SaysWhatGltfHasNot) {
  const Folder f;
  make_fit(f, "gtr/smith_gtr.correlated/conductor", "alpha=0.4 gamma=1.5");
  const auto o = gonio(f, "export fit.json --to gltf -o m.gltf");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.out.find("exponent of the distribution"), std::string::npos) << o.out;
  EXPECT_NE(o.out.find("Fresnel curve"), std::string::npos) << o.out;
}

TEST(ExportCommand, WritesTheEndOfARangeAndSaysSo) {
  const Folder f;
  f.write("fit.json", R"({"schema": "gonio.fit/1", "channels": ["f"],
    "model": "ggx_aniso/smith_ggx_aniso.separable/conductor", "parameters": {"alpha_x": {"value": 1.5},
    "alpha_y": {"value": 0.5}, "tangent": {"value": 0}, "eta": {"value": 1}, "k": {"value": 4}}})");
  const auto o = gonio(f, "export fit.json --to mitsuba -o m.xml");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.out.find("alpha_u = 1.5 is outside [0.0001, 1]"), std::string::npos) << o.out;
  const auto said = gonio(f, "export fit.json --to mitsuba -o m.xml --json").json();
  EXPECT_EQ(said["clamped"].size(), 1U);
  EXPECT_GT(said["renamed"]["rms"], 0.01);
  EXPECT_LE(said["parameters"]["alpha_u"], 1);
}

TEST(ExportCommand, KeepsTheFitOfAFileThatItWroteAndNotThatFile) {
  const Folder f;
  make_fit(f, "lambert+ggx/smith_ggx.correlated/schlick", "alpha=0.4 f0=0.12 kd=0.3,0.2,0.1");
  f.write("d.csv", "theta_i,phi_i,theta_o,phi_o\n30,0,35,170\n");
  const auto rows = gonio(f, "eval fit.json --directions d.csv --json").json()["rows"];
  std::string from = "fit.json";
  for (const auto& [target, name] :
       {std::pair("mitsuba", "a.xml"), std::pair("mitsuba", "b.xml"), std::pair("gltf", "c.gltf"),
        std::pair("usd_preview", "d.usda"), std::pair("open_pbr", "e.mtlx"),
        std::pair("gltf", "f.gltf")}) {
    const auto o = gonio(f, fmt::format("export {} --to {} -o {}", from, target, name));
    ASSERT_LE(o.code, 1) << o.err;
    const auto read = gonio(f, fmt::format("eval {} --directions d.csv --json", name));
    ASSERT_EQ(read.code, 0) << name << read.err;
    EXPECT_EQ(read.json()["rows"], rows) << name;
    from = name;
  }
  EXPECT_EQ(read_bytes(f / "a.xml"), read_bytes(f / "b.xml")) << "as often as one likes";
  // What is no text stands around the fit.
  std::string bytes = read_bytes(f / "a.xml");
  bytes.insert(bytes.find("?>"), "\x80");
  f.write("bytes.xml", bytes);
  EXPECT_LE(gonio(f, "export bytes.xml --to usd_preview -o u.usda").code, 1);
  EXPECT_EQ(read_bytes(f / "u.usda").find('\x80'), std::string::npos);
}

TEST(ExportCommand, RefusesExportedFilesWithoutAFit) {
  const Folder f;
  f.write("plain.xml", "<?xml version=\"1.0\"?>\n<bsdf/>\n");
  f.write("cut.xml", "<!-- gonio: the fit as it was exported\n{\"schema\"");
  f.write("empty.gltf", R"({"asset": {}, "materials": []})");
  f.write("plain.gltf", R"({"asset": {}, "materials": [{"extras": {}}]})");
  expect_one_line_each(f, 3,
                       {{"export empty.gltf --to gltf -o m.gltf", "materials"},
                        {"export plain.gltf --to gltf -o m.gltf", "gonio"},
                        {"export plain.xml --to gltf -o m.gltf", "no comment"},
                        {"eval cut.xml --directions plain.xml --json", "plain.xml"},
                        {"export cut.xml --to gltf -o m.gltf", "without end"}});
}

TEST(ExportCommand, RefusesWhatItCannotReadOrWrite) {
  const Folder f;
  make_fit(f, "lambert", "kd=0.2");
  f.write("newer.json", R"({"schema": "gonio.fit/2"})");
  f.write("two.json", R"({"schema": "gonio.fit/1", "channels": ["a", "b"], "model": "lambert",
    "parameters": {"kd": {"value": [0.1, 0.2]}}})");
  expect_one_line_each(f, 3,
                       {{"export newer.json --to gltf -o m.gltf", "gonio.fit/2"},
                        {"export two.json --to open_pbr -o m.gltf", "channels: found 2"},
                        {"export missing.json --to gltf -o m.gltf", "missing.json"},
                        {"export fit.json --to gltf -o nowhere/m.gltf", "nowhere/m.gltf"}});
  expect_one_line_each(f, 2,
                       {{"export fit.json --to vrml -o m.gltf", "vrml"},
                        {"export fit.json --to gltf -o fit.json", "fit.json"},
                        {"export fit.json --to gltf --tolerance -1 -o m.gltf", "--tolerance"}});
  EXPECT_FALSE(std::filesystem::exists(f / "m.gltf"));
}

}  // namespace
}  // namespace gonio::test
