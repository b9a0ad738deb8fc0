#pragma once
/// \file
/// Guess at what the columns of a CSV file are, from their names and ranges: shown to the user, who
/// says it or says otherwise; nothing is read by it.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "table/format/column_map.h"
#include "table/format/csv.h"

namespace gonio {

struct ColumnProposal {
  /// Map that names every angle and a value; none where a zenith angle or the value cannot be told.
  std::optional<ColumnMap> map;
  bool needed = true;  ///< false where the columns have these names already
  std::vector<std::string>
      said;  ///< reasons for what a name alone does not say, or what is missing
};

/// By name a column is a zenith angle ("theta", "zenith", "aoi" …) or an azimuth ("phi", "azimuth" …) of the
/// light ("i", "in", "source" …) or of the viewer ("o", "r", "out", "detector" …), a half or a difference angle, a value
/// ("f", "brdf" …), its uncertainty ("uBRDF", "std", "U (k=2)", "unc [%]") or a wavelength.  Ranges then correct it: where a
/// zenith angle exceeds 90° and no azimuth does, they have changed names; angles that all stay within 2π, zenith angles within
/// π/2, are radians.  Columns whose names are angles, one after the other, are a matrix.  An incident angle that no column has
/// may stand in the file's name ("sample_30deg", "thetai30") or above the table ("# Angle of incidence: 30").
/// \param file  its name  \param head  its beginning
ColumnProposal propose_columns(std::span<const ColumnSummary>,
                               const std::string& file = "",
                               std::string_view head = "");

/// Proposes --forward 0 for signed angles in one plane whose highlight has the light's sign.
/// \param table  as the proposal's map reads it
void propose_forward(ColumnProposal&, const Table& table);

}  // namespace gonio
