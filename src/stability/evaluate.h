#pragma once
/// \file
/// A subject's value at one set of inputs, in a number.

#include <span>
#include <vector>

#include "brdf/in_number/number.h"
#include "stability/evidence.h"
#include "stability/subject.h"

namespace gonio::stability {

/// x as the number holds it.  \param parameter  of mixed numbers parameters are halves, angles floats
double rounded(Number, double x, bool parameter);
/// Inputs as the number holds them.
std::vector<double> rounded(const Subject&, Number, std::span<const double> inputs);

/// Value of a term, or of a model by the product rule in the number; its inputs are rounded to the number first, and its
/// angles follow from them in it.
///
/// \throws Error (wrong usage) of flushing or contraction in another number than half
double value_of(const Subject&, const Arithmetic&, std::span<const double> inputs);
double value_of(const Subject&, Number, std::span<const double> inputs);

/// Value in fifty digits of inputs that are exact as they are, with its condition in these inputs, which costs as many
/// evaluations as there are inputs.  \param condition  else it is 1
WideValue truth_of(const Subject&, std::span<const double> inputs, bool condition = true);

/// Share of the work of a subject of few operations that one of many gets, so that each takes seconds, in (0, 1].
double share_of_cheap(const Subject&);

/// Number's bits, "0x3c00"; of a mixed number's parameters those of the half.
std::string hex(Number, double x, bool parameter);

}  // namespace gonio::stability
