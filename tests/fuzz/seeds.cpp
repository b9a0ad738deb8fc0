// gonio_fuzz_seeds DIR: for each reader small files that it reads, to begin from.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

#ifdef GONIO_SHADERS
#include "foreign/compile.h"
#endif
#include "image/exr.h"
#include "image/npy.h"
#include "scene/description/gltf_example.h"
#include "scene/description/scene_example.h"
#include "scene/plan/document.h"
#include "scene/plan/scenes.h"
#include "table/example.h"
#include "table/foreign.h"
#include "table/format/formats.h"
#include "table/format/metadata.h"
#include "tiff_bytes.h"

namespace {

using namespace gonio;
using namespace gonio::test;

std::filesystem::path folder;

std::string place(const std::string& reader, const std::string& name) {
  std::filesystem::create_directories(folder / reader);
  return (folder / reader / name).string();
}
void save(const std::string& reader, const std::string& name, const std::string& bytes) {
  std::ofstream(place(reader, name), std::ios::binary) << bytes;
}

double f(const DirectionPair& p, std::size_t channel) {
  return 0.1 * static_cast<double>(channel + 1) + 0.05 * p.wi.x * p.wo.x;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: gonio_fuzz_seeds DIR\n", stderr);
    return 2;
  }
  folder = argv[1];
  save("merl", "header", bytes_of(std::array<std::int32_t, 3>{90, 90, 180}));
  write_table(mbsdf_example(2, 3), place("mbsdf", "rgb"));
  Table csv = csv_example();
  write_table(csv, place("csv", "weights"));
  csv.channels = {"a,b", "say \"x\"\n"};
  csv.weights.clear();
  write_table(csv, place("csv", "quoted"));
  save("csv", "old_mac", "\"theta_i\";theta_o;\"f_\"\"\"\r\"30\";-28;0,412\r30;10;nan\r");
  save("csv", "plain", "theta_i,phi_i,theta_o,phi_o,f\r\n30,0,28,180,0.412\r\n30,0,10,0,nan\r\n");
  Table slice = slice_example();
  slice.truth = truth_example();
  write_table(slice, place("exr", "slice"));
  RglFile rgl{.size = 3, .f = f};
  save("rgl", "rgb", rgl.bytes());
  rgl.wavelengths = {400, 700};
  rgl.theta_i = {0, 1};
  rgl.phi_i = {-3, -1.5F, 0, 1.5F, 3};
  save("rgl", "spectral", rgl.bytes());
  save("klems", "small", KlemsFile{.rings = {{0, 30, 1}, {30, 90, 2}}, .f = f}.bytes());
  save("klems", "rows",
       KlemsFile{.rings = {{0, 90, 1}}, .columns = false, .directions = {"Reflection Back"}, .f = f}
           .bytes());
  save("klems", "tree", tensor_tree_file(3, "{{1}{2}{3}{4}{5}{6}{7}{1 2 3 4 5 6 7 8}}"));
  save("zemax", "xyz",
       ZemaxFile{.symmetry = "ASymmetrical4D",
                 .rotation = {0, 90, 180},
                 .azimuth = {0, 90, 180, 270},
                 .xyz = true,
                 .f = f}
           .bytes());
  save(
      "brdf_json", "old",
      R"({"head": {"date": "x"}, "data": {"wavelengths": [500, 600], "theta_i": [0, 9, 9], "phi_i": [0, 9, 9], "theta_v": [-1, 2, 2], "phi_v": [0, 9, 8], "pol": "spu", "data": [[500, 1, 2, 3], [600, 4, 5, 6]]}})");
  save(
      "brdf_json", "new",
      R"({"metadata": {"id": "7"}, "data": {"variables": [{"name": "theta_i", "unit": "rad"}, {"name": "phi_i", "unit": "deg"}, {"name": "theta_r", "unit": "deg"}, {"name": "phi_r", "unit": "deg"}, {"name": "wavelength_i", "unit": "nm"}, {"name": "pol_i"}, {"name": "BRDF", "unit": "sr-1"}], "values": [[0.5, 0, 20, 180, 650, "s", 0.3]]}})");
  save(
      "xompt", "rows",
      R"({"metadata": {"name": "x"}, "brdf": {"lookupTable": [[5e-7, 0.1, 0.2, 3, 0.04], [6e-7, 0.1, 0.2, 3, 0.05]]}})");
  for (const auto& [name, size] :
       std::initializer_list<std::pair<const char*, std::size_t>>{{"ISOTROPIC_TL_TV_PROJ_DPHI", 3},
                                                                  {"SPHERICAL_TL_PL_TV_PV", 4},
                                                                  {"RUSIN_TH_TD_PD", 3},
                                                                  {"COS_TH_TD", 2}})
    save("alta", name,
         alta_file(name, "INV_STERADIAN_COSINE_FACTOR", size, 1,
                   {std::vector<double>(size + 1, 0.3), std::vector<double>(size + 1, 0.7)}));
  save("alta", "binary",
       "#FORMAT binary\n#SAMPLE_COUNT 1\n#ENDIAN little\n#DIM 2 1\n#VS 0\n#PARAM_IN "
       "ISOTROPIC_TV_TL\n"
       "#PARAM_OUT INV_STERADIAN\n#BEGIN_STREAM\n" +
           bytes_of(std::array<double, 3>{0.1, 0.2, 0.3}));
  save("utia", "numbers", bytes_of(std::array<double, 5>{0.3, 0, -1, 1e300, NAN}));
  save("astm", "colours",
       "NUM_POINTS 2\nVARS theta_i,phi_i,theta_s,phi_s,R,G\n0.5,0,-0.2,3,1,2\n0.1,0,0,0,nan,2\n");
  for (const char* type : {"spherical", "specular", "half_difference"})
    save("ssdd", type, ssdd_file(type, "ascii", "1\n2\n"));
  save("ssdd", "binary", ssdd_file("specular", "binary", bytes_of(std::array<float, 2>{1, 2})));
  save("ngan", "half", ngan_file({2, 1, 3, 2}, true, [](std::size_t k) { return k; }));
  Table t = mbsdf_example(1, 2);
  t.truth = truth_example();
  t.notes = {{"a", "b"}};
  save("side", "truth", metadata_text(t));
  save("side", "columns", with_columns("side", "", ColumnMap{}));
  save("npy", "grey", npy_header({2, 3}) + bytes_of(std::array<float, 6>{0, 1, 2, 3, 4, 5}));
  save("npy", "colours", npy_header({1, 2, 3}) + bytes_of(std::array<float, 6>{0, 1, 2, 3, 4, 5}));
  save("stack", "whole",
       R"({"schema": "gonio.stack/1", "values": "f_r_cosine", "normals": "n.exr", "images": [)"
       R"({"path": "0.exr", "theta_i": 30, "phi_i": 9, "view": [0, 0, 1], "scale": 2},)"
       R"({"path": "1.npy", "light_map": "l.exr", "view_map": "v.exr"}]})");
  Image small{3, 2, {"R", "Y"}, {{0, 1, 2, 3, 4, 5}, {1, 1, 2, 2, 3, 3}}, {{"a", "b"}}};
  save("parts", "lines", exr_bytes("lines", small));
  save("parts", "half", exr_bytes("half", small, Storage::half));
  save("parts", "tiff", tiff_of({}));
  save("parts", "tiff_of_floats", tiff_of({.channels = 1, .bits = 32}));
  const auto square = scene::test::square_gltf();
  save("gltf", "text", square.dump());
  save("gltf", "binary", scene::test::glb(square, scene::test::square_bytes()));
  save("scene", "whole", scene::test::example().dump());
  save("batch", "failure",
       R"({"schema": "gonio.failure/1", "input": {"path": "a path of more than sixteen bytes"},)"
       R"( "status": "bad_input", "exit_code": 3, "message": "m", "batch": {"made_with": "w"}})");
  save(
      "batch", "fit",
      R"({"schema": "gonio.fit/1", "model": "lambert", "channels": ["f"], "warnings": [],)"
      R"( "parameters": {"kd": {"value": 1, "std_error": null, "status": "free", "limit": null}},)"
      R"( "cost": 1, "residuals": {"rms": 1, "log_rms": 1}, "misfit": {"size": 1, "told": false},)"
      R"( "solver": {"termination": "converged", "message": "m", "time_ms": {}},)"
      R"( "input": {"path": "p", "sha256": "s", "values_used": 1, "masked": {}},)"
      R"( "batch": {"made_with": "w", "preview": {"thumbnail": null, "albedo": [1], "sphere": ""}}})");
  save(
      "choice", "whole",
      R"({"schema": "gonio.choice/1", "model": "lambert+coat:ggx/smith_ggx.correlated/schlick",)"
      R"( "coating": "view", "reference": "lambert", "domain": {"roughness": [0.1, 1], "metal": "Au",)"
      R"( "fits": ["f"]}, "budgets": {"albedo_error": 0.1, "delta_e_2000": {"limit": 1}}})");
#ifdef GONIO_SHADERS
  const std::string body =
      "float f(vec3 L, vec3 V, vec3 N, float a) { float s = 0.0; for (int i = 0; i < 3; ++i) { if "
      "(dot(L, N) < a) break; s += a * L[i]; } return s > 0.5 ? s : sqrt(s); }\n";
  const auto words = foreign::compile(foreign::source_of("my.glsl", body));
  save("spirv", "loop", {reinterpret_cast<const char*>(words.data()), words.size() * 4});
  save("brdf", "whole",
       "analytic\n::begin parameters\nfloat a 0 1 0.5\nbool b 1\ncolor c 1 1 1\n::end "
       "parameters\n::begin shader\n" +
           body + "::end shader\n");
#endif
  const auto lit = scene::test::sphere(scene::test::car_paint(), scene::test::front());
  save(
      "plan", "whole",
      to_json(plan_scene(lit, {.samples = 256, .fresh = 16'384, .cost = scene::Cost::operations})));
  return 0;
}
