#pragma once
/// \file
/// A scene of every kind of thing that needs no other file.

#include "base/json/reader.h"

#include <nlohmann/json.hpp>

namespace gonio::scene::test {

inline Json example() {
  return Json::parse(R"({
    "schema": "gonio.scene/1",
    "materials": {
      "satin gold": {"model": "gltf", "parameters": {"base_color": [0.93, 0.71, 0.41], "metallic": 1, "roughness": 0.45}},
      "chalk": {"model": "lambert", "parameters": {"kd": 0.8}},
      "foil": {"model": "ggx/smith_ggx.correlated/conductor", "parameters": {"alpha": 0.1, "metal": "Al"}}},
    "objects": [
      {"shape": "sphere", "material": "chalk"},
      {"shape": "sphere", "material": "satin gold", "center": [0, 2, 0], "radius": 0.5},
      {"shape": "sphere", "material": "foil", "center": [3, 0, 0]}],
    "lights": [
      {"type": "directional", "direction": [0, 0, -2], "irradiance": [3, 2, 1]},
      {"type": "directional", "direction_range": {"elevation_deg": [10, 80], "azimuth_deg": [-90, 90]}, "irradiance": [1, 1, 1]},
      {"type": "rectangle", "center": [0, 5, 0], "u": [1, 0, 0], "v": [0, 0, 2], "radiance": [10, 10, 10]}],
    "view": {"orbit": {"target": [0, 1, 0], "distance": 10, "elevation_deg": [0, 30], "azimuth_deg": [0, 360]}},
    "exposure": 0.5,
    "tolerance": {"metric": "delta_e_2000", "quantile": 0.95, "limit": 1, "max": 3, "confidence": 0.9},
    "budget_ns": 40,
    "seed": 7
  })");
}

}  // namespace gonio::scene::test
