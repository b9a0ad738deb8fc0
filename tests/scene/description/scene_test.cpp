#include "scene/description/scene.h"

#include <cmath>
#include <filesystem>

#include "base/sha256.h"
#include "image/exr.h"
#include "refusal.h"
#include "scene/description/gltf_example.h"
#include "scene/description/scene_example.h"
#include "support.h"

namespace gonio::scene {
namespace {

using gonio::test::Folder;
using gonio::test::refusal;
using namespace test;

Scene read(const Json& document) {
  const Folder folder;
  return read_scene(folder.write("s.json", document.dump()));
}
/// The line from the file's name on.
std::string line_of(const Folder& folder, const std::string& bytes) {
  const std::string path = folder.write("s.json", bytes);
  const std::string line = refusal([&] { read_scene(path); });
  const auto slash = line.find(folder / "");
  return slash == line.npos ? line : line.substr(slash + (folder / "").size());
}
std::string complaint(const Json& document) {
  const Folder folder;
  return line_of(folder, document.dump());
}
std::string complaint(const std::string& pointer, const Json& value) {
  return complaint(with(example(), pointer, value));
}

void write_environment(const std::string& path, float value) {
  Image i;
  i.width = 8;
  i.height = 4;
  i.channels = {"B", "G", "R"};
  for (int c = 0; c < 3; ++c) i.planes.push_back(std::vector<float>(32, value));
  i.planes[2][8 + 2] = 2 * value;  // red, 0° to 45° high, 45° to 90° left of the middle
  write_exr(path, i);
}

TEST(Scene, HasWhatItsFileSays) {
  const Scene s = read(example());
  ASSERT_EQ(s.materials.size(), 3U);
  EXPECT_EQ(s.materials[0].name, "satin gold");
  EXPECT_EQ(std::get<FromSpec>(s.materials[0].from).model, "gltf");
  const auto& gold = std::get<BoundModel>(s.materials[0].is);
  EXPECT_EQ(gold.model.channels, 3U);
  EXPECT_EQ(to_text(gold.model.spec), "lambert.coupled+ggx/smith_ggx.separable/schlick");
  EXPECT_EQ(gold.values[gold.model.find("f0")->slot(1)], 0.71);
  EXPECT_DOUBLE_EQ(gold.values[gold.model.find("alpha")->first], 0.45 * 0.45);
  const auto& foil = std::get<BoundModel>(s.materials[2].is);
  EXPECT_GT(foil.values[foil.model.find("k")->slot(0)], 6) << "aluminium";

  ASSERT_EQ(s.objects.size(), 3U);
  EXPECT_EQ(s.objects[0].material, 1U);
  EXPECT_EQ(std::get<Sphere>(s.objects[0].shape).radius, 1);
  EXPECT_EQ(s.objects[1].material, 0U);
  EXPECT_EQ(std::get<Sphere>(s.objects[1].shape).center.y, 2);
  EXPECT_EQ(std::get<Sphere>(s.objects[1].shape).radius, 0.5);

  ASSERT_EQ(s.lights.size(), 3U);
  const auto& fixed = std::get<DirectionalLight>(s.lights[0]);
  EXPECT_EQ(std::get<DirectionalLight::Fixed>(fixed.from).direction.z, -1);
  EXPECT_EQ(fixed.irradiance, (Rgb{3, 2, 1}));
  const auto& ranging = std::get<DirectionalLight>(s.lights[1]);
  EXPECT_EQ(std::get<DirectionalLight::Ranging>(ranging.from).range.elevation_deg[1], 80);
  EXPECT_EQ(std::get<RectangleLight>(s.lights[2]).v.z, 2);

  const auto& orbit = std::get<Orbit>(s.view);
  EXPECT_EQ(orbit.target.y, 1);
  EXPECT_EQ(orbit.distance, 10);
  EXPECT_EQ(orbit.from.azimuth_deg[1], 360);
  EXPECT_EQ(s.exposure, 0.5);
  EXPECT_EQ(s.tolerance.quantile, 0.95);
  EXPECT_EQ(s.tolerance.max, 3);
  EXPECT_EQ(s.tolerance.confidence, 0.9);
  EXPECT_EQ(s.budget_ns, 40);
  EXPECT_EQ(s.seed, 7U);
}

TEST(Scene, OfTheKeysThatItNeedsHasDefaultsForTheOthers) {
  Json least = example();
  for (const char* key : {"/exposure", "/tolerance", "/budget_ns", "/seed"})
    least = without(least, key);
  least["view"] = {{"position", {0, 0, 5}}, {"target", {0, 0, 0}}};
  const Scene s = read(least);
  EXPECT_EQ(s.exposure, 1);
  EXPECT_EQ(s.tolerance.metric, Metric::delta_e_2000);
  EXPECT_EQ(s.tolerance.limit, 1);
  EXPECT_EQ(s.tolerance.max, 4);
  EXPECT_FALSE(s.budget_ns);
  EXPECT_EQ(std::get<Camera>(s.view).up.y, 1);
}

TEST(Scene, TakesMaterialsOfFitsAndOfGltfFilesBesideIt) {
  const Folder folder;
  std::filesystem::create_directory(folder / "assets");
  folder.write("assets/square.gltf", square_gltf().dump());
  folder.write(
      "fit.json",
      R"({"schema": "gonio.fit/1", "model": "lambert", "parameters": {"kd": {"value": [0.1, 0.2, 0.3]}}})");
  Json d = example();
  d["materials"] = {{"fitted", {{"fit", "fit.json"}}},
                    {"coated", {{"gltf", "assets/square.gltf"}, {"material", "coated"}}}};
  d["objects"] = Json::parse(R"([
    {"shape": "mesh", "gltf": "assets/square.gltf", "node": "placed", "material": "coated"},
    {"shape": "mesh", "gltf": "assets/square.gltf", "mesh": "square", "material": "fitted"},
    {"shape": "mesh", "gltf": "assets/square.gltf", "node": "placed", "material": "fitted"}])");
  const Scene s = read_scene(folder.write("s.json", d.dump()));
  EXPECT_EQ(std::get<FromFit>(s.materials[0].from).path, "fit.json");
  EXPECT_EQ(std::get<BoundModel>(s.materials[0].is).values, (std::vector{0.1, 0.2, 0.3}));
  EXPECT_EQ(std::get<GltfMaterial>(s.materials[1].is).clearcoat_roughness, 0.25);
  const auto mesh = [&](std::size_t i) { return std::get<MeshShape>(s.objects[i].shape).mesh; };
  EXPECT_NEAR(mesh(0)->positions[1][0], 10, 1e-6);
  EXPECT_EQ(mesh(1)->positions[1][0], 1);
  EXPECT_EQ(mesh(2), mesh(0)) << "read once";
  EXPECT_EQ(s.objects[2].material, 0U);
}

TEST(Scene, HasItsEnvironmentUpright) {
  const Folder folder;
  write_environment(folder / "e.exr", 1);
  const Scene s = read_scene(folder.write(
      "s.json", with(example(), "/lights",
                     Json::parse(R"([{"type": "environment", "path": "e.exr", "scale": 3}])"))
                    .dump()));
  const auto& light = std::get<EnvironmentLight>(s.lights[0]);
  EXPECT_EQ(light.radiance({0.8, 0.2, 0.3}), (Rgb{6, 3, 3})) << "left of the middle, +z, is +x";
  for (const Direction& other : {Direction{0.3, 0.2, 0.8},
                                 {0.8, 0.9, 0.3},
                                 {0.8, -0.2, 0.3},
                                 {-0.8, 0.2, 0.3},
                                 {0.8, 0.2, -0.3}})
    EXPECT_EQ(light.radiance(other), (Rgb{3, 3, 3}));
}

TEST(Scene, MeasuresAnglesFromTheHorizonAndFromZTowardsX) {
  const auto expect = [](const Direction& d, double x, double y, double z) {
    EXPECT_NEAR(d.x, x, 1e-15);
    EXPECT_NEAR(d.y, y, 1e-15);
    EXPECT_NEAR(d.z, z, 1e-15);
  };
  expect(direction_of(0, 0), 0, 0, 1);
  expect(direction_of(0, 90), 1, 0, 0);
  expect(direction_of(90, 17), 0, 1, 0);
  expect(direction_of(-30, 180), 0, -0.5, -std::sqrt(0.75));
}

// --- Its name ---

TEST(SceneDigest, IsThatOfTheListOfItsFilesDigests) {
  const Folder folder;
  const std::string bytes = example().dump();
  EXPECT_EQ(read_scene(folder.write("s.json", bytes)).sha256, sha256(sha256(bytes) + "\n"));
}

TEST(SceneDigest, ChangesWithEveryFileThatIsReadAndWithNoOther) {
  const Folder folder;
  write_environment(folder / "e.exr", 1);
  Json gltf = square_gltf();
  gltf["buffers"][0]["uri"] = "square.bin";
  folder.write("a.gltf", gltf.dump());
  folder.write("square.bin", square_bytes());
  const std::string fit =
      R"({"schema": "gonio.fit/1", "model": "lambert", "parameters": {"kd": {"value": 0.1}}})";
  folder.write("fit.json", fit);
  folder.write("other.txt", "1");
  Json d = example();
  d["materials"]["fitted"] = {{"fit", "fit.json"}};
  d["objects"].push_back(
      {{"shape", "mesh"}, {"gltf", "a.gltf"}, {"mesh", "square"}, {"material", "fitted"}});
  d["lights"].push_back({{"type", "environment"}, {"path", "e.exr"}});
  const std::string path = folder.write("s.json", d.dump());
  const std::string before = read_scene(path).sha256;
  EXPECT_EQ(before.size(), 64U);
  folder.write("other.txt", "2");
  EXPECT_EQ(read_scene(path).sha256, before);

  std::vector<std::string> all{before};
  const auto changed = [&](const std::string& name, const std::string& bytes) {
    const std::string old = gonio::test::read_bytes(folder / name);
    folder.write(name, bytes);
    all.push_back(read_scene(path).sha256);
    folder.write(name, old);
    EXPECT_EQ(read_scene(path).sha256, before);
  };
  changed("s.json", with(d, "/seed", 8).dump());
  changed("fit.json", fit + " ");
  changed("a.gltf", with(gltf, "/materials/0/name", "x").dump());
  std::string moved = square_bytes();
  moved[4] = 1;  // y of the first vertex
  changed("square.bin", moved);
  write_environment(folder / "f.exr", 2);
  changed("e.exr", gonio::test::read_bytes(folder / "f.exr"));
  std::ranges::sort(all);
  EXPECT_EQ(std::ranges::adjacent_find(all), all.end());
}

TEST(SceneDigest, StaysWhereTheWholeSceneIsMoved) {
  const auto digest = [](const std::string& name) {
    const Folder folder;
    std::filesystem::create_directory(folder / name);
    folder.write(name + "/a.gltf", square_gltf().dump());
    Json d = example();
    d["materials"]["coated"] = {{"gltf", "a.gltf"}, {"material", "coated"}};
    return read_scene(folder.write(name + "/s.json", d.dump())).sha256;
  };
  EXPECT_EQ(digest("here"), digest("there"));
}

// --- What is refused ---

TEST(SceneErrors, NameThePlaceOfValuesThatAreWrong) {
  EXPECT_EQ(complaint("/schema", "gonio.scene/2"),
            "s.json: /schema: found \"gonio.scene/2\", expected gonio.scene/1");
  EXPECT_EQ(complaint("/exposre", 1),
            "s.json: /exposre: found 1, expected no such key; nearest: exposure, of schema, "
            "materials, objects, lights, "
            "view, exposure, tolerance, "
            "budget_ns or seed");
  EXPECT_EQ(complaint("/exposure", 0),
            "s.json: /exposure: found 0, expected a number in (0, 1e+12]");
  EXPECT_EQ(complaint("/budget_ns", -1),
            "s.json: /budget_ns: found -1, expected a number in (0, 1e+12]");
  EXPECT_EQ(complaint("/seed", 1.5), "s.json: /seed: found 1.5, expected a whole number");
  EXPECT_EQ(complaint("/materials/chalk", Json{{"spec", "lambert"}}),
            "s.json: /materials/chalk: found none of its keys, expected one of model, fit or gltf");
  EXPECT_EQ(complaint("/materials/chalk/fit", "a"),
            "s.json: /materials/chalk: found model and fit, expected one of model, fit or gltf");
  EXPECT_EQ(
      complaint("/lights/0/type", "point"),
      "s.json: /lights/0/type: found \"point\", expected directional, rectangle or environment");
  EXPECT_EQ(complaint("/lights/0/irradiance/1", nullptr),
            "s.json: /lights/0/irradiance/1: found null, expected a number in [0, 1e+12]");
  EXPECT_EQ(
      complaint("/lights/0/irradiance/1", 2e12),
      "s.json: /lights/0/irradiance/1: found 2000000000000.0, expected a number in [0, 1e+12]");
  EXPECT_EQ(complaint("/lights/2/radiance", 5),
            "s.json: /lights/2/radiance: found 5, expected an array of 3");
  EXPECT_EQ(complaint("/objects/1/radius", 0),
            "s.json: /objects/1/radius: found 0, expected a number in (0, 1e+09]");
  EXPECT_EQ(complaint("/objects/1/shape", "cube"),
            "s.json: /objects/1/shape: found \"cube\", expected sphere or mesh");
  EXPECT_EQ(complaint("/tolerance/quantile", 1),
            "s.json: /tolerance/quantile: found 1, expected a number in (0, 1)");
  EXPECT_EQ(complaint("/tolerance/metric", "dE"),
            "s.json: /tolerance/metric: found \"dE\", expected delta_e_2000 or relative");
}

TEST(SceneErrors, NameValuesThatDoNotFitEachOther) {
  EXPECT_EQ(complaint("/tolerance/max", 0.5),
            "s.json: /tolerance/max: found 0.5, expected a number from limit on");
  EXPECT_EQ(complaint("/lights/0/direction", {0, 0, 0}),
            "s.json: /lights/0/direction: found an array, expected a vector that is not 0");
  EXPECT_EQ(
      complaint("/lights/2/v", {1, 0, 0}),
      "s.json: /lights/2/v: found an array, expected a vector perpendicular to u that is not 0");
  EXPECT_EQ(complaint("/lights/2/u", {0, 0, 0}),
            "s.json: /lights/2/u: found an array, expected a vector that is not 0");
  EXPECT_EQ(complaint("/view/orbit/elevation_deg", {30, 0}),
            "s.json: /view/orbit/elevation_deg: found an array, expected [low, high]");
  EXPECT_EQ(complaint("/lights/1/direction_range/azimuth_deg", {-200, 200}),
            "s.json: /lights/1/direction_range/azimuth_deg: found an array, expected [low, high], "
            "a circle at most");
  const Json camera{{"position", {0, 0, 5}}, {"target", {0, 0, 0}}};
  EXPECT_EQ(complaint("/view", with(camera, "/target", {0, 0, 5})),
            "s.json: /view/target: found an array, expected a place other than the camera's");
  EXPECT_EQ(
      complaint("/view", with(camera, "/up", {0, 0, 1})),
      "s.json: /view/up: found an array, expected a vector that is not 0 and not along the view");
  EXPECT_EQ(
      complaint("/view", with(camera, "/target", {0, 7, 5})),
      "s.json: /view: found an object, expected a vector that is not 0 and not along the view");
}

TEST(SceneErrors, NameWhatAModelDoesNotTake) {
  EXPECT_EQ(complaint("/materials/chalk/model", "lambrt"),
            "s.json: /materials/chalk/model: found \"lambrt\", expected a model (no diffuse term "
            "'lambrt'; nearest: lambert, hammon, disney)");
  EXPECT_EQ(complaint("/materials/chalk/parameters/alpha", 0.1),
            "s.json: /materials/chalk/parameters: found an object, expected parameters of the "
            "model (model 'lambert' has no "
            "parameter 'alpha'; it has: kd)");
  EXPECT_HAS(complaint("/materials/chalk/parameters/kd", -1),
             "s.json: /materials/chalk/parameters: found an object");
  EXPECT_HAS(complaint("/materials/chalk/parameters/kd", {1, 1}),
             "kd: 2 values where one or 3 fit");
  EXPECT_EQ(
      complaint("/materials/chalk/parameters/kd", {1, 1, 1, 1}),
      "s.json: /materials/chalk/parameters/kd: found an array of 4, expected an array of 1 to 3");
  EXPECT_EQ(complaint("/materials/chalk/parameters/kd", "white"),
            "s.json: /materials/chalk/parameters/kd: found \"white\", expected a number, or one "
            "per channel");
  EXPECT_EQ(complaint("/materials/foil/parameters/metal", 3),
            "s.json: /materials/foil/parameters/metal: found 3, expected a metal's symbol");
  EXPECT_HAS(complaint("/materials/foil/parameters/metal", "Xx"), "no metal 'Xx'");
}

TEST(SceneErrors, NameMaterialsThatThereAreNot) {
  EXPECT_EQ(complaint("/objects/1/material", "chlk"),
            "s.json: /objects/1/material: found \"chlk\", expected one of the materials; nearest: "
            "chalk, foil, satin gold");
}

TEST(SceneErrors, RefuseAnEmptySceneAndOneInTheDark) {
  EXPECT_EQ(complaint("/materials", Json::object()),
            "s.json: /materials: found an object of 0, expected an object of 1 to 1000");
  EXPECT_EQ(complaint("/objects", Json::array()),
            "s.json: /objects: found an array of 0, expected an array of 1 to 10000");
  EXPECT_EQ(complaint("/lights", Json::array()),
            "s.json: /lights: found an array of 0, expected an array of 1 to 1000");
  Json dark = with(example(), "/lights/0/irradiance", {0, 0, 0});
  dark["lights"].erase(1);
  dark["lights"].erase(1);
  EXPECT_EQ(complaint(dark), "s.json: /lights: found only black lights, expected one that shines");
  for (const char* key : {"schema", "materials", "objects", "lights", "view"})
    EXPECT_EQ(complaint(without(example(), std::string("/") + key)),
              "s.json: /" + std::string(key) + ": found nothing, expected a value");
}

TEST(SceneErrors, NameFilesThatAreNotThereOrNotWhatTheyShouldBe) {
  const Folder folder;
  const auto of = [&](const std::string& pointer, const Json& value) {
    return line_of(folder, with(example(), pointer, value).dump());
  };
  const std::string none = ": opening: found No such file or directory, expected a readable file";
  EXPECT_EQ(of("/materials/chalk", {{"fit", "f.json"}}), "f.json" + none);
  EXPECT_EQ(of("/materials/chalk", {{"gltf", "g.gltf"}, {"material", "m"}}), "g.gltf" + none);
  EXPECT_EQ(of("/lights/0", {{"type", "environment"}, {"path", "e.exr"}}), "e.exr" + none);
  EXPECT_EQ(of("/objects/0",
               {{"shape", "mesh"}, {"gltf", "g.gltf"}, {"node", "n"}, {"material", "foil"}}),
            "g.gltf" + none);

  folder.write(
      "f.json",
      R"({"schema": "gonio.fit/1", "model": "lambert", "parameters": {"kd": {"value": [1, 1]}}})");
  EXPECT_EQ(of("/materials/chalk", {{"fit", "f.json"}}),
            "f.json: model and parameters: found kd: 2 values where one or 3 fit, expected a model "
            "of 3 channels");
  write_environment(folder / "e.exr", std::numeric_limits<float>::infinity());
  EXPECT_EQ(of("/lights/0", {{"type", "environment"}, {"path", "e.exr"}}),
            "e.exr: pixel (0, 0): found R = inf, expected radiance, a finite number");
  write_environment(folder / "e.exr", 1);
  const Json light{{"type", "environment"}, {"path", "e.exr"}};
  EXPECT_EQ(of("/lights", {light, light}),
            "s.json: /lights/1: found a second environment, expected one at most");
  write_environment(folder / "e.exr", 0);
  EXPECT_EQ(of("/lights", Json::array({light})),
            "s.json: /lights: found only black lights, expected one that shines");
}

TEST(SceneErrors, RefuseWhatIsNoJsonOrNestsTooDeep) {
  const Folder folder;
  EXPECT_EQ(line_of(folder, "{\"schema\": NaN}"),
            "s.json: line 1, column 12: found NaN}, expected JSON");
  EXPECT_HAS(line_of(folder, "{\"exposure\": 1e999}"), "found 1e999");
  EXPECT_EQ(line_of(folder, std::string(100, '[')),
            "s.json: line 1, column 65: found 65 levels of brackets, expected at most 64");
  EXPECT_EQ(line_of(folder, "[]"),
            "s.json: the document: found an empty array, expected an object");
  EXPECT_EQ(line_of(folder, ""), "s.json: byte 0: found an empty file, expected data");
}

TEST(Scene, OfTheClearCoatTestHasItsSpheres) {
  GONIO_NEEDS_SHARED(shared, "data/gltf/ClearCoatTest/ClearCoatTest.gltf");
  const Folder folder;
  for (const char* name : {"ClearCoatTest.gltf", "ClearCoatTest.bin"})
    std::filesystem::copy(std::filesystem::path(shared).parent_path() / name, folder / name);
  const std::string path = "ClearCoatTest.gltf";
  Json d = example();
  d["materials"] = {{"base", {{"gltf", path}, {"material", "Simple_Base"}}},
                    {"coated", {{"gltf", path}, {"material", "Simple_Coated"}}}};
  d["objects"] = {
      {{"shape", "mesh"}, {"gltf", path}, {"node", "BaseLayerSample"}, {"material", "base"}},
      {{"shape", "mesh"}, {"gltf", path}, {"node", "ClearCoatSample"}, {"material", "coated"}}};
  const Scene s = read_scene(folder.write("s.json", d.dump()));
  EXPECT_EQ(std::get<GltfMaterial>(s.materials[1].is).clearcoat, 1);
  EXPECT_EQ(std::get<MeshShape>(s.objects[1].shape).mesh->triangles.size(), 2060U);
}

/// The tracer has the triangles of each object: without a limit a small file has a thousand million.
TEST(SceneErrors, RefuseAMeshThatIsNamedTooOften) {
  const Folder folder;
  std::string corners;
  for (int z = 0; z < 150; ++z) {
    const auto h = static_cast<float>(z);
    corners += bytes_of(std::array<float, 9>{0, 0, h, 1, 0, h, 0, 1, h});
  }
  Json mesh = square_gltf();
  mesh["buffers"][0] = {{"byteLength", corners.size()},
                        {"uri", "data:;base64," + gonio::base64(corners)}};
  mesh["bufferViews"][0] = {{"buffer", 0}, {"byteLength", corners.size()}};
  mesh["accessors"][0]["count"] = 450;
  mesh["meshes"][0]["primitives"] = {{{"attributes", {{"POSITION", 0}}}}};
  folder.write("a.gltf", mesh.dump());
  Json d = example();
  d["objects"] = Json::array();
  const auto name_it = [&](std::size_t times) {
    while (d["objects"].size() < times)
      d["objects"].push_back(
          {{"shape", "mesh"}, {"gltf", "a.gltf"}, {"mesh", "square"}, {"material", "chalk"}});
    return line_of(folder, d.dump());
  };
  EXPECT_EQ(name_it(9320), "") << "4,194,000 vertices";
  EXPECT_EQ(name_it(9321),
            "s.json: /objects/9320: found more triangles, expected at most 4194304 vertices and "
            "8388608 triangles in a scene");
}

TEST(SceneErrors, RefuseGltfFilesWhoseValuesTakeTooMuchTogether) {
  const Folder folder;
  std::string extras = "[[]";
  for (int i = 0; i < 3'000'000; ++i) extras += ",[]";
  std::string text = square_gltf().dump();
  text.pop_back();
  text += ", \"extras\": " + extras + "]}";
  Json d = example();
  for (int k = 0; k < 2; ++k) {
    const std::string name = std::to_string(k) + ".gltf";
    folder.write(name, text);
    d["materials"][name] = {{"gltf", name}, {"material", "plain"}};
    d["materials"]["again " + name] = {{"gltf", "./" + name}, {"material", "plain"}};
    EXPECT_EQ(
        line_of(folder, d.dump()),
        k == 0 ? "" : "1.gltf: JSON: found more values than 536870912 bytes hold, expected fewer");
  }
}

}  // namespace
}  // namespace gonio::scene
