#pragma once
/// \file
/// Layers of MaterialX's surfaces as its GLSL has them under one light (1.39.5: mx_dielectric_bsdf, mx_conductor_bsdf,
/// mx_generalized_schlick_bsdf, mx_layer_bsdf), composed of the catalogue's terms and maps.
///
///   f = w t D V F (1 + F m),   m = (1 − E)/E,   V: Smith's, correlated, of α = √(α_x α_y) in all directions
///   through = 1 − w (F0 A + F90 B)(1 + F m),    A, B, E = A + B: MaterialX's fit at NoV and α
///
/// F is that at VoH; what lies below a layer is multiplied by `through`.

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "geometry/angles.h"

namespace gonio {

/// F of one channel by the angles.
using LayerFresnel = std::function<double(const Angles<double>&)>;

struct MaterialxLayer {
  double alpha_x = 1, alpha_y = 1;
  double tangent_deg = 0;  ///< azimuth of the tangent
  double weight = 1;       ///< w; a layer without weight is not there
  struct Channel {
    LayerFresnel fresnel;
    double f0 = 0, f90 = 1, tint = 1;
  };
  std::vector<Channel> channels;
  bool grey_through = false;  ///< whether what goes through is averaged over the channels
};

/// A surface: coats on top of each other, then metal or a diffuse colour.
struct MaterialxSurface {
  std::vector<MaterialxLayer> layers;  ///< from the top
  std::vector<double> kd;              ///< below all layers; 0 below a metal
  double diffuse_roughness = 0;        ///< of oren_nayar_diffuse_bsdf
  bool compensated = false;  ///< that gives back what it loses: EON, else Oren–Nayar's own form
};

/// f_c [1/sr]: [channel][sample].
std::vector<std::vector<double>> evaluate(const MaterialxSurface&,
                                          std::span<const FrameAngles<double>>);

LayerFresnel dielectric_layer(double eta);
/// By reflectance at normal incidence and edge tint; the reflectance is kept below 0.99, as MaterialX does.
LayerFresnel artistic_layer(double f0, double edge);
LayerFresnel f82_layer(double f0, double tint);

}  // namespace gonio
