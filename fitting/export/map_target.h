#pragma once
/// \file
/// Texels of a map as a target keeps them, f of these, and the files with their textures.

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "fitting/export/map_export.h"
#include "fitting/export/surface.h"
#include "geometry/angles.h"

namespace gonio {

/// What is known of a map before its texels are kept.
struct MapSummary {
  /// Of each lobe, whether it has two widths in any texel.
  std::vector<bool> anisotropic;
  /// Highlight of what is no metal, and kd, that one in 100 texels exceeds.
  double strong_f0 = 0.04, strong_kd = 0.5;
  /// That highlight as a target with one index has it.
  double f0() const;
  double ior() const;
};

/// Lobe of a surface that a target with one highlight shows, and whether as a metal's.
struct ShownLobe {
  const SurfaceLobe* lobe = nullptr;
  bool metal = false;
};
ShownLobe shown_lobe(const Surface&);
/// Number of a colour's channel: of grey three times the same, of none 0.
double channel_of(const std::vector<double>& values, std::size_t channel);

class MapTarget {
 public:
  virtual ~MapTarget() = default;
  /// Keeps a texel, as its textures have it; from any thread.
  virtual void keep(std::size_t texel, const Surface&) = 0;
  /// f of what was kept, by the target's own equations: three channels, [channel][sample].
  virtual std::vector<std::vector<double>> values(std::size_t texel,
                                                  std::span<const FrameAngles<double>>) const = 0;
  /// What the target cannot express of a map, in sentences.  \param start  model of its fits
  virtual std::vector<std::string> lost(const BoundModel& start) const = 0;
  /// Bytes of the file, and of each texture beside it, which are named in the export.
  /// \param normals  [axis][texel] in [0, 1]; may be empty   \param stack  name of the map's stack
  virtual std::vector<std::string> files(MapExport&,
                                         const std::vector<std::vector<float>>& normals,
                                         const std::string& stack,
                                         const std::string& output) = 0;
};

/// \param e  has the map's size and model
std::unique_ptr<MapTarget> map_target(ExportTarget, const MapExport& e, const MapSummary&);
std::unique_ptr<MapTarget> mitsuba_map(const MapExport&, const MapSummary&);
/// Name of a texture beside an output, after its whole name: files of two endings in one folder have textures of their own.
std::string texture_name(const std::string& output,
                         const std::string& what,
                         const std::string& ending);

}  // namespace gonio
