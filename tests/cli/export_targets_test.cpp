// gonio export and convert, held against the targets' own code: f of the written file is as far
// from the fit as the exporter says.
#include <cmath>
#include <sstream>

#include "brdf/model/evaluate.h"
#include "brdf/model/fitted_model.h"
#include "cli/outside.h"
#include "cli/program.h"
#include "fitting/export/export.h"
#include "fitting/export/surface.h"
#include "fitting/export/target.h"
#include "geometry/half_difference.h"

#include <fmt/format.h>

namespace gonio::test {
namespace {

#define GONIO_NEEDS(there, what) \
  if (!(there)) GTEST_SKIP() << what << " is not in build/targets: run ./check, which fetches it"

/// Document of a fit without all that an export does not read.
void write_fit(const Folder& f, const std::string& model, const std::string& set) {
  nlohmann::ordered_json parameters;
  for (const auto& s : parse_settings(std::vector<std::string>{set}))
    parameters[s.name]["value"] =
        s.values.size() == 1 ? nlohmann::json(s.values[0]) : nlohmann::json(s.values);
  f.write("fit.json", nlohmann::ordered_json{{"schema", "gonio.fit/1"},
                                             {"model", model},
                                             {"channels", {"r", "g", "b"}},
                                             {"parameters", parameters}}
                              .dump(2) +
                          "\n");
}

using F = std::vector<std::array<double, 3>>;

F values_of_fit(const Folder& f, const std::vector<FrameAngles<double>>& angles) {
  const std::string path = f / "fit.json";
  const auto channels = evaluate(bind_fitted(path, read_fitted_model(path), 3), angles);
  F rows;
  for (std::size_t i = 0; i < angles.size(); ++i)
    rows.push_back({channels[0][i], channels[1][i], channels[2][i]});
  return rows;
}
F values_of_fit(const Folder& f) {
  std::vector<FrameAngles<double>> angles;
  for (const auto& d : judged_directions()) angles.push_back(frame_angles(d));
  return values_of_fit(f, angles);
}

/// What the target's own code makes of a file, by a script of tests/cli/targets.
/// \param variant  of the target, where it has several
F values_of_target(const Folder& f,
                   const std::string& script,
                   const std::string& file,
                   const std::string& variant = "") {
  std::string pairs;
  for (const auto& [i, o] : judged_directions())
    pairs += fmt::format("{} {} {} {} {} {}\n", i.x, i.y, i.z, o.x, o.y, o.z);
  f.write("pairs.txt", pairs);
  const auto o = outside(f, script, (f / file) + " " + (f / "pairs.txt") + " " + variant);
  EXPECT_EQ(o.code, 0) << o.err;
  std::istringstream in(o.out);
  F rows;
  for (std::array<double, 3> x; in >> x[0] >> x[1] >> x[2];) rows.push_back(x);
  EXPECT_EQ(rows.size(), export_directions);
  return rows;
}

/// \param f  where the fit is: its surface is what distances are relative to, where its own values are small
ExportResidual distance(const F& target, const F& fit, const Folder& f) {
  const std::string path = f / "fit.json";
  const Surface like = surface_of(bind_fitted(path, read_fitted_model(path), 3));
  ExportResidual r;
  if (target.size() != fit.size()) return {-1, -1, {}};
  double sum = 0;
  std::vector<std::vector<double>> channels(3);
  for (const auto& x : fit)
    for (std::size_t c = 0; c < 3; ++c) channels[c].push_back(x[c]);
  const auto scale = scale_of(channels, like);
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < fit.size(); ++i) {
      const double d = std::abs(target[i][c] - fit[i][c]) / scale[c][i];
      sum += d * d;
      r.largest = std::max(r.largest, d);
    }
  r.rms = std::sqrt(sum / static_cast<double>(3 * fit.size()));
  return r;
}

/// Export to a target whose own code finds the distance from the fit that the exporter found.
struct Held {
  const Folder& folder;
  std::string target, file, script;
  double slack = 1e-4;  ///< of numbers that the target computes in float

  nlohmann::json operator()(const std::string& model, const std::string& set) const {
    SCOPED_TRACE(model + " " + set);
    write_fit(folder, model, set);
    const auto o = gonio(folder, "export fit.json --to " + target + " -o " + file + " --json");
    EXPECT_EQ(o.code, 0) << o.err;
    if (o.code != 0) return {};
    const auto fit = values_of_fit(folder);
    const auto expect_near = [&](const ExportResidual& seen, const nlohmann::json& said,
                                 double within) {
      EXPECT_NEAR(seen.rms, said["rms"], within + 0.002 * said["rms"].get<double>());
      EXPECT_NEAR(seen.largest, said["largest"],
                  10 * within + 0.01 * said["largest"].get<double>());
    };
    // The targets integrate spectra by steps of their own.
    const double of_spectra = 2e-3;
    const auto variants = o.json().value("variants", nlohmann::json::array());
    for (const auto& v : variants) {
      SCOPED_TRACE(v["variant"]);
      expect_near(distance(values_of_target(folder, script, file, v["variant"]), fit, folder),
                  v["residual"], of_spectra);
    }
    if (variants.empty())
      expect_near(distance(values_of_target(folder, script, file), fit, folder),
                  o.json()["written"], slack);
    return o.json();
  }
  /// The distance of the file with one thing in it replaced.
  double rms_with(const std::string& found, const std::string& by) const {
    std::string text = read_bytes(folder / file);
    const auto at = text.find(found, text.find("-->") == text.npos ? 0 : text.find("-->"));
    EXPECT_NE(at, text.npos) << found << " in\n" << text;
    if (at == text.npos) return -1;
    folder.write("fault_" + file, text.replace(at, found.size(), by));
    return distance(values_of_target(folder, script, "fault_" + file), values_of_fit(folder),
                    folder)
        .rms;
  }
};

TEST(ExportToMitsuba, IsInMitsubaAsFarFromTheFitAsItSays) {
  GONIO_NEEDS(has_outside("mitsuba"), "Mitsuba");
  const Folder f;
  const Held held{f, "mitsuba", "m.xml", "mitsuba_values.py"};
  const auto metal =
      held("ggx/smith_ggx.separable/conductor", "alpha=0.3,eta=0.2,0.9,1.1,k=3.9,2.4,2.2");
  EXPECT_LT(metal["written"]["largest"], 1e-6) << "Mitsuba's own model";
  EXPECT_FALSE(metal["refitted"]);
  const auto plastic =
      held("lambert+ggx/smith_ggx.correlated/schlick", "alpha=0.4,f0=0.06,kd=0.3,0.2,0.1");
  EXPECT_TRUE(plastic["refitted"]);
  EXPECT_LT(plastic["written"]["rms"], 0.09) << "to 88°, where Mitsuba's base darkens";
  const auto brushed = held("ggx_aniso/smith_ggx_aniso.separable/schlick",
                            "alpha_x=0.4,alpha_y=0.1,f0=0.9,0.6,0.3,tangent=0");
  EXPECT_LT(brushed["written"]["rms"], 0.05);
  held(
      "lambert+ggx/smith_ggx.correlated/schlick.weighted+ggx/smith_ggx.correlated/"
      "schlick.weighted",
      "alpha=0.5,f0=0.3,weight=0.4,kd=0.3,0.7,0.1,alpha_2=0.1,f0_2=0.05,weight_2=0.8");
  const auto matte = held("lambert", "kd=0.3,0.7,0.1");
  for (const auto& v : metal["variants"])
    EXPECT_LT(v["residual"]["largest"], 0.02)
        << v << ": an index as a reflectance loses the highlight";
  EXPECT_EQ(metal["variants"].size(), 2U);
  EXPECT_EQ(plastic["variants"].size(), 2U) << "whose refit has an index for each channel";
  EXPECT_EQ(matte["variants"].size(), 0U) << "no index";
}

TEST(ExportToMitsuba, KeepsAGreyPlasticsHighlightInSpectralVariants) {
  GONIO_NEEDS(has_outside("mitsuba"), "Mitsuba");
  const Folder f;
  const Held held{f, "mitsuba", "m.xml", "mitsuba_values.py"};
  held("lambert+ggx/smith_ggx.separable/dielectric", "alpha=0.3,eta=1.5,kd=0.2");
  const auto fit = values_of_fit(f);
  EXPECT_LT(
      distance(values_of_target(f, "mitsuba_values.py", "m.xml", "scalar_spectral"), fit, f).rms,
      0.01);
}

TEST(ExportToMitsuba, ShowsAWrongFactorInMitsuba) {
  GONIO_NEEDS(has_outside("mitsuba"), "Mitsuba");
  const Folder f;
  const Held held{f, "mitsuba", "m.xml", "mitsuba_values.py"};
  held("lambert+ggx/smith_ggx.separable/conductor.weighted",
       "alpha=0.25,eta=0.2,0.9,1.1,k=3.9,2.4,2.2,weight=0.5,kd=0.25");
  EXPECT_GT(held.rms_with("name=\"alpha\" value=\"0.25\"", "name=\"alpha\" value=\"0.5\""), 0.3)
      << "roughness for alpha";
  EXPECT_GT(held.rms_with("name=\"specular_reflectance\" value=\"1\"",
                          "name=\"specular_reflectance\" value=\"0.5\""),
            0.1)
      << "a blend's share forgotten";
  EXPECT_GT(held.rms_with("name=\"reflectance\" value=\"0.5, 0.5, 0.5\"",
                          "name=\"reflectance\" value=\"0.1592, 0.1592, 0.1592\""),
            0.1)
      << "divided by pi twice";
  EXPECT_GT(held.rms_with("value=\"ggx\"", "value=\"beckmann\""), 0.05);
}

TEST(ExportToMaterialX, StandardSurfaceIsAsFarFromTheFitAsItSays) {
  GONIO_NEEDS(has_materialx(), "MaterialX with OpenGL");
  const Folder f;
  const Held held{f, "standard_surface", "m.mtlx", "materialx_values.py", 2e-4};
  const auto metal = held("ggx_aniso/smith_ggx_aniso.correlated/conductor",
                          "alpha_x=0.15,alpha_y=0.4,eta=0.2,0.9,1.1,k=3.9,2.4,2.2,tangent=20");
  EXPECT_EQ(metal["parameters"]["metalness"], 1);
  EXPECT_NEAR(metal["parameters"]["specular_rotation"], 250.0 / 360, 0.01) << "clockwise";
  const auto coated =
      held("lambert+ggx/smith_ggx.correlated/schlick+ggx/smith_ggx.correlated/dielectric.weighted",
           "alpha=0.5,f0=0.06,0.08,0.07,kd=0.3,0.7,0.1,alpha_2=0.1,eta_2=1.5,weight_2=0.8");
  EXPECT_TRUE(coated["refitted"]);
  EXPECT_TRUE(coated["parameters"].contains("coat_roughness"));
}

TEST(ExportToMaterialX, OpenPbrIsAsFarFromTheFitAsItSays) {
  GONIO_NEEDS(has_materialx(), "MaterialX with OpenGL");
  const Folder f;
  const Held held{f, "open_pbr", "m.mtlx", "materialx_values.py", 2e-4};
  const auto metal = held("ggx_aniso/smith_ggx_aniso.correlated/f82",
                          "alpha_x=0.15,alpha_y=0.4,f0=0.9,0.6,0.3,f82_tint=0.9,0.8,1,tangent=20");
  EXPECT_EQ(metal["parameters"]["base_metalness"], 1);
  EXPECT_TRUE(metal["parameters"].contains("geometry_tangent"));
  held("lambert+ggx/smith_ggx.correlated/schlick+ggx/smith_ggx.correlated/dielectric.weighted",
       "alpha=0.5,f0=0.06,0.08,0.07,kd=0.3,0.7,0.1,alpha_2=0.1,eta_2=1.5,weight_2=0.8");
  const auto matte = held("lambert", "kd=0.3,0.7,0.1");
}

TEST(ExportToMaterialX, ShowsAWrongFactorInMaterialX) {
  GONIO_NEEDS(has_materialx(), "MaterialX with OpenGL");
  const Folder f;
  const Held held{f, "open_pbr", "m.mtlx", "materialx_values.py", 2e-4};
  const auto right =
      held("lambert+ggx/smith_ggx.correlated/dielectric", "alpha=0.25,eta=1.5,kd=0.25");
  const auto written = [&](const char* name) {
    const auto text = read_bytes(f / "m.mtlx");
    const auto at = text.find(std::string("name=\"") + name);
    return text.substr(at, text.find("/>", at) - at);
  };
  const std::string roughness = written("specular_roughness"), color = written("base_color");
  const double rms = right["written"]["rms"];
  EXPECT_GT(held.rms_with(roughness, "name=\"specular_roughness\" type=\"float\" value=\"0.25\""),
            10 * rms)
      << "alpha for roughness";
  EXPECT_GT(held.rms_with(color, "name=\"base_color\" type=\"color3\" value=\"0.08, 0.08, 0.08\""),
            10 * rms)
      << "divided by pi twice";
  std::string text = read_bytes(f / "m.mtlx");
  f.write("named.mtlx", text.replace(text.find("base_color\""), 10, "base_colour"));
  EXPECT_NE(outside_faults(f, "named.mtlx"), "") << "an input that OpenPBR has not";
}

/// The exported m.gltf with one thing in its material changed.
void write_fault(const Folder& f, auto&& change) {
  auto document = nlohmann::json::parse(read_bytes(f / "m.gltf"));
  change(document["materials"][0]);
  f.write("fault.gltf", document.dump());
}

// Another surface reads glTF's parameters here, whose equations are a few percent from glTF's own.
TEST(ExportToGltf, IsNearTheFitInAnotherProgramAndFarWithAWrongFactor) {
  GONIO_NEEDS(has_materialx(), "MaterialX with OpenGL");
  const Folder f;
  const auto rms_of = [&](const std::string& model, const std::string& set) {
    write_fit(f, model, set);
    const auto o = gonio(f, "export fit.json --to gltf -o m.gltf");
    EXPECT_EQ(o.code, 0) << o.err;
    return distance(values_of_target(f, "gltf_values.py", "m.gltf"), values_of_fit(f), f).rms;
  };
  const auto rms_with = [&](auto&& change) {
    write_fault(f, change);
    return distance(values_of_target(f, "gltf_values.py", "fault.gltf"), values_of_fit(f), f).rms;
  };
  EXPECT_LT(rms_of("ggx_aniso/smith_ggx_aniso.correlated/schlick",
                   "alpha_x=0.05,alpha_y=0.12,f0=0.9,0.6,0.3,tangent=20"),
            0.1);
  EXPECT_GT(rms_with([](auto& m) {
              auto& a = m["extensions"]["KHR_materials_anisotropy"]["anisotropyRotation"];
              a = -a.template get<double>();
            }),
            0.2)
      << "clockwise";
  EXPECT_LT(rms_of("lambert.coupled+ggx/smith_ggx.separable/schlick.weighted+ggx/"
                   "smith_ggx.separable/schlick.weighted",
                   "alpha=0.15,weight=1,kd=0.3,0.2,0.1,f0=0.02,0.04,0.08,alpha_2=0.03,f0_2=0.04,"
                   "weight_2=0.4"),
            0.1)
      << "coated";
  const double right = rms_of("lambert.coupled+ggx/smith_ggx.separable/schlick",
                              "alpha=0.3,kd=0.3,0.2,0.1,f0=0.02,0.04,0.08");
  EXPECT_LT(right, 0.15);
  EXPECT_GT(rms_with([](auto& m) { m["pbrMetallicRoughness"]["roughnessFactor"] = 0.3; }),
            2 * right)
      << "alpha for roughness";
  EXPECT_GT(rms_with([](auto& m) {
              for (auto& x : m["pbrMetallicRoughness"]["baseColorFactor"])
                x = x.template get<double>() / 3.14159;
            }),
            2 * right)
      << "divided by pi twice";
}

/// Distance from the fit of what Blender makes of a glTF file, over its own 1,000 directions.
double rms_in_blender(const Folder& f, const std::string& file) {
  const auto o = in_blender(f, (f / file) + " " + (f / "seen.txt"));
  EXPECT_EQ(o.code, 0) << o.out << o.err;
  std::istringstream in(read_bytes(f / "seen.txt"));
  std::vector<FrameAngles<double>> angles;
  F seen;
  Direction i, d;
  for (std::array<double, 3> x;
       in >> i.x >> i.y >> i.z >> d.x >> d.y >> d.z >> x[0] >> x[1] >> x[2];) {
    angles.push_back(frame_angles({i, d}));
    seen.push_back(x);
  }
  EXPECT_GE(seen.size(), 1000U);
  return distance(seen, values_of_fit(f, angles), f).rms;
}

// Blender's Principled node reads glTF's parameters under equations of its own: exact Fresnel,
// light between facets given back, layers by directional albedo.
TEST(ExportToGltf, IsNearTheFitInBlenderAndFarWithAWrongFactor) {
  if (!has_blender()) GTEST_SKIP() << "Blender is not in build/blender: run ./check --long";
  const Folder f;
  const auto rms_of = [&](const std::string& model, const std::string& set) {
    SCOPED_TRACE(model + " " + set);
    write_fit(f, model, set);
    const auto o = gonio(f, "export fit.json --to gltf -o m.gltf");
    EXPECT_EQ(o.code, 0) << o.err;
    return rms_in_blender(f, "m.gltf");
  };
  const auto rms_with = [&](auto&& change) {
    write_fault(f, change);
    return rms_in_blender(f, "fault.gltf");
  };
  EXPECT_LT(rms_of("ggx/smith_ggx.separable/schlick", "alpha=0.15,f0=0.9,0.6,0.3"), 0.05);
  EXPECT_LT(
      rms_of("lambert.coupled+ggx/smith_ggx.separable/schlick", "alpha=0.2,kd=0.3,0.2,0.1,f0=0.04"),
      0.1);
  EXPECT_GT(rms_with([](auto& m) { m["pbrMetallicRoughness"]["roughnessFactor"] = 0.2; }), 0.2)
      << "alpha for roughness";
  EXPECT_GT(rms_with([](auto& m) {
              for (auto& x : m["pbrMetallicRoughness"]["baseColorFactor"])
                x = x.template get<double>() / 3.14159;
            }),
            0.2)
      << "divided by pi twice";
}

/// Planned material and the same with all effects, in MaterialX: instructions and f of both.
struct InMaterialx {
  int planned_instructions = 0, exact_instructions = 0;
  F planned, exact;
};
InMaterialx in_materialx(const Folder& f, const std::string& file, const std::string& name) {
  std::string pairs;
  for (const auto& [i, o] : judged_directions())
    pairs += fmt::format("{} {} {} {} {} {}\n", i.x, i.y, i.z, o.x, o.y, o.z);
  f.write("pairs.txt", pairs);
  const auto o =
      outside(f, "plan_in_materialx.py", (f / file) + " " + name + " " + (f / "pairs.txt"));
  EXPECT_EQ(o.code, 0) << o.err;
  std::istringstream in(o.out);
  InMaterialx r;
  in >> r.planned_instructions >> r.exact_instructions;
  for (std::array<double, 3> p, e; in >> p[0] >> p[1] >> p[2] >> e[0] >> e[1] >> e[2];)
    r.planned.push_back(p), r.exact.push_back(e);
  EXPECT_EQ(r.planned.size(), export_directions);
  return r;
}

TEST(PlanInMaterialX, LeavesOutWhatIsDroppedAndStaysNearBothModels) {
  GONIO_NEEDS(has_materialx(), "MaterialX with OpenGL");
  if (std::system("command -v spirv-opt glslangValidator >/dev/null") != 0)
    GTEST_SKIP() << "Without glslang and SPIRV-Tools: instructions are not counted.";
  struct Case {
    std::string name, model, set;
    double exact_rms, planned_rms;  ///< at most, beside gonio's own f; 0: not compared
    std::string dropped;
  };
  // MaterialX's masking is of a mean width and correlated, and light between facets is given back.
  const Case cases[] = {
      {"plastic", "disney.coupled+ggx/smith_ggx.correlated/dielectric",
       "alpha=0.16,eta=1.5,kd=0.5,0.03,0.02", 0.032, 0.17, "fresnel"},
      {"brushed metal", "ggx_aniso/smith_ggx_aniso.correlated/conductor",
       "alpha_x=0.2,alpha_y=0.17,tangent=30,eta=0.14,0.13,0.13,k=3.9,3.2,2.4", 0.065, 0.23,
       "anisotropy"},
      {"paint",
       "lambert.coupled+ggx/smith_ggx.correlated/schlick+coat:ggx/smith_ggx.correlated/dielectric",
       "alpha=0.16,f0=0.1,0.02,0.02,kd=0.2,0.01,0.01,alpha_2=0.09,eta_2=1.05", 0, 0.175, "coat"}};
  const Folder f;
  nlohmann::json scene = nlohmann::json::parse(R"({"schema": "gonio.scene/1",
    "lights": [{"type": "directional", "direction": [0.1, 0.2, 0.9], "irradiance": [1, 1, 1]}],
    "view": {"position": [0, 0, 20], "target": [0, 0, 0], "fov_deg": 20},
    "tolerance": {"metric": "delta_e_2000", "limit": 7, "max": 40}})");
  double x = -3;
  for (const auto& c : cases) {
    auto& m = scene["materials"][c.name];
    m["model"] = c.model;
    for (const auto& s : parse_settings(std::vector<std::string>{c.set}))
      m["parameters"][s.name] =
          s.values.size() == 1 ? nlohmann::json(s.values[0]) : nlohmann::json(s.values);
    scene["objects"].push_back({{"shape", "sphere"}, {"material", c.name}, {"center", {x, 0, 0}}});
    x += 2;
  }
  f.write("scene.json", scene.dump());
  ASSERT_EQ(gonio(f, "plan scene.json --write mtlx -o plan.json --cost operations").code, 0);
  const auto plan = nlohmann::json::parse(read_bytes(f / "plan.json"));
  for (const auto& c : cases) {
    SCOPED_TRACE(c.name);
    const auto& m = plan["materials"][c.name];
    for (const auto& e : m["effects"]) {
      if (e["effect"] != c.dropped) continue;
      EXPECT_EQ(e["keep"], false) << c.dropped;
    }
    std::string name = c.name;
    std::ranges::replace(name, ' ', '_');
    const auto both = in_materialx(f, "plan.mtlx", name);
    EXPECT_LT(both.planned_instructions, 0.95 * both.exact_instructions);
    nlohmann::ordered_json fit{
        {"schema", "gonio.fit/1"}, {"model", m["spec"]}, {"channels", {"r", "g", "b"}}};
    for (const auto& [of, value] : m["parameters"].items()) fit["parameters"][of]["value"] = value;
    f.write("fit.json", fit.dump());
    const auto planned = distance(both.planned, values_of_fit(f), f).rms;
    EXPECT_LT(planned, c.planned_rms);
    if (c.exact_rms == 0) continue;  // a fit has no coat
    write_fit(f, c.model, c.set);
    const auto exact = distance(both.exact, values_of_fit(f), f).rms;
    EXPECT_LT(exact, c.exact_rms);
  }
}

TEST(ExportToUsd, PreviewSurfaceIsAsFarFromTheFitAsItSays) {
  GONIO_NEEDS(has_materialx() && has_outside("pxr"), "USD, or MaterialX with OpenGL,");
  const Folder f;
  const Held held{f, "usd_preview", "m.usda", "usd_values.py", 2e-4};
  held("lambert+ggx/smith_ggx.correlated/schlick+ggx/smith_ggx.correlated/dielectric.weighted",
       "alpha=0.5,f0=0.06,0.08,0.07,kd=0.3,0.7,0.1,alpha_2=0.1,eta_2=1.5,weight_2=0.8");
  const std::string file = read_bytes(f / "m.usda");
  const auto said_of = [&](std::string found, const std::string& by) {
    std::string text = file;
    const auto at = text.find(found, text.find("def "));
    EXPECT_NE(at, text.npos) << found;
    f.write("fault.usda", text.replace(at, found.size(), by));
    return outside_faults(f, "fault.usda").value_or("");
  };
  EXPECT_NE(said_of("inputs:roughness", "inputs:rougness").find("has not: rougness"),
            std::string::npos);
  EXPECT_NE(said_of("float inputs:clearcoat = ", "float inputs:clearcoat = 1").find("is outside"),
            std::string::npos);
  EXPECT_NE(said_of("float inputs:ior", "int inputs:ior").find("ior is a"), std::string::npos);
}

class ExportOf : public testing::TestWithParam<std::pair<const char*, const char*>> {};
INSTANTIATE_TEST_SUITE_P(Targets,
                         ExportOf,
                         testing::Values(std::pair{"mitsuba", "m.xml"},
                                         std::pair{"open_pbr", "m.mtlx"},
                                         std::pair{"usd_preview", "m.usda"}));

TEST_P(ExportOf, AFitWritesAFileThatIsReadAsTheFit) {
  const auto [target, name] = GetParam();
  const Folder f;
  write_fit(f, "lambert+ggx/smith_ggx.correlated/schlick", "alpha=0.4,f0=0.12,kd=0.3,0.2,0.1");
  auto named = nlohmann::ordered_json::parse(read_bytes(f / "fit.json"));
  named["input"]["path"] = "a--b-->c<!-- \"d\".csv";
  f.write("fit.json", named.dump(2));
  ASSERT_EQ(gonio(f, std::string("export fit.json --to ") + target + " -o " + name).code, 0);
  f.write("d.csv", "theta_i,phi_i,theta_o,phi_o\n30,0,35,170\n70,0,60,190\n");
  const auto fit = gonio(f, "eval fit.json --directions d.csv --json");
  const auto file = gonio(f, std::string("eval ") + name + " --directions d.csv --json");
  ASSERT_EQ(file.code, 0) << file.err;
  EXPECT_EQ(file.json()["rows"], fit.json()["rows"]);
  const std::string xml = read_bytes(f / name);
  if (xml.starts_with('#')) return;
  const auto begin = xml.find("{"), end = xml.find("-->");
  EXPECT_EQ(nlohmann::ordered_json::parse(xml.substr(begin, end - begin)), named);
}

TEST(ConvertCommand, WritesRglFilesThatMitsubaEvaluatesAndDrawsFrom) {
  GONIO_NEEDS(has_outside("mitsuba"), "Mitsuba");
  const Folder f;
  const auto o = outside(f, "rgl_in_mitsuba.py",
                         program_path() + std::string(std::getenv("GONIO_LONG") ? " --long" : ""));
  EXPECT_EQ(o.code, 0) << o.out << o.err;
}

}  // namespace
}  // namespace gonio::test
