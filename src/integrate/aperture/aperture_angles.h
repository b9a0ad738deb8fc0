#pragma once
/// \file
/// Few angles for the many that an instrument averages over.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "geometry/aperture.h"
#include "geometry/half_difference.h"

namespace gonio {

/// Angles and weights by which what an instrument reports becomes a sum:
///
///   mean of f = ∫∫ f NoL NoV dω_i dω_o / ∫∫ NoL NoV dω_i dω_o ≈ Σ_k w_k f(angles_k),   Σ_k w_k = 1
///
/// over the cones of light and detector.  f may change as fast as any lobe with θ_h, slowly with all else.  So the measure of θ_h
/// under both cones becomes a Gauss rule in ln sin θ_h: where the cones hold the peak, one for each octave down to 1/1000 of their
/// width, so that no lobe is too narrow for it; and each angle of a rule has the mean of the others' cosines, in slices of the cones
/// where these change much.  Against the integral, GGX lobes of alpha ≥ 1/8 of a cone's width are off by less than 1 % (RMS, 3 % at
/// most) for cones up to 40° and θ_i up to 75°.
///
/// Directions below the horizon add nothing.  The same whatever the threads.
class ApertureAngles {
 public:
  /// \param frame  with the tangent frame's angles, which anisotropic models read: rules are made by the azimuth of h, too
  ApertureAngles(std::size_t samples,
                 const std::function<DirectionPair(std::size_t)>& directions,
                 const Aperture&,
                 bool frame);
  /// Angles of sample i: begin(i) to end(i).
  std::size_t begin(std::size_t i) const { return i == 0 ? 0 : end_[i - 1]; }
  std::size_t end(std::size_t i) const { return end_[i]; }
  double weight(std::size_t k) const { return weights_[k]; }
  const FrameAngles<double>& angles(std::size_t k) const { return angles_[k]; }

 private:
  std::vector<FrameAngles<double>> angles_;
  std::vector<double> weights_;
  std::vector<std::uint32_t> end_;
};

}  // namespace gonio
