#pragma once
/// \file
/// What the surfaces of MaterialX share: layers of dielectrics, and how their files are written.

#include <string>
#include <string_view>
#include <vector>

#include "fitting/export/materialx_layers.h"
#include "fitting/export/placement.h"
#include "fitting/export/target.h"

namespace gonio {

/// Layer without channels; widths are kept within (0, 1].
MaterialxLayer layer_of(double alpha_x, double alpha_y, double tangent_deg, double weight);
/// The same under a dielectric's Fresnel in each channel.
/// \param tint  colours what it reflects, not what it lets through
MaterialxLayer dielectric(MaterialxLayer, double eta, const std::vector<double>& tint);

/// \param whose  "OpenPBR's"   \param diffuse  its term beside Lambert's: "eon"
std::vector<std::string> lost_in_layers(const BoundModel&,
                                        const Surface&,
                                        const std::string& whose,
                                        std::string_view diffuse = "lambert",
                                        std::string_view diffuse_name = "Lambert's");

/// <input name="…" type="color3" value="…"/>
std::string input(std::string_view name, std::string_view type, std::vector<double> values);
/// File of a material with one node, "fit_shader", of these inputs.
/// \param before  nodes that it refers to
std::string material_file(const std::string& node,
                          const std::string& inputs,
                          const std::string& fit,
                          const std::string& before = "");

}  // namespace gonio
