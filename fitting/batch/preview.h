#pragma once
/// \file
/// Small pictures of a table and the model fitted to it, for a page of hundreds.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "brdf/model/model.h"
#include "table/table.h"

namespace gonio {

/// A curve of data and model with few points: those that set its shape.
struct Thumbnail {
  std::string at;  ///< as in Cut
  double at_deg = 0;
  std::string along;
  std::vector<std::size_t> channels;             ///< those shown: all, or four of more
  std::vector<double> data_deg, model_deg;       ///< ascending
  std::vector<std::vector<double>> data, model;  ///< [channel shown][point], 1/sr; NaN: none
};

struct Preview {
  std::optional<Thumbnail> curve;  ///< of the cut nearest to 30°; absent if no cut shows data
  /// ∫ f cos θ_i dω_i of the model at θ_o = 30°, per channel: its colour in white light from everywhere.
  std::vector<double> albedo;
  /// A sphere of the model, `size` pixels high: its right half, row by row, three bytes of sRGB per
  /// pixel; 0 outside the disc.  The left half mirrors it: the light stands above the viewer, 40° from
  /// them, over a uniform sky; together they make a white Lambertian that faces the light white.
  /// Channels other than r, g, b show as the grey of their mean.  In base64.
  std::string sphere;
  static constexpr std::size_t size = 36;
};

Preview make_preview(const Table&, const BoundModel& fitted);

}  // namespace gonio
