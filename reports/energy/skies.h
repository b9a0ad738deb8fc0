#pragma once
/// \file
/// Skies by formula: light for the split sum that needs no file.

#include <vector>

#include "reports/finding/report.h"

namespace gonio {

/// Radiance of 1 from everywhere, under which the split sum is exact.
Environment even_light();
/// A sky under clouds; a clear one with its sun; a room lit by a window.  As maps of 256 × 128 texels.
std::vector<ReportOptions::Light> synthetic_skies();

/// Factor of radiance by which a display shows a white ball, on average over its normals, at half of its white: the mean radiance of
/// a map is then 1/2.
double exposure_for(const Environment&);

}  // namespace gonio
