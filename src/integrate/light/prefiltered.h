#pragma once
/// \file
/// Maps that image-based light looks up: an environment under GGX's lobe about each direction, and its irradiance.

#include <array>
#include <cstddef>
#include <vector>

#include "geometry/direction.h"
#include "image/environment.h"

namespace gonio {

/// Environment as patches, each of up to four smaller ones: what a wide lobe gathers needs few of them.
class LightPyramid {
 public:
  explicit LightPyramid(const Environment&);

  struct Patch {
    Rgb flux{};              ///< ∫ L dω
    Direction centre;        ///< of its light, weighted by R + G + B
    double solid_angle = 0;  ///< [sr]
    double width = 0;        ///< greatest extent [rad]
  };
  struct Level {
    std::size_t width = 0, height = 0;
    std::vector<Patch> patch;  ///< [j * width + i]
  };
  /// From the finest, at most 512 × 256, up to one of 2 × 1 or less.
  const std::vector<Level>& levels() const { return levels_; }

 private:
  std::vector<Level> levels_;
};

/// Radiance by direction: a map over longitude and latitude, read between its four nearest texels.
class FilteredLight {
 public:
  Rgb operator()(const Direction&) const;

 private:
  friend FilteredLight prefiltered(const LightPyramid&, double alpha);
  friend FilteredLight mean_radiance(const LightPyramid&);
  template <class Weight>
  static FilteredLight gathered(const LightPyramid&,
                                std::size_t height,
                                double width,
                                const Weight&);

  Environment map_;
};

/// P(r) = ∫ L D NoL dω / ∫ D NoL dω with n = v = r [Karis 2013].  A patch counts as one direction where it is at most a quarter as
/// wide as the lobe is there.  Under even light it is exact.
/// \param alpha  a lobe narrower than 0.01, about a patch, is taken for that wide
FilteredLight prefiltered(const LightPyramid&, double alpha);

/// E(n)/π, irradiance as the radiance of an even environment that gives as much.
FilteredLight mean_radiance(const LightPyramid&);

}  // namespace gonio
