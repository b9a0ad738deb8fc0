#pragma once
/// \file
/// Errors of the approximate Fresnel terms on a smooth surface, over the angle.

#include <string>
#include <vector>

#include "reports/measure/surfaces.h"

namespace gonio {

/// Errors of a form on a surface against the exact F, over θ from 0 to 90°.
struct FresnelRow {
  std::string form;  ///< id, with what tells a variant from it
  /// "dielectric", "dielectric_inside": light in the denser medium; "metal"; "spectral": linear RGB
  std::string kind;
  std::string name;               ///< "IOR 1.5", "gold, red"
  std::string material, channel;  ///< of the name; the channel of a grey surface is empty
  double eta, k;  ///< transmitted over incident; not a number where it is a spectrum
  double max_abs, max_abs_theta_deg;
  double max_rel, max_rel_theta_deg;
  double rms;         ///< of the error, mean over θ
  double bias;        ///< 2 ∫ (F − exact) c dc: of light from everywhere
  double within_deg;  ///< up to which angle the error is at most 0.01
};
/// Errors of every form that can be given to a surface.  \param steps  equal steps of θ
std::vector<FresnelRow> fresnel_errors(const FresnelSurface&, std::size_t steps);

}  // namespace gonio
