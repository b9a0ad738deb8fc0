#pragma once
/// \file
/// Materials of an asset, for the scenes of the report.

#include <string>
#include <vector>

#include "reports/scenes/scenes.h"
#include "scene/description/scene.h"

namespace gonio::scenes {

struct AssetMaterials {
  std::vector<scene::Material> materials;  ///< named as in the file
  std::vector<SceneLeftOut> left_out;
};
/// Materials of a glTF file that stand for one surface each; others, as those with textures, are left out by name.
AssetMaterials asset_materials(const std::string& path);

}  // namespace gonio::scenes
