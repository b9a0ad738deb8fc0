#pragma once
/// \file
/// Smooth surfaces, their exact Fresnel reflectance, and the forms that stand in for it.

#include <span>
#include <string>
#include <vector>

#include "brdf/model/spec.h"
#include "optics/refractive_index.h"

namespace gonio {

/// A smooth surface that reflects exactly so much: one index a channel, or a spectrum in linear RGB.
struct FresnelSurface {
  std::string kind, material;
  std::vector<Index> index;  ///< transmitted over incident
  const Material* spectrum = nullptr;

  std::size_t channels() const { return index.size(); }
  std::string channel(std::size_t c) const;
  double f0(std::size_t c) const;
};
/// ((n − 1)² + k²)/((n + 1)² + k²)
double f0_of_index(const Index&);
FresnelSurface dielectric(double ior, std::string name);
/// A dielectric with the light in the denser medium.
FresnelSurface dielectric_inside(double ior, std::string name);
FresnelSurface metal(const Material&);
FresnelSurface spectral(const Material&);

/// An approximation and what it is given for a surface.
struct FresnelForm {
  std::string name;
  std::size_t term;
  std::vector<Setting> settings{};  ///< one value, or one a channel
  /// Asked at the cosine on the thinner side; beyond total reflection that is 0.
  bool outer_angle = false;
};

/// The exact F at cosines: [channel][angle].
std::vector<std::vector<double>> exact_values(const FresnelSurface&,
                                              std::span<const double> cosine);
std::vector<double> form_values(const FresnelForm&,
                                const FresnelSurface&,
                                std::size_t channel,
                                std::span<const double> cosine);
/// Every form that can be given to a surface, with parameters from its exact F: F0 at normal incidence,
/// F82's tint at 82°; F90 and Lazányi's correction by least squares over the angle.
std::vector<FresnelForm> forms_for(const FresnelSurface&);

/// θ from 0 to 90° in equal steps, cosines.
struct AngleSteps {
  std::vector<double> theta_deg, cosine;
};
AngleSteps angle_steps(std::size_t steps);

}  // namespace gonio
