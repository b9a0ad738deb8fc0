#include "scene/description/gltf_file.h"

#include <filesystem>

#include "refusal.h"
#include "scene/description/gltf_example.h"
#include "support.h"

namespace gonio::scene {
namespace {

using gonio::test::Folder;
using gonio::test::refusal;
using namespace test;

/// The line without the folder's name.
std::string complaint_of_file(const std::string& bytes) {
  const Folder folder;
  const std::string path = folder.write("a.gltf", bytes);
  const std::string line = refusal([&] {
    const GltfFile file(path);
    const JsonReader primitive = file.list("meshes")->at(0).at("primitives").at(0);
    const JsonReader attributes = primitive.at("attributes");
    file.floats(file.entry("accessors", attributes.at("POSITION")), "VEC3", 100);
    file.whole_numbers(file.entry("accessors", primitive.at("indices")), 100);
    file.nodes_above();
  });
  const auto name = line.find("a.gltf");
  return name == line.npos ? line : line.substr(name);
}
std::string complaint_of_file(const Json& document) {
  return complaint_of_file(document.dump());
}
std::string complaint_of_file(const std::string& pointer, const Json& value) {
  return complaint_of_file(with(square_gltf(), pointer, value));
}

TEST(GltfFile, GivesTheElementsOfItsBuffersWhereverTheseLie) {
  const Folder folder;
  Json beside = square_gltf();
  beside["buffers"][0]["uri"] = "a%20buffer.bin";
  folder.write("a buffer.bin", square_bytes());
  for (const auto& [name, bytes] : {std::pair("embedded.gltf", square_gltf().dump()),
                                    {"beside.gltf", beside.dump()},
                                    {"binary.glb", glb(square_gltf(), square_bytes())}}) {
    const GltfFile file(folder.write(name, bytes));
    const auto& accessors = file.list("accessors");
    const auto positions = file.floats(accessors->at(0), "VEC3", 4);
    ASSERT_EQ(positions.size(), 12U) << name;
    EXPECT_EQ(positions[6], 1) << name;
    EXPECT_EQ(file.whole_numbers(accessors->at(3), 6),
              (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}))
        << name;
    EXPECT_EQ(file.digests().size(), std::string(name) == "beside.gltf" ? 2U : 1U);
  }
}

TEST(GltfFile, ReadsElementsAStrideApart) {
  constexpr std::size_t n = 10'000;  // more than a block
  std::string bytes;
  for (std::size_t i = 0; i < n; ++i)
    bytes += bytes_of(std::array{static_cast<float>(i), 0.5F, 0.25F, -1.0F});
  bytes.resize(bytes.size() - 4);  // nothing follows the last
  Json g = square_gltf();
  g["buffers"][0] = {{"byteLength", bytes.size()}, {"uri", "data:;base64," + base64(bytes)}};
  g["bufferViews"][0] = {{"buffer", 0}, {"byteLength", bytes.size()}, {"byteStride", 16}};
  g["accessors"][0]["count"] = n;
  const Folder folder;
  const GltfFile file(folder.write("a.gltf", g.dump()));
  const auto all = file.floats(file.list("accessors")->at(0), "VEC3", n);
  ASSERT_EQ(all.size(), 3 * n);
  for (std::size_t i = 0; i < n; ++i) ASSERT_EQ(all[3 * i], static_cast<float>(i));
  EXPECT_EQ(all.back(), 0.25F);
}

TEST(GltfFile, ReadsIndicesOfEveryWidth) {
  const Folder folder;
  for (const auto& [code, bytes] : {std::pair(5121, std::string("\x01\xff", 2)),
                                    {5123, bytes_of(std::array<std::uint16_t, 2>{1, 0xffff})},
                                    {5125, bytes_of(std::array{1U, 0xffffffffU})}}) {
    Json g = square_gltf();
    g["buffers"][0] = {{"byteLength", bytes.size()}, {"uri", "data:;base64," + base64(bytes)}};
    g["bufferViews"][3] = {{"buffer", 0}, {"byteLength", bytes.size()}};
    g["accessors"][3].update({{"componentType", code}, {"count", 2}});
    const GltfFile file(folder.write("a.gltf", g.dump()));
    const std::uint32_t most = code == 5121 ? 0xff : code == 5123 ? 0xffff : 0xffffffff;
    EXPECT_EQ(file.whole_numbers(file.list("accessors")->at(3), 9),
              (std::vector<std::uint32_t>{1, most}));
  }
}

TEST(GltfFile, RefusesOtherVersionsAndExtensionsThatItNeeds) {
  EXPECT_EQ(complaint_of_file("/asset/version", "1.0"),
            "a.gltf: /asset/version: found \"1.0\", expected 2.0");
  EXPECT_EQ(complaint_of_file("/asset/minVersion", "2.1"),
            "a.gltf: /asset/minVersion: found \"2.1\", expected 2.0");
  EXPECT_EQ(complaint_of_file(Json{{"scenes", Json::array()}}),
            "a.gltf: /asset: found nothing, expected a value");
  EXPECT_EQ(complaint_of_file("/extensionsRequired", {"KHR_materials_ior", "KHR_materials_sheen"}),
            "a.gltf: /extensionsRequired/1: found \"KHR_materials_sheen\", expected an extension "
            "that is read: "
            "KHR_materials_ior, KHR_materials_specular, KHR_materials_clearcoat, "
            "KHR_materials_anisotropy");
  EXPECT_EQ(complaint_of_file("/extensionsRequired", {"KHR_materials_ior"}), "");
}

TEST(GltfFile, RefusesBytesOutsideItsBuffers) {
  EXPECT_EQ(
      complaint_of_file("/buffers/0/byteLength", 173),
      "a.gltf: /buffers/0/byteLength: found 173, expected at most the 172 bytes that there are");
  EXPECT_EQ(complaint_of_file("/buffers/0/byteLength", 47),
            "a.gltf: /bufferViews/0: found 48 bytes from byte 0 on, expected bytes of the buffer, "
            "which has 47");
  EXPECT_EQ(complaint_of_file("/bufferViews/0/byteOffset", 18446744073709551615U),
            "a.gltf: /bufferViews/0: found 48 bytes from byte 18446744073709551615 on, expected "
            "bytes of the buffer, "
            "which has 172");
  EXPECT_EQ(complaint_of_file("/bufferViews/3/byteLength", 11),
            "a.gltf: /accessors/3: found 12 bytes from byte 0 on, expected bytes of its view, "
            "which has 11");
  EXPECT_EQ(complaint_of_file("/accessors/0/byteOffset", 18446744073709551615U),
            "a.gltf: /accessors/0: found 48 bytes from byte 18446744073709551615 on, expected "
            "bytes of its view, which "
            "has 48");
  EXPECT_EQ(complaint_of_file("/bufferViews/0/byteStride", 16),
            "a.gltf: /accessors/0: found 60 bytes from byte 0 on, expected bytes of its view, "
            "which has 48");
  EXPECT_EQ(complaint_of_file("/bufferViews/0/byteStride", 8),
            "a.gltf: /bufferViews/0/byteStride: found 8, expected a number in [12, 252]");
  EXPECT_EQ(complaint_of_file("/bufferViews/0/byteStride", 18446744073709551615U),
            "a.gltf: /bufferViews/0/byteStride: found 18446744073709551615, expected a number in "
            "[12, 252]");
  EXPECT_EQ(complaint_of_file("/accessors/0/count", 101),
            "a.gltf: /accessors/0/count: found 101, expected a number in [1, 100]");
  EXPECT_EQ(complaint_of_file("/accessors/0/count", 0),
            "a.gltf: /accessors/0/count: found 0, expected a number in [1, 100]");
}

TEST(GltfFile, RefusesNumbersOfEntriesThatThereAreNot) {
  EXPECT_EQ(
      complaint_of_file("/accessors/0/bufferView", 4),
      "a.gltf: /accessors/0/bufferView: found 4, expected a number below 4, that of bufferViews");
  EXPECT_EQ(complaint_of_file("/bufferViews/0/buffer", -1),
            "a.gltf: /bufferViews/0/buffer: found -1, expected a whole number");
  EXPECT_EQ(complaint_of_file(without(square_gltf(), "/buffers")),
            "a.gltf: /bufferViews/0/buffer: found 0, expected a number below 0, that of buffers");
  EXPECT_EQ(complaint_of_file("/nodes", 7), "a.gltf: /nodes: found 7, expected an array");
}

TEST(GltfFile, RefusesWhatItDoesNotReadOfAnAccessor) {
  EXPECT_EQ(complaint_of_file("/accessors/0/componentType", 5123),
            "a.gltf: /accessors/0/componentType: found 5123, expected 5126, 32-bit floats");
  EXPECT_EQ(complaint_of_file("/accessors/0/type", "VEC2"),
            "a.gltf: /accessors/0/type: found \"VEC2\", expected VEC3");
  EXPECT_EQ(complaint_of_file("/accessors/3/componentType", 5126),
            "a.gltf: /accessors/3/componentType: found 5126, expected 5121, 5123 or 5125, whole "
            "numbers without sign");
  EXPECT_EQ(complaint_of_file("/accessors/0/sparse", Json::object()),
            "a.gltf: /accessors/0/sparse: found an empty object, expected an accessor that is not "
            "sparse");
}

TEST(GltfFile, RefusesNumbersThatAreNone) {
  std::string bytes = square_bytes();
  const float bad = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(&bytes[28], &bad, 4);
  EXPECT_EQ(complaint_of_file("/buffers/0/uri", "data:;base64," + base64(bytes)),
            "a.gltf: /accessors/0: found nan in element 2, expected finite numbers");
}

TEST(GltfFile, RefusesBuffersThatAreElsewhere) {
  const std::string expected = ", expected a path relative to the file, or data:…;base64,…";
  for (const char* uri :
       {"https://a.org/b.bin", "/etc/passwd", "%2Fetc/passwd", "", "data:,abc", "a%00b"})
    EXPECT_EQ(complaint_of_file("/buffers/0/uri", uri),
              "a.gltf: /buffers/0/uri: found \"" + std::string(uri) + "\"" + expected);
  EXPECT_HAS(complaint_of_file("/buffers/0/uri", "none.bin"),
             "none.bin: opening: found No such file or directory");
  EXPECT_HAS(complaint_of_file("/buffers/0/uri", "."),
             "opening: found a directory, expected a file");
  EXPECT_EQ(complaint_of_file(without(square_gltf(), "/buffers/0/uri")),
            "a.gltf: /buffers/0: found a buffer without a uri, expected one with it: the file has "
            "no chunk for it");
}

TEST(GltfFile, RefusesNodesThatAreNoTree) {
  EXPECT_EQ(complaint_of_file("/nodes/1/children", {0}),
            "a.gltf: /nodes/0: found a node below itself, expected nodes that are a tree");
  EXPECT_EQ(complaint_of_file("/nodes/1/children", {1}),
            "a.gltf: /nodes/1/children/0: found 1, expected a node that is no child of node 0");
  EXPECT_EQ(complaint_of_file("/nodes/0/children", {2}),
            "a.gltf: /nodes/0/children/0: found 2, expected a number below 2, that of nodes");
}

/// In time quadratic in the nodes this takes hours.
TEST(GltfFile, OfAMillionNodesInOneLineTakesLinearTime) {
  constexpr std::size_t n = 1'000'000;
  std::string nodes;
  for (std::size_t i = 1; i < n; ++i) nodes += "{\"children\":[" + std::to_string(i) + "]},";
  const Folder folder;
  const GltfFile file(
      folder.write("a.gltf", R"({"asset":{"version":"2.0"},"nodes":[)" + nodes + "{}]}"));
  EXPECT_EQ(file.nodes_above()[n - 1], n - 2);
}

TEST(GltfFile, FindsEntriesByTheirNames) {
  const Folder folder;
  const GltfFile file(
      folder.write("a.gltf", with(square_gltf(), "/nodes/0/name", "placed").dump()));
  EXPECT_EQ(file.named("materials", "material", "coated"), 1U);
  EXPECT_HAS(refusal([&] { file.named("materials", "material", "caoted"); }),
             "a.gltf: /materials: found no material 'caoted', expected one of that name; nearest: "
             "coated, plain");
  EXPECT_HAS(refusal([&] { file.named("nodes", "node", "placed"); }),
             "a.gltf: /nodes: found 2 times 'placed', expected one node of that name");
}

TEST(GltfFile, KeepsWhatItNamesFromBeingWritten) {
  const Folder folder;
  Json named = square_gltf();
  named["buffers"].push_back({{"byteLength", 4}, {"uri", "not%20read.bin"}});
  named["images"] = {{{"uri", "../picture.png"}}, {{"bufferView", 0}}};
  std::filesystem::create_directory(folder / "d");
  const FileGuard guard;
  const GltfFile file(folder.write("d/a.gltf", named.dump()));
  for (const char* name : {"d/not read.bin", "picture.png"})
    EXPECT_HAS(refusal([&] { OutputFile(folder / name); }, Exit::usage), "is an input");
  EXPECT_EQ(refusal([&] { OutputFile(folder / "d/other.png"); }), "");
}

TEST(GltfFile, RefusesADamagedBinaryFile) {
  const std::string whole = glb(square_gltf(), square_bytes());
  EXPECT_EQ(complaint_of_file(whole), "");
  const auto changed = [&](std::size_t at, std::uint32_t value) {
    std::string bytes = whole;
    std::memcpy(&bytes[at], &value, 4);
    return complaint_of_file(bytes);
  };
  EXPECT_EQ(changed(4, 1), "a.gltf: byte 4: found version 1, expected version 2");
  EXPECT_EQ(changed(8, 9),
            "a.gltf: byte 8: found a length of 9 bytes, expected that of the file, " +
                std::to_string(whole.size()));
  EXPECT_EQ(changed(12, 0xfffffff0),
            "a.gltf: byte 12: found a chunk of 4294967280 bytes, expected at most the " +
                std::to_string(whole.size() - 20) + " that are left");
  EXPECT_EQ(changed(16, 0x41414141), "a.gltf: byte 16: found AAAA, expected JSON");
  for (std::size_t n = 1; n < whole.size(); ++n)
    EXPECT_NE(complaint_of_file(whole.substr(0, n)), "") << n;
}

}  // namespace
}  // namespace gonio::scene
