#pragma once
/// \file
/// Places where the audit looks at the catalogue: values of parameters, and pairs of directions.

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "brdf/term/term.h"
#include "geometry/angles.h"
#include "number/parameter.h"

namespace gonio::auditing {

using Row = FrameAngles<double>;
using Values = std::vector<double>;

/// Values of a parameter, both ends of its range among them.
Values looked_at(const Parameter&);
/// All combinations of such values, or of others.
std::vector<Values> combinations(std::span<const Parameter>,
                                 const std::function<Values(const Parameter&)>& at = looked_at);
Values defaults(std::span<const Parameter>);

Row row(double theta_i, double phi_i, double theta_o, double phi_o);
Row exchanged(Row);

/// Direction pairs over the hemisphere, even in both cosines from 0.05 to 1, some with the surface
/// turned.
const std::vector<Row>& pairs();
/// Half vectors from the peak to the horizon, along the tangent, the bitangent and between.
const std::vector<Row>& half_vectors();
/// Light and view at the same angle, from the normal to the horizon.
const std::vector<Row>& cosines();
/// Of these the ones that terms of a role are looked at with.
const std::vector<Row>& rows_of(Role);
/// Normal, middle and grazing directions with half vectors from the peak to the horizon; but for both
/// directions at the horizon, which is outside the domain.
const std::vector<Row>& ends();

/// "alpha 0.1, f0 0.04"
std::string text(std::span<const Parameter>, std::span<const double> values);
/// "NoL 0.5, NoV 0.1, …"
std::string text(const Row&);
std::string joined(const std::string& a, const std::string& b);

}  // namespace gonio::auditing
