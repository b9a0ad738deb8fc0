#include "reports/scenes/asset.h"

#include <algorithm>

#include "base/error.h"
#include "base/json/reader.h"
#include "scene/description/gltf_file.h"
#include "scene/description/gltf_material.h"

namespace gonio::scenes {
namespace {

/// Words after the file's name: "/materials/4/…: found a texture of 'Partial_Coated', expected …".
std::string without_file(const std::string& line, const std::string& path) {
  return line.starts_with(path + ": ") ? line.substr(path.size() + 2) : line;
}

}  // namespace

AssetMaterials asset_materials(const std::string& path) {
  using namespace scene;
  const GltfFile file(path);
  const auto& list = file.list("materials");
  if (!list || list->size() == 0) file.root().fail("no material", "an asset that has some");
  AssetMaterials all;
  for (std::size_t k = 0; k < list->size(); ++k) {
    const JsonReader entry = list->at(k);
    const std::string name = entry.has("name") ? entry.at("name").string() : "";
    try {
      Material m;
      m.name = name;
      m.from = FromGltf{path, name};
      m.is = read_material(file, name);
      all.materials.push_back(std::move(m));
    } catch (const Error& e) {
      all.left_out.push_back({name, without_file(e.what(), path)});
    }
  }
  return all;
}

}  // namespace gonio::scenes
