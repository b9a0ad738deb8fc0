#pragma once
/// \file
/// Scales of pictures: ranges, ticks, numbers as they stand beside them.  For this room only.

#include <string>
#include <utility>
#include <vector>

#include "reports/picture/figure.h"

namespace gonio {

/// Map from values of an axis to a part of its length.
struct FigureScale {
  double low, high;
  bool log;
  bool root = false;
  double part(double value) const;
};

/// Ticks at round numbers, at most about `most`; of decades 1, 2, 5 or 1 where many are seen.
std::vector<double> scale_ticks(const FigureScale&, std::size_t most);
/// "0.05", "20", "2·10⁻⁶"
std::string tick_text(double);

/// Ticks of a figure, at most about.
inline constexpr std::size_t x_ticks_most = 8, y_ticks_most = 7, ticks_few = 4;
/// Ticks of a map, at most about, and of one of several beside each other.
inline constexpr std::size_t map_ticks_most = 7, map_ticks_few = 3;
/// Scales of a figure's axes.  x: the data, or its ends; y: from 0 where that is near, some room above.
FigureScale x_scale(const Figure&);
FigureScale y_scale(const Figure&);

/// Places where cells begin and end: one more than there are cells.
std::vector<double> cell_edges(const FigureMap::Axis&);

/// Colours of a map: the values at their ends, and ticks.
struct ColourScale {
  double low, high;
  std::vector<double> ticks;
};
ColourScale colour_scale(const FigureMap&);
/// Place of a value on the scale of colours, in [0, 1].
double colour_part(const FigureMap&, const ColourScale&, double value);

}  // namespace gonio
