#pragma once
/// \file
/// Target of an export: the material of another program, its parameters, its equations, its file.

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "brdf/model/model.h"
#include "fitting/export/export.h"
#include "fitting/export/surface.h"
#include "geometry/angles.h"
#include "number/parameter.h"

namespace gonio {

/// Parameter of a target: by the target's own name, one value or one per channel, where the target takes them.
struct TargetParameter {
  std::string name;
  std::vector<double> values;
  Range legal{0, 1};
  bool free = true;  ///< whether a refit may move it
};
using TargetParameters = std::vector<TargetParameter>;

/// f_c of the target's equations [1/sr]: [channel][sample].
using TargetValues = std::function<std::vector<std::vector<double>>(
    const TargetParameters&, std::span<const FrameAngles<double>>)>;

/// Form of a target's material: which of its parameters are in use, with values that only rename the fit's.
struct TargetForm {
  TargetParameters parameters;
  TargetValues values;
  /// The same material as variants of the target compute it, by their names.
  std::vector<std::pair<std::string, TargetValues>> variants{};
};

struct Target {
  std::string_view name;  ///< as people write it
  /// Forms that may stand for a surface, the likeliest first.
  std::vector<TargetForm> (*forms)(const Surface&);
  /// What the target cannot express in that form, in sentences.
  std::vector<std::string> (*lost)(const BoundModel&, const Surface&, const TargetParameters&);
  /// The file.  \param fit  bytes of the fit's document, which stands in it
  std::string (*file)(const Export&, const std::string& fit);
};
extern const Target gltf_target, mitsuba_target, standard_surface_target, open_pbr_target,
    usd_preview_target;

/// Scale of a distance between two f: f, or where that is larger the f of a matte surface that returns about as much light,
///
///   (kd + Σ weight F_avg)/π   with F_avg of Schlick's approximation
///
/// A mean of f would be that of its highlight, beside which everything else counts as nothing.
std::vector<std::vector<double>> scale_of(std::vector<std::vector<double>> f, const Surface&);

/// Value of a parameter by its name: of a channel, or the only one.  0 where there is none.
double parameter_in(const TargetParameters&, std::string_view name, std::size_t channel = 0);

/// Values of legal parameters nearest to the wanted f, from the given ones on: least squares of (f − wanted)/scale.
/// \param wanted, scale  [channel][sample]; scale is above 0
TargetParameters refitted(TargetParameters,
                          const TargetValues&,
                          std::span<const FrameAngles<double>>,
                          const std::vector<std::vector<double>>& wanted,
                          const std::vector<std::vector<double>>& scale);

}  // namespace gonio
