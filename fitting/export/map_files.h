#pragma once
/// \file
/// Files of a map's export: the material of each target with its textures.

#include <array>
#include <cstddef>
#include <string>

#include "fitting/export/map_export.h"
#include "image/png.h"

namespace gonio {

/// Textures of a map: colour; roughness in the second channel and metal in the third; the highlight's colour; and normals, without pixels where the map has
/// none.
struct MapTextures {
  PngImage base, rough, tint, normals;
};

/// Half of the sides of a plane that has an image's shape and fits into a square of 2.
std::array<float, 2> half_sides(std::size_t width, std::size_t height);
/// Document that a file of another format keeps: the model and the stack that the textures were made of.
std::string document_of(const MapExport&, const std::string& stack);

/// \param stack  name of the map's stack, which stands in the file
std::string gltf_file_of(const MapExport&, const MapTextures&, const std::string& stack);
/// The same beside files of the textures, which the export names.
std::string open_pbr_file_of(const MapExport&, const std::string& stack);
std::string usd_preview_file_of(const MapExport&, const std::string& stack);

}  // namespace gonio
