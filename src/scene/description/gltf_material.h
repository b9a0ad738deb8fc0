#pragma once
/// \file
/// Material of a glTF 2.0 file.

#include <string>

#include "image/environment.h"

namespace gonio::scene {

class GltfFile;

/// Factors of a metallic-roughness material with KHR_materials_ior, _specular, _clearcoat and _anisotropy, as their
/// specifications name and define them:
///
///   F0 of the dielectric  min((ior − 1)²/(ior + 1)² specular_color, 1) specular,   its F90  specular
///   α = roughness²,  along the tangent  lerp(α, 1, anisotropy²);   the coat's  α = clearcoat_roughness²
struct GltfMaterial {
  Rgb base_color{1, 1, 1};
  double metallic = 1, roughness = 1;
  double ior = 1.5;
  double specular = 1;
  Rgb specular_color{1, 1, 1};
  double clearcoat = 0, clearcoat_roughness = 0;
  double anisotropy = 0, anisotropy_rotation = 0;  ///< of the tangent towards the bitangent [rad]
};

/// The material of that name.  Refused by name: textures, extensions that change the look and are none of those four (one that
/// has no effect at the values given is left out), light of its own, and transparency.
/// \param name  of one material of the file
GltfMaterial read_material(const GltfFile&, const std::string& name);

}  // namespace gonio::scene
