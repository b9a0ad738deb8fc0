#pragma once
/// \file
/// Lit spheres of the page of `gonio explore`.  Compiled twice, as surface.h is.

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "brdf/model/evaluate.h"
#include "explore/surface.h"
#include "image/lit_sphere.h"
#include "scene/light/lighting.h"

namespace gonio::explore {

struct SphereDifference {
  double median = 0, p95 = 0;  ///< ΔE2000
  double covered =
      0;  ///< share of the pixels looked at; 0 without any, and then the others are 0, too
};

/// A sphere under directional lights of equal irradiance, prepared once for many surfaces.
class Sphere {
 public:
  /// \param towards  the lights, in the viewer's frame: x to the right, y up, z to the viewer
  Sphere(std::size_t pixels, std::span<const Direction> towards);
  /// Bytes of its radiance over one light's irradiance, exposed; transparent beside the sphere and where a table has no value. Where
  /// light grazes, at less than 5°, little arrives and tables end: no value is 0 there.
  void draw(const Surface&, double exposure, std::span<unsigned char> rgba) const;
  /// ΔE2000 between two spheres as a display shows them, over every seventh pixel and light where both are known.
  SphereDifference difference(const Surface&, const Surface& reference, double exposure) const;

 private:
  LitSphere lit_;
  AngleColumns<float> columns_;
};

/// Lights that extend, in the viewer's frame. A surface that faces the middle of one at its distance, and nothing in between, has an
/// irradiance of 1.
struct WideLight {
  std::string_view name;
  scene::Scene scene;  ///< the light, nothing else
};
/// Softbox: a square of 53°, in front of the sphere to the right above. Sky and sun: a bright sky over dim ground, and a sun
/// of 12° across.
const std::vector<WideLight>& wide_lights();

/// A sphere under a light that extends, of one surface: gathered in passes, so that its picture converges while it is watched.
/// The sphere casts no shadow but on its far side.
class WideSphere {
 public:
  static constexpr std::size_t passes = 64;  ///< all that there are

  WideSphere(std::size_t pixels, std::size_t light);
  /// One more direction for each pixel, drawn as `gonio render` draws it; answers how many passes were gathered.
  std::size_t gather(const Surface&);
  /// Mean radiance of the passes, by channel and pixel; NaN beside the sphere. Light from where a table has no value is
  /// left out.
  Channels radiance() const;

 private:
  struct Point {
    std::size_t pixel;
    Frame frame;
  };
  const scene::Lighting& lights_;
  std::size_t pixels_, done_ = 0;
  std::vector<Point> points_;  ///< of the sphere
  Channels sums_;
};

}  // namespace gonio::explore
