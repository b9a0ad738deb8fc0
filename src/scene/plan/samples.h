#pragma once
/// \file
/// Points of a material that viewers see, each with all the light that comes to it.

#include <cstdint>
#include <optional>
#include <vector>

#include "base/random.h"
#include "brdf/model/evaluate.h"
#include "scene/description/scene.h"
#include "scene/light/lighting.h"
#include "scene/plan/bounds.h"
#include "scene/surface/evaluate.h"
#include "scene/trace/camera.h"
#include "scene/trace/tracer.h"

namespace gonio::scene {

/// Points drawn one independent of the other, and a row for each direction that light comes from: its radiance is the sum of
/// f · weight over its rows.
struct LitPoints {
  std::size_t count = 0;
  std::vector<FrameAngles<double>> angles;  ///< [row]
  std::vector<std::uint32_t> point;         ///< [row]
  std::vector<Rgb> weight;                  ///< [row]
  std::size_t sky = 0;        ///< row of the first of those of an environment, which come last
  std::vector<SkyView> view;  ///< [point]; where there is an environment
};

/// Columns of rows in double and in float.
struct LitColumns {
  AngleColumns<double> wide;
  AngleColumns<float> narrow;

  explicit LitColumns(std::span<const FrameAngles<double>>);
};

/// Radiance of every point.  Where the surface looks an environment up, the rows of that are left out.
/// \param off  gets what it is with two standard errors more of the light between facets, at each point
std::vector<Rgb> radiance(const Surface&,
                          const LitPoints&,
                          const LitColumns&,
                          std::vector<Rgb>* off = nullptr);

/// Drawer of points of one material, and of those that are the same.
///
/// A point is seen through a place drawn evenly over the picture of a camera that is drawn from those of the scene.  For half of the
/// points four are drawn, and one of them taken by how near to a lobe's peak its normal is: highlights, where materials differ
/// most, are small.
class PointDrawer {
 public:
  /// \param same_as     by material, as Lit has it
  /// \param widths      of the material's lobes
  /// \param directions  of each light that has an extent
  PointDrawer(const Scene&,
              std::size_t material,
              const std::vector<std::size_t>& same_as,
              std::vector<double> widths,
              const Tracer&,
              const Lighting&,
              std::size_t directions);
  /// Points first … first + count − 1 of a stream; the same whatever else was drawn.
  LitPoints draw(std::uint64_t stream, std::size_t first, std::size_t count) const;
  /// Share of the picture that the material is seen in, by 16 384 looks; 0: no points are drawn.
  double coverage() const { return coverage_; }
  /// Directions of each light that has an extent.
  std::size_t directions() const { return directions_; }
  /// Drawer of the same points with another number of directions.
  PointDrawer with_directions(std::size_t n) const {
    PointDrawer other = *this;
    other.directions_ = n;
    return other;
  }

 private:
  struct Seen {
    Hit hit;
    Direction to_viewer;
  };
  std::optional<Seen> look_once(Draws&) const;
  std::optional<Seen> look(Draws&) const;
  bool moved_into_parts(double& x, double& y, Draws&) const;
  double near_peak(const Seen&) const;

  const Scene& scene_;
  std::size_t material_, directions_;
  const std::vector<std::size_t>& same_as_;
  std::vector<double> widths_;
  std::vector<BoundingSphere>
      bounds_;  ///< of the material's objects: rays past all of them are not traced
  /// Parts of the picture that hold these, of a camera that stands still and where they are small: places are drawn there.
  std::vector<PicturePart> parts_;
  std::vector<double> area_before_;  ///< up to the end of each part
  double coverage_ = 0;
  const Tracer& tracer_;
  const Lighting& lighting_;
};

/// Scene with the looks of its materials, and what rays and light need of it.
///
/// Materials that are the same but for their names are one: its points are those of all their objects.
struct Lit {
  const Scene& scene;
  std::vector<std::size_t> same_as;  ///< by material: the first that is the same
  std::vector<Look> looks;           ///< by material, under the scene's environment
  Tracer tracer;
  Lighting lighting;

  explicit Lit(const Scene&);
  /// Materials are the same where they have the same forms, too.
  void tell_apart(const std::vector<std::optional<Forms>>& by_material);
  bool is_seen(std::size_t material) const;  ///< an object has it, or one that is the same
  /// \param directions  of each light that has an extent; fewer where these are many
  PointDrawer drawer(std::size_t material, std::size_t directions) const;
};

}  // namespace gonio::scene
