#pragma once
/// \file
/// What is guessed of a function by its names and its values: what it stands for, and what its value includes.

#include <array>
#include <string_view>
#include <vector>

#include "foreign/function.h"

namespace gonio::foreign {

/// True where one of its programs depends on that angle of the sample.
bool reads_angle(const Function&, std::string_view name);
/// Defaults of its parameters.
std::vector<double> defaults_of(const Function&);
/// Angles of a sample by zenith angles of light and view and the azimuth between them, the surface turned.
std::array<double, 11> angles_between(double theta_l, double phi, double theta_v, double turn);
/// True of values that differ by more than roundings.
bool differ(double a, double b);

/// Decides by the arguments what the function stands for; where it takes both cosines, by its name.
Stands stands_for(const Function&);
/// True of a value of one cosine that is 1 at grazing angles and less along the normal, where its name or the cosine's does not say
/// that it is of the surface: a Fresnel term.  An albedo of NoV may have such values, too.
bool gives_fresnel(const Function&);
/// True of a Fresnel term by vectors: two of light, view and half vector, of which only VoH changes its value.
bool depends_on_voh_only(const Function&);
/// Sets whether turning the surface changes a value, and what the value includes of what the function stands for.
/// \throws Error  wrong usage of what --includes says
void guess_includes(Function&);

}  // namespace gonio::foreign
