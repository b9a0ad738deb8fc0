#pragma once
/// \file
/// Export of a map: textures of another program's material, on a plane that shows them.

#include <cstddef>
#include <string>
#include <vector>

#include "fitting/export/export.h"

namespace gonio {

/// Parameter that the textures have where a map does not know it: the median of the texels that do, or its default where
/// fewer than a tenth do.
struct FilledParameter {
  std::string parameter;
  std::size_t texels = 0;     ///< that do not know it
  std::vector<double> value;  ///< of each channel, or one
  bool is_default = false;    ///< of any of them
};

/// Map of parameters as a material with textures: base colour, metallic and roughness, the highlight's colour, and normals where the map has them. glTF's
/// metallic-roughness material has the highlight's colour by KHR_materials_specular, beside the map's strongest F0 by KHR_materials_ior; OpenPBR the same by
/// specular_color and specular_ior; UsdPreviewSurface F0 itself, in its specular workflow, and no metal.
struct MapExport {
  ExportTarget target = ExportTarget::gltf;
  std::vector<std::string>
      textures;  ///< files beside the first, named after it; none of glTF, which holds them
  std::string map, model;
  std::size_t width = 0, height = 0;
  std::size_t unknown = 0;              ///< texels without a value of each parameter
  std::vector<FilledParameter> filled;  ///< what they have in its place
  std::size_t metals =
      0;  ///< texels whose highlight is stronger than their diffuse colour: metallic is 1
  /// Of the highlight that one in 100 texels that are no metals exceeds: a texel whose fit went astray sets it for no other.
  double ior = 1.5;
  /// Distance of the textures' eight bits, by the target's own equations, from the map's f: root mean square by texel, relative as scale_of says, at
  /// 32 pairs of directions up to 80°.  Of the texels the median, and what one in 20 is beyond.
  double median_residual = 0, high_residual = 0;
  std::vector<std::string> lost;  ///< what the target cannot express, in sentences
};

/// Whether maps are written for a target.
bool takes_maps(ExportTarget);
/// \param output  name of the file, after which textures beside it are named
/// \param files   becomes the bytes of that file, with a plane that shows the material where the target has geometry, and of each texture beside it
/// \throws Error  bad_input of what is no map of gonio's, or has more than 2²⁴ texels
MapExport export_map(const std::string& map,
                     ExportTarget,
                     const std::string& output,
                     std::vector<std::string>& files);
/// Whether a file is a map of gonio's, by its header.
bool is_map(const std::string& path);

/// gonio.map_export/1
std::string to_json(const MapExport&);
std::string map_export_schema();

}  // namespace gonio
