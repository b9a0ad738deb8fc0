#pragma once
/// \file
/// Warnings that a reader must know before believing a fit's numbers.

#include <cstddef>
#include <string>
#include <vector>

#include "fitting/result/document.h"
#include "fitting/solve/options.h"

namespace gonio {

/// With few clusters the sums of their scores say too little: at the optimum they add up to zero.
bool enough_angles(std::size_t clusters, std::size_t free);

/// \param angles  incident angles of the table   \param free  unknowns
std::vector<std::string> warnings(
    const FitOptions&, const Table&, const FitDocument&, std::size_t angles, std::size_t free);

}  // namespace gonio
