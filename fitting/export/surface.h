#pragma once
/// \file
/// Surface of a fit in words that every target knows: a diffuse colour, and lobes by their widths and reflectances.

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "brdf/model/model.h"

namespace gonio {

/// Lobe of a surface, its reflectance told apart from its weight.
struct SurfaceLobe {
  double alpha_x = 1, alpha_y = 1;  ///< widths along the tangent and across it
  double weight = 1;
  /// Per channel: reflectance at normal incidence, and at 82° relative to Schlick's.
  std::vector<double> f0, f82_tint;
  /// Per channel: refractive index, given or of about this reflectance at both angles.
  std::vector<double> eta, k;
  double largest_f0() const;
  /// Whether it has an extinction, or reflects more than a dielectric does.
  bool is_metal() const;
};

struct Surface {
  std::size_t channels = 1;
  std::vector<double> kd;  ///< per channel; 0 where there is no diffuse term
  /// Of a diffuse term of Oren and Nayar's kind, as MaterialX takes it: σ [rad] of their own form, r of EON and Fujii's; else 0.
  double diffuse_roughness = 0;
  std::vector<SurfaceLobe> lobes;
  double tangent_deg = 0;  ///< azimuth of the tangent
  double largest_kd() const;
};
Surface surface_of(const BoundModel&);

/// Whether every lobe's Fresnel term is one of those, by the beginnings of their names ("dielectric").
bool fresnel_is(const BoundModel&, std::initializer_list<std::string_view> names);

/// Whether the fit has a diffuse term beside a lobe, and that term keeps its light whatever the lobe reflects.
bool keeps_diffuse_whole(const BoundModel&, const Surface&);

/// What of the fit no target has, in sentences: the exponent of the distribution, other distributions than GGX, other
/// diffuse terms than Lambert's, other masking.
/// \param whose  "glTF's"   \param masking  of the target, as ids end: "separable"
/// \param diffuse  terms of the target, coupled or not, and what they are called
std::vector<std::string> lost_by_all(const BoundModel&,
                                     const std::string& whose,
                                     std::string_view masking,
                                     std::initializer_list<std::string_view> diffuse = {"lambert"},
                                     std::string_view diffuse_name = "Lambert's");

}  // namespace gonio
