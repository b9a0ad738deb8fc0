#include "scene/description/gltf_material.h"

#include "refusal.h"
#include "scene/description/gltf_example.h"
#include "scene/description/gltf_file.h"
#include "support.h"

namespace gonio::scene {
namespace {

using gonio::test::Folder;
using gonio::test::refusal;
using namespace test;

GltfMaterial read_material(const Json& material) {
  const Folder folder;
  const GltfFile file(folder.write("a.gltf", with(square_gltf(), "/materials/0", material).dump()));
  return read_material(file, "m");
}
GltfMaterial with_extension(const std::string& name, const Json& factors) {
  return read_material({{"name", "m"}, {"extensions", {{name, factors}}}});
}
std::string complaint_of_material(const Json& keys) {
  Json material{{"name", "m"}};
  material.update(keys);
  const std::string line = refusal([&] { read_material(material); });
  return line.substr(std::min(line.size(), line.find("a.gltf")));
}
std::string complaint_of_material(const std::string& extension, const Json& factors) {
  return complaint_of_material(Json{{"extensions", {{extension, factors}}}});
}

TEST(GltfMaterial, OfNoFactorsIsThatOfTheSpecification) {
  const GltfMaterial m = read_material({{"name", "m"}});
  EXPECT_EQ(m.base_color, (Rgb{1, 1, 1}));
  EXPECT_EQ(m.metallic, 1);
  EXPECT_EQ(m.roughness, 1);
  EXPECT_EQ(m.ior, 1.5);
  EXPECT_EQ(m.specular, 1);
  EXPECT_EQ(m.specular_color, (Rgb{1, 1, 1}));
  EXPECT_EQ(m.clearcoat, 0);
  EXPECT_EQ(m.clearcoat_roughness, 0);
  EXPECT_EQ(m.anisotropy, 0);
}

TEST(GltfMaterial, ReadsEachFactor) {
  const GltfMaterial m = read_material(
      Json::parse(R"({"name": "m", "alphaMode": "BLEND", "doubleSided": true, "extras": {"x": []},
    "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 0.125, 1], "metallicFactor": 0.75, "roughnessFactor": 0.375},
    "extensions": {
      "KHR_materials_ior": {"ior": 1.25},
      "KHR_materials_specular": {"specularFactor": 0.5, "specularColorFactor": [2, 1, 0]},
      "KHR_materials_clearcoat": {"clearcoatFactor": 0.25, "clearcoatRoughnessFactor": 0.625},
      "KHR_materials_anisotropy": {"anisotropyStrength": 0.875, "anisotropyRotation": -3}}})"));
  EXPECT_EQ(m.base_color, (Rgb{0.5, 0.25, 0.125}));
  EXPECT_EQ(m.metallic, 0.75);
  EXPECT_EQ(m.roughness, 0.375);
  EXPECT_EQ(m.ior, 1.25);
  EXPECT_EQ(m.specular, 0.5);
  EXPECT_EQ(m.specular_color, (Rgb{2, 1, 0}));
  EXPECT_EQ(m.clearcoat, 0.25);
  EXPECT_EQ(m.clearcoat_roughness, 0.625);
  EXPECT_EQ(m.anisotropy, 0.875);
  EXPECT_EQ(m.anisotropy_rotation, -3);
}

TEST(GltfMaterial, RefusesTexturesByTheirPlace) {
  const Json texture{{"index", 0}};
  const std::string is = ": found a texture of 'm', expected a material of factors only";
  for (const char* key : {"normalTexture", "occlusionTexture", "emissiveTexture"})
    EXPECT_EQ(complaint_of_material(Json{{key, texture}}),
              "a.gltf: /materials/0/" + std::string(key) + is);
  for (const char* key : {"baseColorTexture", "metallicRoughnessTexture"})
    EXPECT_EQ(complaint_of_material(Json{{"pbrMetallicRoughness", {{key, texture}}}}),
              "a.gltf: /materials/0/pbrMetallicRoughness/" + std::string(key) + is);
  for (const auto& [extension, key, on] :
       {std::tuple("KHR_materials_specular", "specularColorTexture", "specularFactor"),
        {"KHR_materials_clearcoat", "clearcoatNormalTexture", "clearcoatFactor"},
        {"KHR_materials_anisotropy", "anisotropyTexture", "anisotropyStrength"}})
    EXPECT_EQ(complaint_of_material(extension, {{on, 1}, {key, texture}}),
              "a.gltf: /materials/0/extensions/" + std::string(extension) + "/" + key + is);
}

TEST(GltfMaterial, LeavesOutWhatIsOffWithItsTextures) {
  const Json texture{{"index", 0}};
  EXPECT_EQ(with_extension("KHR_materials_clearcoat", {{"clearcoatTexture", texture}}).clearcoat,
            0);
  EXPECT_EQ(with_extension("KHR_materials_anisotropy", {{"anisotropyTexture", texture}}).anisotropy,
            0);
}

TEST(GltfMaterial, RefusesExtensionsByNameWhereTheyChangeTheLook) {
  const std::string expected =
      " of 'm', expected only KHR_materials_ior, _specular, _clearcoat or _anisotropy";
  for (const auto& [name, factor, value] :
       {std::tuple("KHR_materials_iridescence", "iridescenceFactor", Json(0.5)),
        {"KHR_materials_sheen", "sheenColorFactor", Json{0, 0, 0.1}},
        {"KHR_materials_transmission", "transmissionFactor", Json(1)},
        {"KHR_materials_diffuse_transmission", "diffuseTransmissionFactor", Json(1)}}) {
    EXPECT_EQ(
        complaint_of_material(name, {{factor, value}}),
        "a.gltf: /materials/0/extensions/" + std::string(name) + ": found " + name + expected);
    EXPECT_EQ(complaint_of_material(name, Json::object()), "") << "it has no effect then";
    EXPECT_EQ(complaint_of_material(name, {{factor, value.is_array() ? Json{0, 0, 0} : Json(0)}}),
              "");
  }
  for (const char* name :
       {"KHR_materials_unlit", "KHR_materials_pbrSpecularGlossiness", "VENDOR_glow"})
    EXPECT_EQ(
        complaint_of_material(name, Json::object()),
        "a.gltf: /materials/0/extensions/" + std::string(name) + ": found " + name + expected);
  for (const char* name :
       {"KHR_materials_volume", "KHR_materials_dispersion", "KHR_materials_emissive_strength"})
    EXPECT_EQ(complaint_of_material(name, Json::object()), "") << "alone it has no effect";
}

TEST(GltfMaterial, RefusesFactorsOutOfTheirRanges) {
  EXPECT_EQ(complaint_of_material(Json{{"pbrMetallicRoughness", {{"metallicFactor", 1.5}}}}),
            "a.gltf: /materials/0/pbrMetallicRoughness/metallicFactor: found 1.5, expected a "
            "number in [0, 1]");
  EXPECT_EQ(
      complaint_of_material(Json{{"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, -1, 1}}}}}),
      "a.gltf: /materials/0/pbrMetallicRoughness/baseColorFactor/2: found -1, expected a "
      "number in [0, 1]");
  EXPECT_EQ(complaint_of_material("KHR_materials_ior", {{"ior", 0}}),
            "a.gltf: /materials/0/extensions/KHR_materials_ior/ior: found 0, expected a number in "
            "[1, 1e+06]");
  EXPECT_EQ(complaint_of_material("KHR_materials_clearcoat", 3),
            "a.gltf: /materials/0/extensions/KHR_materials_clearcoat: found 3, expected an object");
  EXPECT_EQ(complaint_of_material(Json{{"emissiveFactor", {0, 0, 1}}}),
            "a.gltf: /materials/0/emissiveFactor: found an array, expected 0, a material that "
            "emits no light");
}

TEST(GltfMaterial, RefusesWhatIsNotOpaque) {
  const auto of = [](const char* mode, double alpha) {
    return complaint_of_material(Json{
        {"alphaMode", mode}, {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, alpha}}}}});
  };
  EXPECT_EQ(of("OPAQUE", 0), "");
  EXPECT_EQ(of("MASK", 0.5), "");
  EXPECT_EQ(of("MASK", 0.25),
            "a.gltf: /materials/0/alphaMode: found MASK with an alpha of 0.25, expected an opaque "
            "material");
  EXPECT_EQ(of("BLEND", 0.5),
            "a.gltf: /materials/0/alphaMode: found BLEND with an alpha of 0.5, expected an opaque "
            "material");
  EXPECT_HAS(of("GLASS", 1), "alphaMode: found GLASS");
}

TEST(GltfMaterial, OfTheClearCoatTestHasItsFactors) {
  GONIO_NEEDS_SHARED(path, "data/gltf/ClearCoatTest/ClearCoatTest.gltf");
  const GltfFile file(path);
  const GltfMaterial coated = read_material(file, "Simple_Coated");
  EXPECT_EQ(coated.base_color, (Rgb{0.5, 0.019999999552965164, 0.009999999776482582}));
  EXPECT_EQ(coated.metallic, 0);
  EXPECT_EQ(coated.roughness, 0.4399999976158142);
  EXPECT_EQ(coated.ior, 1.5);
  EXPECT_EQ(coated.clearcoat, 1);
  EXPECT_EQ(coated.clearcoat_roughness, 0.03);
  EXPECT_EQ(read_material(file, "Simple_Base").clearcoat, 0);
  EXPECT_EQ(read_material(file, "Simple_Coating").roughness, 0.029999999329447746);
  EXPECT_EQ(read_material(file, "RoughVariations_Base").roughness, 0.6000000238418579);
  EXPECT_HAS(refusal([&] { read_material(file, "Partial_Coated"); }),
             "/materials/4/extensions/KHR_materials_clearcoat/clearcoatTexture: found a texture of "
             "'Partial_Coated'");
  EXPECT_HAS(refusal([&] { read_material(file, "LabelMaterial"); }),
             "/materials/18/emissiveTexture: found a texture");
}

}  // namespace
}  // namespace gonio::scene
