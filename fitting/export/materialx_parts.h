#pragma once
/// \file
/// What the surfaces of MaterialX share: which lobe of a fit goes where, and parameters in their words.

#include <string>
#include <string_view>
#include <vector>

#include "fitting/export/materialx_layers.h"
#include "fitting/export/target.h"

namespace gonio {

/// Place of a surface's lobes in the target: the one above the colour, or that has it, and the coat on it.
struct Placed {
  const SurfaceLobe *base = nullptr, *coat = nullptr;
  bool metal = false;
};
/// Ways to place the first two lobes, the likeliest first: the coat is what reflects less.
std::vector<Placed> placements(const Surface&);

/// Index of a grey dielectric like a lobe, and its colour beside that, of which the brightest channel is 1.
struct GreyDielectric {
  double eta;
  std::vector<double> tint;
  bool is_grey() const;
};
GreyDielectric grey_dielectric(const SurfaceLobe&);

/// The wider and the narrower width, and the azimuth of the tangent along which the wider one lies [°].
struct Stretch {
  double wide, narrow, tangent_deg;
};
Stretch stretch_of(const SurfaceLobe&, double tangent_deg);
/// Azimuth in turns, which half a turn does not change: in [0.25, 0.75), away from both ends of [0, 1].
double turns_of(double tangent_deg);

double fourth_root(double);
/// Roughness r with α = r² of one width like a lobe's two: r⁴ = α_x α_y.
double one_roughness(const SurfaceLobe&);

/// Layer without channels; widths are kept within (0, 1].
MaterialxLayer layer_of(double alpha_x, double alpha_y, double tangent_deg, double weight);
/// The same under a dielectric's Fresnel in each channel.
/// \param tint  colours what it reflects, not what it lets through
MaterialxLayer dielectric(MaterialxLayer, double eta, const std::vector<double>& tint);

/// Values of a parameter for each of n channels.
std::vector<double> per_channel(const TargetParameters&, std::string_view name, std::size_t n);

/// Indices of a dielectric that a refit may try.
inline constexpr Range index_range{1, 10};
/// Roughnesses that a refit may try; at 0 nothing but the mirror's direction reflects.
inline constexpr Range roughness_range{0.01, 1};

/// \param whose  "OpenPBR's"
std::vector<std::string> lost_in_layers(const BoundModel&,
                                        const Surface&,
                                        const std::string& whose);

/// <input name="…" type="color3" value="…"/>
std::string input(std::string_view name, std::string_view type, std::vector<double> values);
/// File of a material with one node, "fit_shader", of these inputs.
/// \param before  nodes that it refers to
std::string material_file(const std::string& node,
                          const std::string& inputs,
                          const std::string& fit,
                          const std::string& before = "");

}  // namespace gonio
