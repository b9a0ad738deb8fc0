#pragma once
/// \file
/// Previews in a document.

#include "base/describe.h"
#include "fitting/batch/preview.h"

namespace gonio {

template <>
struct Description<Thumbnail> {
  static constexpr auto fields() {
    return std::tuple{
        field("at", &Thumbnail::at, "angle that the curve is at"),
        field("at_deg", "°", &Thumbnail::at_deg, ""),
        field("along", &Thumbnail::along, "angle that varies along the curve"),
        field("channels", &Thumbnail::channels, "channels shown: all, or four of more"),
        field("data_deg", "°", &Thumbnail::data_deg, "places of the data, ascending"),
        field("data", "1/sr", &Thumbnail::data, "data by channel and place"),
        field("model_deg", "°", &Thumbnail::model_deg, "places of the model, ascending"),
        field("model", "1/sr", &Thumbnail::model, "model by channel and place")};
  }
};

template <>
struct Description<Preview> {
  static constexpr auto fields() {
    return std::tuple{
        field("curve", &Preview::curve, "null where no cut shows data"),
        field("albedo", &Preview::albedo, "albedo of the model at 30°, by channel"),
        field(
            "sphere", &Preview::sphere,
            "right half of a sphere of the model, 36 rows of 18 pixels of sRGB, three bytes each, "
            "in base64")};
  }
};

}  // namespace gonio
