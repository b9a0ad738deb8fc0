#pragma once
/// \file
/// The parts of schlick_report(), each filling its own.

#include <functional>

#include "reports/measure/surfaces.h"
#include "reports/schlick/schlick.h"

namespace gonio {

/// Every form on a surface.  \param steps  equal steps of θ
std::vector<FresnelRow> rows_of(const FresnelSurface&, std::size_t steps);

void add_rows(SchlickReport&, const SchlickOptions&, const std::function<void(double)>& done);
void add_maps(SchlickReport&);
void add_curves(SchlickReport&);
void add_albedos(SchlickReport&, const SchlickOptions&, const std::function<void(double)>& done);
/// From what the others have filled in.
void add_findings(SchlickReport&);

}  // namespace gonio
