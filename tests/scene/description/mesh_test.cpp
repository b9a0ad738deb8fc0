#include "scene/description/mesh.h"

#include <cmath>

#include "refusal.h"
#include "scene/description/gltf_example.h"
#include "scene/description/gltf_file.h"
#include "support.h"

namespace gonio::scene {
namespace {

using gonio::test::Folder;
using gonio::test::refusal;
using namespace test;

/// Mesh "square" where a node is named, else in its own coordinates.
Mesh read_mesh_of(const Json& document, const std::string& node = "", MeshBudget budget = {}) {
  const Folder folder;
  const GltfFile file(folder.write("a.gltf", document.dump()));
  return node.empty() ? read_mesh(file, "square", budget) : read_mesh_of_node(file, node, budget);
}
std::string complaint_of_mesh(const Json& document,
                              const std::string& node = "",
                              MeshBudget budget = {}) {
  const std::string line = refusal([&] { read_mesh_of(document, node, budget); });
  return line.substr(std::min(line.size(), line.find("a.gltf")));
}
std::string complaint_at(const std::string& pointer,
                         const Json& value,
                         const std::string& node = "") {
  return complaint_of_mesh(with(square_gltf(), pointer, value), node);
}

template <std::size_t n>
void expect_near(const std::array<float, n>& a, const std::array<float, n>& b) {
  for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(a[i], b[i], 1e-6F) << i;
}

TEST(Mesh, HasPositionsUnitNormalsTangentsAndTriangles) {
  const Mesh m = read_mesh_of(square_gltf());
  ASSERT_EQ(m.positions.size(), 4U);
  ASSERT_EQ(m.normals.size(), 4U);
  ASSERT_EQ(m.tangents.size(), 4U);
  ASSERT_EQ(m.triangles.size(), 2U);
  EXPECT_EQ(m.positions[2], (std::array{1.0F, 1.0F, 0.0F}));
  EXPECT_EQ(m.normals[2], (std::array{0.0F, 0.0F, 1.0F}));
  EXPECT_EQ(m.tangents[2], (std::array{1.0F, 0.0F, 0.0F, 1.0F}));
  EXPECT_EQ(m.triangles[1], (std::array{0U, 2U, 3U}));
}

TEST(Mesh, OfANodeIsMovedByItAndThoseAboveIt) {
  const Mesh m = read_mesh_of(square_gltf(), "placed");
  expect_near(m.positions[1], {10, 2, 0});  // turned, then scaled, then shifted
  expect_near(m.positions[3], {8, 0, 0});
  expect_near(m.normals[0], {0, 0, 1});
  expect_near(m.tangents[0], {0, 1, 0, 1});
  const Mesh same =
      read_mesh_of(with(without(without(square_gltf(), "/nodes/0/scale"), "/nodes/0/translation"),
                        "/nodes/0/matrix", {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 10, 0, 0, 1}),
                   "placed");
  EXPECT_EQ(same.positions, m.positions);
}

/// A slanted plane, x + z = const, that is stretched along x: its normal leans towards z.
TEST(Mesh, HasNormalsThatStayPerpendicularUnderAnyScale) {
  constexpr std::array<float, 9> positions{0, 0, 1, 1, 0, 0, 0, 1, 1};
  constexpr float s = 0.70710678F;
  constexpr std::array<float, 9> normals{s, 0, s, s, 0, s, s, 0, s};
  const std::string bytes = bytes_of(positions) + bytes_of(normals);
  Json g = square_gltf();
  g["buffers"][0] = {{"byteLength", 72}, {"uri", "data:;base64," + base64(bytes)}};
  g["bufferViews"] = {{{"buffer", 0}, {"byteLength", 36}},
                      {{"buffer", 0}, {"byteOffset", 36}, {"byteLength", 36}}};
  g["accessors"][0]["count"] = g["accessors"][1]["count"] = 3;
  g["meshes"][0]["primitives"][0] = {{"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}};
  g["nodes"] = {{{"name", "n"}, {"mesh", 0}, {"scale", {3, 1, 1}}}};
  for (const int sign : {1, -1}) {
    g["nodes"][0]["scale"][0] = 3 * sign;
    const Mesh m = read_mesh_of(g, "n");
    const auto side = static_cast<float>(sign);
    expect_near(m.normals[0], {side / std::sqrt(10.0F), 0, 3 / std::sqrt(10.0F)});
    // Seen from where the normals point to, the corners go round counter-clockwise, mirrored or
    // not.
    const auto& [a, b, c] = m.triangles[0];
    const auto at = [&](std::uint32_t i, std::size_t k) {
      return m.positions[i][k] - m.positions[a][k];
    };
    EXPECT_GT(at(b, 0) * at(c, 1) - at(b, 1) * at(c, 0), 0) << "z of their product";
  }
}

TEST(Mesh, WithoutNormalsIsFlatAndLosesTrianglesWithoutArea) {
  Json g = without(square_gltf(), "/meshes/0/primitives/0/attributes/NORMAL");
  Mesh m = read_mesh_of(g);
  ASSERT_EQ(m.triangles.size(), 2U);
  ASSERT_EQ(m.positions.size(), 6U);
  EXPECT_TRUE(m.tangents.empty());
  for (const auto& n : m.normals) EXPECT_EQ(n, (std::array{0.0F, 0.0F, 1.0F}));
  std::string bytes = square_bytes();
  bytes[160 + 2] = 0;  // the first triangle is 0, 0, 2
  m = read_mesh_of(with(g, "/buffers/0/uri", "data:;base64," + base64(bytes)));
  ASSERT_EQ(m.triangles.size(), 1U);
  EXPECT_EQ(m.positions[2], (std::array{0.0F, 1.0F, 0.0F}));
}

TEST(Mesh, OfSeveralPrimitivesHasAllOfThem) {
  Json g = square_gltf();
  g["meshes"][0]["primitives"].push_back(g["meshes"][0]["primitives"][0]);
  Mesh m = read_mesh_of(g);
  EXPECT_EQ(m.tangents.size(), 8U);
  ASSERT_EQ(m.triangles.size(), 4U);
  EXPECT_EQ(m.triangles[3], (std::array{4U, 6U, 7U}));
  for (const std::size_t lacks : {0U, 1U}) {
    Json one = g;
    one["meshes"][0]["primitives"][lacks]["attributes"].erase("TANGENT");
    EXPECT_TRUE(read_mesh_of(one).tangents.empty()) << "all have them, or none";
  }
}

TEST(Mesh, RefusesIndicesOfVerticesThatThereAreNot) {
  std::string bytes = square_bytes();
  bytes[160 + 6] = 4;
  EXPECT_EQ(complaint_at("/buffers/0/uri", "data:;base64," + base64(bytes)),
            "a.gltf: /accessors/3: found 4 in element 3, expected vertices below 4");
}

TEST(Mesh, RefusesWhatIsNoTriangles) {
  EXPECT_EQ(complaint_at("/meshes/0/primitives/0/mode", 1),
            "a.gltf: /meshes/0/primitives/0/mode: found 1, expected 4, triangles");
  EXPECT_EQ(complaint_at("/accessors/3/count", 5),
            "a.gltf: /accessors/3: found 5 indices, expected three for each triangle");
  EXPECT_EQ(complaint_of_mesh(without(square_gltf(), "/meshes/0/primitives/0/indices")),
            "a.gltf: /meshes/0/primitives/0: found 4 vertices, expected three for each triangle");
  EXPECT_EQ(complaint_at("/accessors/1/count", 3),
            "a.gltf: /accessors/1/count: found 3, expected that of the positions, 4");
  EXPECT_EQ(complaint_at("/meshes/0/primitives", Json::array()),
            "a.gltf: /meshes/0: found no triangle that has an area, expected one at least");
  EXPECT_EQ(complaint_of_mesh(without(square_gltf(), "/meshes/0/primitives/0/attributes/POSITION")),
            "a.gltf: /meshes/0/primitives/0/attributes/POSITION: found nothing, expected a value");
}

TEST(Mesh, RefusesNormalsWithoutALength) {
  std::string bytes = square_bytes();
  std::fill_n(bytes.begin() + 48 + 24, 12, '\0');
  EXPECT_EQ(complaint_at("/buffers/0/uri", "data:;base64," + base64(bytes)),
            "a.gltf: /accessors/1: found no length in element 2, expected vectors of length 1");
}

TEST(Mesh, RefusesNodesThatFlattenOrLeadOutOfTheWorld) {
  EXPECT_EQ(complaint_at("/nodes/0/scale", {1, 0, 1}, "placed"),
            "a.gltf: /nodes/1: found a scale that leaves no normal, expected one that is not 0");
  EXPECT_EQ(complaint_at("/nodes/0/translation", {1e9, 1e9, 0}, "placed"),
            "a.gltf: /nodes/1: found a vertex out of the world, expected at most 1e+09 m from its "
            "centre");
  EXPECT_EQ(complaint_at("/nodes/1/rotation", {1, 1, 0, 0}, "placed"),
            "a.gltf: /nodes/1/rotation: found an array, expected a quaternion of length 1");
  EXPECT_EQ(
      complaint_at("/nodes/0/matrix", {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, "placed"),
      "a.gltf: /nodes/0/matrix: found an array, expected one whose last row is 0, 0, 0, 1");
  EXPECT_EQ(complaint_of_mesh(square_gltf(), "top"),
            "a.gltf: /nodes/0/mesh: found nothing, expected a value");
  EXPECT_EQ(complaint_at("/nodes/1/children", {0}, "placed"),
            "a.gltf: /nodes/0: found a node below itself, expected nodes that are a tree");
}

TEST(Mesh, RefusesNodesThatNestTooDeep) {
  Json g = square_gltf();
  g["nodes"] = Json::array();
  for (int i = 0; i < 1000; ++i) g["nodes"].push_back({{"children", {i + 1}}});
  g["nodes"].push_back({{"name", "n"}, {"mesh", 0}});
  EXPECT_EQ(complaint_of_mesh(g, "n"),
            "a.gltf: /nodes/1000: found more than 1000 levels of nodes, expected fewer");
  g["nodes"][0].erase("children");
  EXPECT_EQ(complaint_of_mesh(g, "n"), "");
}

TEST(Mesh, KeepsToTheBudgetOfAScene) {
  const std::string at_most =
      ", expected at most 4194304 vertices and 8388608 triangles in a scene";
  EXPECT_EQ(complaint_of_mesh(square_gltf(), "", {4, 2}), "");
  EXPECT_EQ(complaint_of_mesh(square_gltf(), "", {3, 2}),
            "a.gltf: /accessors/0/count: found 4, expected a number in [1, 3]");
  EXPECT_EQ(complaint_of_mesh(square_gltf(), "", {4, 1}),
            "a.gltf: /accessors/3/count: found 6, expected a number in [1, 3]");
  EXPECT_EQ(complaint_of_mesh(square_gltf(), "", {2, 2}),
            "a.gltf: /meshes/0/primitives/0: found more triangles" + at_most);
  // What has no area is read, too.
  Json flat = without(square_gltf(), "/meshes/0/primitives/0/attributes/NORMAL");
  const auto primitive = flat["meshes"][0]["primitives"][0];
  for (int i = 0; i < 3; ++i) flat["meshes"][0]["primitives"].push_back(primitive);
  EXPECT_EQ(complaint_of_mesh(flat, "", {18, 100}),
            "a.gltf: /meshes/0/primitives/3: found more triangles" + at_most);
}

TEST(Mesh, OfTheClearCoatTestStandsWhereItsNodesPutIt) {
  GONIO_NEEDS_SHARED(path, "data/gltf/ClearCoatTest/ClearCoatTest.gltf");
  const GltfFile file(path);
  MeshBudget budget;
  const Mesh m = read_mesh_of_node(file, "BaseLayerSample", budget);
  EXPECT_EQ(m.positions.size(), 1113U);
  EXPECT_EQ(m.triangles.size(), 2060U);
  EXPECT_EQ(budget.vertices, MeshBudget{}.vertices - 1113);
  for (const auto& p : m.positions) {
    EXPECT_GE(p[0], -3.1001F);
    EXPECT_LE(p[0], -1.0999F);
    EXPECT_GE(p[1], 4.2499F);
    EXPECT_LE(p[1], 6.2501F);
  }
}

TEST(Mesh, IsRefusedWhereManyTrianglesLieOnOneAnother) {
  Json document = square_gltf();
  auto& primitives = document["meshes"][0]["primitives"];
  const Json one = primitives[0];
  while (primitives.size() < 64) primitives.push_back(one);
  EXPECT_EQ(complaint_of_mesh(document), "");
  primitives.push_back(one);
  EXPECT_HAS(complaint_of_mesh(document), "more than 64 triangles on the same points");
}

TEST(MeshBudget, GivesEachObjectThatHasAMeshItsOwn) {
  const Mesh square = read_mesh_of(square_gltf());
  const Json object;
  const std::string file = "s.json";
  const JsonReader at(file, object, "/objects/1", Places::pointer);
  MeshBudget budget{8, 5};
  EXPECT_EQ(refusal([&] { budget.take(square, at); }), "");
  EXPECT_EQ(budget.vertices, 4U);
  EXPECT_EQ(budget.triangles, 3U);
  budget.take(square, at);
  EXPECT_HAS(refusal([&] { budget.take(square, at); }), "s.json: /objects/1: found more triangles");
}

}  // namespace
}  // namespace gonio::scene
