#pragma once
/// \file
/// Previews in a document.

#include "base/describe.h"
#include "fitting/batch/preview.h"

namespace gonio {

template <>
inline constexpr auto description<Thumbnail> =
    FieldList{Field{"at", &Thumbnail::at, "angle that the curve is at"},
              Field{"at_deg", "°", &Thumbnail::at_deg, ""},
              Field{"along", &Thumbnail::along, "angle that varies along the curve"},
              Field{"channels", &Thumbnail::channels, "channels shown: all, or four of more"},
              Field{"data_deg", "°", &Thumbnail::data_deg, "places of the data, ascending"},
              Field{"data", "1/sr", &Thumbnail::data, "data by channel and place"},
              Field{"model_deg", "°", &Thumbnail::model_deg, "places of the model, ascending"},
              Field{"model", "1/sr", &Thumbnail::model, "model by channel and place"}};

template <>
inline constexpr auto description<Preview> = FieldList{
    Field{"curve", &Preview::curve, "null where no cut shows data"},
    Field{"albedo", &Preview::albedo, "albedo of the model at 30°, by channel"},
    Field{"sphere", &Preview::sphere,
          "right half of a sphere of the model, 36 rows of 18 pixels of sRGB, three bytes each, "
          "in base64"}};

}  // namespace gonio
