#pragma once
/// \file
/// Export of a fit: the parameters of another program's material, and how far its own equations with them are from the fit.
///
///   d = |f_target − f_fit| / max(f_fit, mean of f_fit in that channel),   at fixed directions up to 88° from the normal
///
/// The mean is over those up to 80°: nearer to the horizon a highlight outshines all else.

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/names.h"
#include "brdf/model/model.h"
#include "geometry/direction.h"

namespace gonio {

enum class ExportTarget { gltf, mitsuba, standard_surface, open_pbr, usd_preview };
template <>
inline constexpr std::array<std::string_view, 5> names_of<ExportTarget>{
    "gltf", "mitsuba", "standard_surface", "open_pbr", "usd_preview"};

/// Directions of light and view [°]: azimuths in (−180, 180].
struct ExportPlace {
  double theta_i = 0, phi_i = 0, theta_o = 0, phi_o = 0;
};
struct ExportResidual {
  double rms = 0, largest = 0;
  ExportPlace largest_at{};
};

/// The same material where the target computes otherwise: "scalar_spectral".
struct ExportVariant {
  std::string variant;
  ExportResidual residual;
};

struct Export {
  ExportTarget target = ExportTarget::gltf;
  std::string fit;    ///< path of the fit
  std::string model;  ///< spec of the fit
  /// Target's material by its own names: one value, or one per channel.
  std::vector<std::pair<std::string, std::vector<double>>> parameters{};
  std::optional<double> misfit{};  ///< typical factor of the fit from its table, exp of the log RMS
  double tolerance = 0;            ///< of the root mean square
  ExportResidual renamed{}, written{};
  std::vector<ExportVariant> variants{};  ///< of what was written; empty: all compute the same
  bool refitted = false;
  bool preview = false;                ///< whether the file has a sphere to show the material on
  std::vector<std::string> lost{};     ///< what the target cannot express, in sentences
  std::vector<std::string> clamped{};  ///< what was outside the target's range, in sentences
};

inline constexpr std::size_t export_directions = 4000;
inline constexpr double default_export_tolerance = 0.02;

/// Direction pairs at which every export is judged.
std::vector<DirectionPair> judged_directions();

/// Export to the target's equations: the fit's parameters renamed, and where that is further off than the tolerance fitted
/// again, to directions other than those that judge.
/// \throws Error  bad_input of the fit's file, of a model that has neither one nor three channels
Export export_fit(ExportTarget, const std::string& path, const BoundModel&, double tolerance);
/// Whether a file of the target can have a sphere to show its material on.
bool can_preview(ExportTarget);
/// File of the target with one material, and the fit as it was read in it.
/// \param fit  bytes of its document
std::string file_of(const Export&, const std::string& fit);

/// gonio.export/1
std::string to_json(const Export&);
std::string export_schema();

}  // namespace gonio
