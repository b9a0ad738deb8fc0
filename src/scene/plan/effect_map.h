#pragma once
/// \file
/// Map of where each effect of a material switches on: light angle by roughness.

#include <array>
#include <vector>

#include "scene/description/scene.h"
#include "scene/surface/effect.h"

namespace gonio::scene {

/// Differences that dropping each effect makes, all else exact: the tolerance's quantile over a sphere under one directional light.
struct EffectMap {
  std::vector<double> light_deg;  ///< between light and viewer, seen from the sphere's centre
  std::vector<double> roughness;  ///< of the first lobe, by α = roughness²
  /// [effect][angle * roughness.size() + roughness]; 0 where the effect is absent
  std::array<std::vector<double>, effect_count> error;

  double at(Effect e, std::size_t angle, std::size_t r) const {
    return error[static_cast<std::size_t>(e)][angle * roughness.size() + r];
  }
};

/// Map of a material under the scene's exposure and tolerance; irradiance of the light 3 over the exposure.  Of an anisotropic lobe
/// both widths are scaled alike.
EffectMap effect_map(const Scene&,
                     std::size_t material,
                     std::vector<double> light_deg,
                     std::vector<double> roughness,
                     std::size_t samples = 1024);

}  // namespace gonio::scene
