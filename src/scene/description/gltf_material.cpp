#include "scene/description/gltf_material.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <string_view>

#include "base/json/describe.h"
#include "scene/description/gltf_file.h"

#include <fmt/format.h>

namespace gonio::scene {
namespace {

constexpr Numbers kUnit{0, 1};

/// Extension that has no effect while a factor is what it is when left out.
struct Neutral {
  std::string_view extension;
  const char* factor;  ///< nullptr: never, in a material that is read at all
};
constexpr std::array kNeutral{
    Neutral{"KHR_materials_iridescence", "iridescenceFactor"},
    Neutral{"KHR_materials_sheen", "sheenColorFactor"},
    Neutral{"KHR_materials_transmission", "transmissionFactor"},
    Neutral{"KHR_materials_diffuse_transmission", "diffuseTransmissionFactor"},
    Neutral{"KHR_materials_volume", nullptr},             // of what transmits light
    Neutral{"KHR_materials_dispersion", nullptr},         // of what has a volume
    Neutral{"KHR_materials_emissive_strength", nullptr},  // of what emits light
};

/// True where a factor, a number or a colour, is 0 or not there.
bool is_zero(const JsonReader& extension, const char* factor) {
  if (!extension.has(factor)) return true;
  const JsonReader value = extension.at(factor);
  if (!value.is_array()) return number_in(value, {}) == 0;
  expect_array(value, {3, 3});
  bool all = true;
  for (std::size_t k = 0; k < 3; ++k) all &= number_in(value.at(k), {}) == 0;
  return all;
}

bool has_no_effect(std::string_view name, const JsonReader& extension) {
  const auto known = std::ranges::find(kNeutral, name, &Neutral::extension);
  return known != kNeutral.end() && (!known->factor || is_zero(extension, known->factor));
}

/// Refuses what lets light through.  \param alpha  the base colour's
void expect_opaque(const JsonReader& material, double alpha) {
  const std::string mode = material.has("alphaMode") ? material.at("alphaMode").string() : "OPAQUE";
  double cutoff = 0.5;
  read_key(material, "alphaCutoff", cutoff, Numbers{0, 1e6});
  if (mode == "OPAQUE" || (mode == "BLEND" && alpha == 1) || (mode == "MASK" && alpha >= cutoff))
    return;
  material.at("alphaMode")
      .fail(fmt::format("{} with an alpha of {}", mode, alpha), "an opaque material");
}

/// Reader of one material; errors name it.
class Reader {
 public:
  explicit Reader(const std::string& name) : name_(name) {}

  GltfMaterial material(const JsonReader& material) {
    std::array<double, 4> rgba{1, 1, 1, 1};
    refuse_textures(material);
    if (material.has("pbrMetallicRoughness")) {
      const JsonReader pbr = material.at("pbrMetallicRoughness");
      refuse_textures(pbr);
      read_key(pbr, "baseColorFactor", rgba, kUnit);
      read_key(pbr, "metallicFactor", m_.metallic, kUnit);
      read_key(pbr, "roughnessFactor", m_.roughness, kUnit);
    }
    std::ranges::copy_n(rgba.begin(), 3, m_.base_color.begin());
    Rgb emissive{};
    read_key(material, "emissiveFactor", emissive, kUnit);
    if (emissive != Rgb{}) material.at("emissiveFactor").fail("0, a material that emits no light");
    expect_opaque(material, rgba[3]);
    if (material.has("extensions"))
      material.at("extensions").visit_members([&](const auto& name, const auto& extension) {
        read_extension(name, extension);
      });
    return m_;
  }

 private:
  void read_extension(const std::string& name, const JsonReader& extension) {
    extension.expect_object();
    if (name == "KHR_materials_ior") {
      read_key(extension, "ior", m_.ior, Numbers{1, 1e6});
    } else if (name == "KHR_materials_specular") {
      refuse_textures(extension);
      read_key(extension, "specularFactor", m_.specular, kUnit);
      read_key(extension, "specularColorFactor", m_.specular_color, Numbers{0, 1e6});
    } else if (name == "KHR_materials_clearcoat") {
      read_key(extension, "clearcoatFactor", m_.clearcoat, kUnit);
      read_key(extension, "clearcoatRoughnessFactor", m_.clearcoat_roughness, kUnit);
      if (m_.clearcoat > 0) refuse_textures(extension);  // else it is off, whatever its textures
    } else if (name == "KHR_materials_anisotropy") {
      read_key(extension, "anisotropyStrength", m_.anisotropy, kUnit);
      read_key(extension, "anisotropyRotation", m_.anisotropy_rotation, Numbers{-1e6, 1e6});
      if (m_.anisotropy > 0) refuse_textures(extension);
    } else if (!has_no_effect(name, extension)) {
      extension.fail(fmt::format("{} of '{}'", name, name_),
                     "only KHR_materials_ior, _specular, _clearcoat or _anisotropy");
    }
  }
  /// Refuses textures among an object's keys.
  void refuse_textures(const JsonReader& object) const {
    object.visit_members([&](const std::string& key, const JsonReader& value) {
      if (key.ends_with("Texture"))
        value.fail(fmt::format("a texture of '{}'", name_), "a material of factors only");
    });
  }

  const std::string& name_;
  GltfMaterial m_;
};

}  // namespace

GltfMaterial read_material(const GltfFile& file, const std::string& name) {
  const auto index = file.named("materials", "material", name);
  return Reader(name).material(file.list("materials")->at(index));
}

}  // namespace gonio::scene
