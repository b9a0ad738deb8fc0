#pragma once
/// \file
/// The contents of an RGL file, and f_r by them.

#include <memory>
#include <string>
#include <vector>

#include "geometry/direction.h"
#include "table/format/rgl/warp.h"
#include "table/table.h"

namespace gonio::rgl {

/// The fields of a file.  Grids are over u = (√(2 θ/π), φ/2π + ½), the first fastest.
struct Fields {
  std::vector<double> theta_i, phi_i;  ///< [rad]; at most two phi_i: isotropic
  std::vector<std::string> channels;   ///< r, g, b, or wavelengths [nm]
  bool spectral = false;
  bool jacobian = true;
  Image ndf, sigma;  ///< D over a facet's u, and the area that facets show over a direction's
  Image vndf;        ///< [φ_i, θ_i], over a facet's u
  Image data;        ///< [φ_i, θ_i, channel], over the unit square that `vndf` makes even
  std::vector<char> invented;  ///< [φ_i, θ_i][y][x]: 1 where nothing was known; empty: nowhere
};

class Material {
 public:
  /// \param symmetry  parts of a turn that are alike: 1, 2 or 4
  explicit Material(Fields, int symmetry = 1);

  bool isotropic() const { return phi_i.size() <= 2; }
  std::size_t width() const { return data.width; }
  std::size_t height() const { return data.height; }

  struct Sample {
    DirectionPair pair;
    Point u;  ///< of the facet normal, their half vector
  };
  /// The grid point (x, y) of an incident direction.
  Sample sample(std::size_t p, std::size_t t, std::size_t x, std::size_t y) const;
  /// f_r of all channels there, appended to them.
  void values(std::size_t p,
              std::size_t t,
              std::size_t x,
              std::size_t y,
              const Sample& s,
              std::vector<Values>& to) const;

  /// f_r above the horizon as the format interpolates it; \param guard  see rgl_function()
  double at(DirectionPair p, std::size_t channel, bool guard) const;

  std::vector<double> theta_i, phi_i;  ///< [rad]
  int symmetry = 1;
  std::vector<std::string> channels;
  bool spectral, has_jacobian;
  Image ndf, sigma, data;
  std::vector<char> invented;  ///< see Fields
  const Image& vndf() const { return warp_.density(); }

 private:
  double jacobian(const Point& u, double theta, double phi) const;
  double scale_at(const Sample& s, double theta, std::size_t node) const;
  double guarded(double f, const Mix& mix, const Point& s, double cos_o, std::size_t channel) const;
  void fold(DirectionPair& p) const;
  Mix mixed(double phi, double theta) const;

  Warp warp_;
  Image scale_;  ///< [φ_i, θ_i][y][x]: see scale_at()
};

/// The table of a material: its grid points, and what lies between them.
Table table_of(std::shared_ptr<const Material>);
/// The material that a table is the table of, or nullptr.
std::shared_ptr<const Material> material_of(const Table&);

/// Direction of a facet or of light at a point u.
Direction direction_at(const Point& u);
/// wi mirrored at a facet of normal m.
Direction reflected(const Direction& wi, const Direction& m);

}  // namespace gonio::rgl
