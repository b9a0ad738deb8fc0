#pragma once
/// \file
/// BSDF of windows and shades in LBNL's XML, on Klems' patches or as a tensor tree.

#include <string_view>

#include "base/file.h"
#include "table/table.h"

namespace gonio {

/// True where XML with a WindowElement begins.
bool is_klems(std::string_view head);

/// The file's AngleBasis cuts the hemisphere into rings of θ, each into nPhis patches of equal azimuth,
/// the first centred on φ = 0.  Values are f_r averaged over the solid angles of an incident and an
/// outgoing patch [1/sr, without the cosine]; a sample sits in its patches' centres, the polar patch's
/// being the pole.  IncidentDataStructure Columns: rows of the matrix are outgoing, Rows: incident.
/// Incident azimuths count along the light, so wi is at φ + 180° and patch k mirrors into patch k.
///
/// IncidentDataStructure TensorTree3 or TensorTree4: see table/format/tensor_tree.h.
///
/// A table holds reflection of one side: front, or back where the front is missing, turned about x so
/// that its normal is +z; transmission has no place in it.  Of several wavelength bands it takes
/// Visible, else the first.  Which it was is in the notes.
///
/// All weights are 1: Klems cut patches of nearly the same projected solid angle (0.018 to 0.024 sr in
/// the full basis), each is one measurement, and a fit's metrics weight no sample of another format by
/// what it covers either.  A lobe narrower than a patch is averaged away; Table::patch_deg is the
/// side of a square of the mean solid angle (12° in the full basis), and find_peak() calls a peak that
/// falls by half within it not resolved.  Table::between is the patches' own
/// value: constant over each.
/// [Klems 1994, ASHRAE Transactions 100(1); LBNL WINDOW's XML, schema BSDF-v1.4]
Table read_klems(InputFile&);

}  // namespace gonio
