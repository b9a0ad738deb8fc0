#pragma once
/// \file
/// Fits of tables whose values are known up to one factor: counts of a detector, voltages, a reference that nobody wrote down.
///
/// A factor on all values is one on kd and on a lobe's weight, and changes no width and no Fresnel curve. So each lobe gets a
/// weight, the table is brought to a scale at which weights and kd lie within their ranges, and what is fitted of them stands only
/// relative to each other.

#include <span>
#include <string>
#include <vector>

#include "brdf/model/model.h"
#include "fitting/judge/uncertainty.h"
#include "fitting/result/document.h"
#include "fitting/solve/options.h"
#include "fitting/solve/problem.h"
#include "fitting/solve/search.h"
#include "table/table.h"

namespace gonio {

/// The model with a weight for each lobe, as schlick.weighted.  Throws wrong usage where a factor on all values is none on the
/// model's kd and weights, and where one of these is held.
FitOptions with_weights(FitOptions);
/// Those of several models that can have weights, each once.  Throws wrong usage where none can.
std::vector<std::string> with_weights(const FitOptions&, std::span<const std::string> models);

/// How far each free parameter but kd and weights moves where the scale is free, of a list whose values a free scale brings far nearer to
/// the model: whoever does not know that has intervals around the wrong values.  Empty of others.
/// \param here  log RMS with the scale as it is
std::vector<double> moved_by_scale(const Table&, const Problem&, const Fitted&, double here);

/// Takes the bounds from kd and weights of a fit whose table is of another scale.
void leave_unbounded_by_scale(const Problem&, std::span<const double> values, Uncertainty&);

/// Factor on a table's values that brings kd and weights of its fit into their ranges.
double working_factor(const Table&);
/// True where one of them ended next to the end of its range: a smaller factor may serve.
bool is_scale_too_large(const BoundModel& fitted);

/// Puts kd and weights, and the fit's RMS, on the scale of the table that was multiplied; takes their values and the albedo out of
/// the document; adds their ratios.
void leave_scale_open(FitDocument&, BoundModel& fitted, double factor);

}  // namespace gonio
