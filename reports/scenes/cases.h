#pragma once
/// \file
/// Six materials on a sphere, each under three lights.

#include <string>
#include <string_view>
#include <vector>

#include "scene/description/scene.h"

namespace gonio::scenes {

/// Names of the materials: "satin gold", "chalk", "red plastic", "car paint", "brushed aluminium", "everything needed".
std::vector<std::string> material_names();
/// Names of the lights: "front light", "rim light", "sky and sun".
std::vector<std::string> light_names();
/// Material of that name.
scene::Material material_of(std::string_view name);
/// Scene of both.  Its name stands where a file's path and digest would.
scene::Scene scene_of(scene::Material, std::string_view light);
/// Roughness of a material's first lobe, √α of its mean width.
double roughness_of(std::string_view material);

}  // namespace gonio::scenes
