#pragma once
/// \file
/// Forms that shaders have by a slip: those that no factor and no map of a width turn into one of the catalogue.

#include <span>
#include <string>

#include "reports/measure/samples.h"

namespace gonio {

/// The slip by which values over rows are F at that F0, a sentence; empty where they are that of none.
/// \param of_model  of a whole model, which has other cosines, too
std::string fresnel_slip(double f0,
                         std::span<const auditing::Row>,
                         std::span<const double> values,
                         bool of_model);

/// The slip by which a distribution, a masking or a Fresnel function of a file is none of ours, a sentence; empty where none is known.
std::string slip_form(std::size_t foreign_term);

}  // namespace gonio
