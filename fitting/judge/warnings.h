#pragma once
/// \file
/// Warnings that a reader must know before believing a fit's numbers.

#include <cstddef>
#include <string>
#include <vector>

#include "fitting/result/document.h"
#include "fitting/solve/options.h"

namespace gonio {

/// Number of clusters from which on their moves alone tell the errors.
bool enough_angles(std::size_t clusters);

/// \param angles  incident angles of the table   \param free  unknowns
std::vector<std::string> warnings(
    const FitOptions&, const Table&, const FitDocument&, std::size_t angles, std::size_t free);

/// Sentences of a model that returns more light than arrives, or rises far above its table.
std::vector<std::string> physics_in_words(const Physics&);

/// Sentences of a misfit that is told: its size with the angles that it follows, and its place.
std::vector<std::string> misfit_in_words(const Misfit&);

}  // namespace gonio
