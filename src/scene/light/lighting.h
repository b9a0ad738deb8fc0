#pragma once
/// \file
/// Light that comes to a point of a surface, by directions drawn for the lobes that look at it.

#include <cstddef>
#include <span>
#include <variant>
#include <vector>

#include "base/random.h"
#include "geometry/direction.h"
#include "geometry/sampling.h"
#include "image/environment.h"
#include "scene/description/scene.h"
#include "scene/trace/tracer.h"

namespace gonio::scene {

/// Light from a direction: radiance towards a viewer gains f(direction, viewer) weight.
struct Incident {
  Direction direction;  ///< of the world
  Rgb weight;           ///< radiance × cosine/density, what is occluded left out
  bool of_sky = false;  ///< comes from an environment
};

/// Part of a set of directions that several calls share, each with the draws of the first.
struct Part {
  std::size_t index = 0, all = 1;
};

/// Lights of a scene, ready to be drawn from.  Rectangles and environments are drawn from by the balance heuristic
/// [Veach & Guibas 1995]: half of the directions by the light (a point of the rectangle; a texel by its luminance), the
/// others by lobes, in equal shares: of GGX's visible normals, and under an environment by the cosine.
///
/// It looks into the scene, which outlives it.  All calls may come from many threads.
class Lighting {
 public:
  /// \param tracer  what casts shadows; nullptr: nothing does
  Lighting(const Scene&, const Tracer* tracer);

  /// Appends directions above the horizon: one of each directional light, drawn evenly in elevation and azimuth where it
  /// ranges, and of each other light `count` that are spread evenly.  None where the viewer is below the horizon.
  ///
  /// \param widths  of the lobes, from Look::widths()
  /// \param part    of `count` × its parts that are spread evenly together, as over the points of one pixel
  void incident(const Vector& position,
                const Frame&,
                const Direction& to_viewer,
                std::span<const double> widths,
                std::size_t count,
                Draws&,
                std::vector<Incident>& out,
                Part = {}) const;

 private:
  struct Rectangle {
    RectangleLight light;
    Direction normal;
    double area;
  };
  /// Environment, and shares of its luminance: of rows, and of texels within each of them.
  struct Sky {
    const EnvironmentLight* light;
    std::vector<double> rows;   ///< [j]: up to row j's end
    std::vector<float> within;  ///< [j * width + i]: up to texel i's end
  };
  class Point;
  class Spread;
  class FromRectangle;
  class FromSky;
  static Sky sky_of(const EnvironmentLight&);
  void add_from(const DirectionalLight&, const Point&, const Spread&, std::vector<Incident>&) const;
  template <class Source>
  void add_from(const Source&, const Point&, const Spread&, std::vector<Incident>&) const;

  std::vector<std::variant<DirectionalLight, Rectangle, Sky>> lights_;
  const Tracer* tracer_;
};

}  // namespace gonio::scene
