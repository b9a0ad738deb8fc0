#pragma once
/// \file
/// Mitsuba's material, as files of a fit and of a map have it: a diffuse part and rough conductors, blended.

#include <string>
#include <utility>
#include <vector>

#include "brdf/model/spec.h"
#include "number/parameter.h"

namespace gonio {

/// Numbers that are written of a lobe: alpha, eta and k.
inline constexpr Range mitsuba_widths{1e-4, 1}, mitsuba_indices{0.001, 20},
    mitsuba_extinctions{0, 100};

/// Model with Mitsuba's equations.  \param anisotropic  one for each lobe
ModelSpec mitsuba_model(bool diffuse, const std::vector<bool>& anisotropic);
/// The catalogue's name of a parameter in that model: of "alpha_u_2" alpha_x_2.
std::string mitsuba_in_catalogue(const std::string& name);

/// Share of the diffuse part in a blend with a highlight: as small as leaves kd/share within 1.
double mitsuba_diffuse_share(double largest_kd);
/// Element of a blend.  \param parts  share, and element, of at least one; shares add up to 1
std::string mitsuba_blend(std::vector<std::pair<double, std::string>> parts);

}  // namespace gonio
