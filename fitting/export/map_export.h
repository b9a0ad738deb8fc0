#pragma once
/// \file
/// Export of a map: textures of another program's material, on a plane that shows them.

#include <cstddef>
#include <string>
#include <vector>

namespace gonio {

/// Parameter that the textures have where a map does not know it: the median of the texels that do, or its default where
/// fewer than a tenth do.
struct FilledParameter {
  std::string parameter;
  std::size_t texels = 0;     ///< that do not know it
  std::vector<double> value;  ///< of each channel, or one
  bool is_default = false;    ///< of any of them
};

/// Map of parameters as glTF's metallic-roughness material with textures: base colour, metallic and roughness, the highlight's colour
/// (KHR_materials_specular, beside the map's strongest F0 by KHR_materials_ior), and normals where the map has them.
struct MapExport {
  std::string map, model;
  std::size_t width = 0, height = 0;
  std::size_t unknown = 0;              ///< texels without a value of each parameter
  std::vector<FilledParameter> filled;  ///< what they have in its place
  std::size_t metals =
      0;  ///< texels whose highlight is stronger than their diffuse colour: metallic is 1
  /// Of the highlight that one in 100 texels that are no metals exceeds: a texel whose fit went astray sets it for no other.
  double ior = 1.5;
  /// Distance of the textures' eight bits, by glTF's own equations, from the map's f: root mean square by texel, relative as scale_of says, at
  /// 32 pairs of directions up to 80°.  Of the texels the median, and what one in 20 is beyond.
  double median_residual = 0, high_residual = 0;
  std::vector<std::string> lost;  ///< what glTF cannot express, in sentences
};

/// \param file  becomes the bytes of a .gltf with its textures and a plane inside
/// \throws Error  bad_input of what is no map of gonio's, or has more than 2²⁴ texels
MapExport export_map(const std::string& map, std::string& file);
/// Whether a file is a map of gonio's, by its header.
bool is_map(const std::string& path);

/// gonio.map_export/1
std::string to_json(const MapExport&);
std::string map_export_schema();

}  // namespace gonio
