#pragma once
/// \file
/// Confidence bounds that hold whatever the distribution.

#include <cstddef>
#include <vector>

namespace gonio::scene {

/// Upper bound of a probability by which `exceeding` of n independent draws did: with that confidence it is less.
///
///   B⁻¹(confidence; x + 1, n − x)                                               [Clopper & Pearson 1934]
double exceedance_bound(std::size_t exceeding, std::size_t n, double confidence);

/// Lower bound of it: with that confidence it is more.
double exceedance_lower_bound(std::size_t exceeding, std::size_t n, double confidence);

/// Least number of draws of which, if none is beyond a limit, the quantile is shown to keep it.
///
///   n ≥ ln(1 − confidence)/ln(quantile)
std::size_t draws_needed(double quantile, double confidence);

/// Upper bound of a quantile from independent draws: the least of them, in their order, that is above it with that confidence;
/// infinite where no draw is.  \param values  reordered
double quantile_bound(std::vector<double>& values, double quantile, double confidence);

/// Largest share of draws beyond a limit by which n fresh ones still show, with that confidence, that the quantile keeps
/// the limit; 0 where n are too few to show it at all.
double share_that_passes(double quantile, std::size_t n, double confidence);

}  // namespace gonio::scene
