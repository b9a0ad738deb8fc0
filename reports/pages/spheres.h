#pragma once
/// \file
/// Sphere as a table has it and as models fitted to it have it, under three lights.

#include <span>
#include <string>
#include <vector>

#include "brdf/model/model.h"
#include "table/table.h"

namespace gonio {

/// A model's sphere under one light, and how far it is from the table's where the table covers it.
struct ModelSphere {
  std::string picture;  ///< PNG in base64
  /// A byte a pixel in base64: difference_steps to ΔE2000 1, at most most_byte; or one of the two below.
  std::string difference;
  double median = 0, p95 = 0;  ///< ΔE2000 over the pixels compared
  double itp_median = 0;       ///< ΔE_ITP over the same, white at 203 cd/m²
  /// ΔE2000 between the model and what its values at the table's samples give by the table's lookup: what the
  /// samples' spacing alone makes.  NaN where the format defines f everywhere.
  double spacing_median = 0, spacing_p95 = 0;

  static constexpr double difference_steps = 25;
  static constexpr unsigned most_byte = 253, not_covered = 254, beside = 255;
};

/// Spheres under one light.
struct SpheresUnderLight {
  std::string light;
  double covered =
      0;  ///< share of the pixels that light reaches for which the table has all values
  /// Factor of radiance over a light's irradiance: that makes the table's 99th percentile white [sr].
  double exposure = 0;
  std::string table;                ///< PNG in base64; hatched where the table does not cover
  std::vector<ModelSphere> models;  ///< none, and no table, where it covers less than least_share
};

struct Spheres {
  std::size_t pixels = 0;             ///< width and height
  std::vector<std::string> models;    ///< their specs
  std::vector<std::string> channels;  ///< those shown: r, g, b, else four at most
  std::vector<SpheresUnderLight> lights;

  static constexpr double least_share = 1.0 / 3;
  /// Reach of a sample, in wi and in wo, where a table is no grid [°].
  static constexpr double reach_deg = 5;
};

/// \param models  of as many channels as the table
Spheres make_spheres(const Table&, std::span<const BoundModel> models, std::size_t pixels = 160);

}  // namespace gonio
