#pragma once
/// \file
/// Diffuse forms as models, by what a renderer's roughness slider sets.

#include <string>
#include <string_view>
#include <vector>

#include "brdf/model/model.h"
#include "reports/diffuse/diffuse.h"

namespace gonio::diffusing {

/// F0 of the lobe that lies on plastic.
inline constexpr double lobe_f0 = 0.04;
inline constexpr std::string_view lobe_spec = "ggx/smith_ggx.correlated/schlick";
inline constexpr std::string_view reference = "diffuse.eon";

/// The forms, nothing measured of them yet.
std::vector<DiffuseForm> known_forms();

/// Width of the lobe of a roughness: r², none below the catalogue's least.
double alpha_of_slider(double roughness);

/// A form by itself, or with the lobe.  \param kd  one value or one a channel
BoundModel bound(const DiffuseForm&, double roughness, std::vector<double> kd, bool with_lobe);

}  // namespace gonio::diffusing
