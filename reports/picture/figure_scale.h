#pragma once
/// \file
/// Scales of pictures: ranges, ticks, numbers as they stand beside them.  For this room only.

#include <string>
#include <utility>
#include <vector>

#include "reports/picture/figure.h"

namespace gonio {

/// Values of an axis to a part of its length.
struct FigureScale {
  double low, high;
  bool log;
  double part(double value) const;
};

/// At most about `most` ticks at round numbers; of decades 1, 2, 5 or 1 where many are seen.
std::vector<double> scale_ticks(const FigureScale&, std::size_t most);
/// "0.05", "20", "2·10⁻⁶"
std::string tick_text(double);

/// What the axes of a figure show.  x: the data, or its ends; y: from 0 where that is near, some room above.
FigureScale x_scale(const Figure&);
FigureScale y_scale(const Figure&);

/// Where cells begin and end: a place more than there are cells.
std::vector<double> cell_edges(const FigureMap::Axis&);

/// Colours of a map: the values at their ends, and ticks.
struct ColourScale {
  double low, high;
  std::vector<double> ticks;
};
ColourScale colour_scale(const FigureMap&);
/// Of a value, on the scale of colours in [0, 1].
double colour_part(const FigureMap&, const ColourScale&, double value);

}  // namespace gonio
