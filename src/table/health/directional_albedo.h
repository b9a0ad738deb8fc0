#pragma once
/// \file
/// Share of the incoming light that goes out again, as far as a table's samples say.

#include <string>
#include <vector>

#include "table/health/health.h"
#include "table/health/peak.h"

namespace gonio {

/// At one θ_i (φ_i = 0), of a grid or where Table::between says f: by quadrature over f between
/// samples.
AlbedoSample directional_albedo(const Table&, double theta_i_deg);

/// Albedos of a table, and why there are no more.
struct TableAlbedo {
  std::vector<AlbedoSample> known;
  /// Where a narrow highlight may lie between the samples: at least so much light.
  std::vector<AlbedoSample> at_least;
  std::vector<std::string> left_out;  ///< a reason with the angles of incidence that it is of
};
/// Grids, and lists with Table::between: at θ_i = 0, step, 2 step … below 90°, likewise.
/// Other lists: at each incident direction whose samples, mirrored where they go half round, leave less than a twentieth of the
/// cosine-weighted hemisphere further than 12° away, by quadrature over what is interpolated between samples along θ_h, unless
/// its error is then more than a third of it.  No samples exclude a highlight that is narrower than what lies between them and
/// the mirror direction: unless the table resolves a wider one, or shows elsewhere that it has none.
/// An image slice holds no hemisphere: empty.
TableAlbedo albedo_of_table(const Table&, double step_deg, const PeakSearch&);
/// What is known of it.
std::vector<AlbedoSample> albedo_curve(const Table&, double step_deg);
/// By 15°.
std::vector<AlbedoSample> directional_albedo(const Table&);

}  // namespace gonio
