#pragma once
/// \file
/// Placement of a fit's lobes in a target that has a highlight and a coat, in the words of such targets.

#include <string_view>
#include <vector>

#include "fitting/export/surface.h"
#include "fitting/export/target.h"
#include "geometry/angles.h"

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
/// Azimuth [°], which half a turn does not change: in [−90, 90].
double half_turn_of(double tangent_deg);
/// The same in turns: in [0.25, 0.75), away from both ends of [0, 1].
double turns_of(double tangent_deg);

double fourth_root(double);
/// Roughness r with α = r² of one width like a lobe's two: r⁴ = α_x α_y.
double one_roughness(const SurfaceLobe&);

/// Angles in a frame whose tangent lies at the azimuth of this cosine and sine.
FrameAngles<double> turned(FrameAngles<double>, double cosine, double sine);

/// Values of a parameter for each of n channels.
std::vector<double> per_channel(const TargetParameters&, std::string_view name, std::size_t n);

/// Indices of a dielectric that a refit may try.
inline constexpr Range index_range{1, 10};
/// Roughnesses that a refit may try; at 0 nothing but the mirror's direction reflects.
inline constexpr Range roughness_range{0.01, 1};

}  // namespace gonio
