#pragma once
/// \file
/// Places where the atlas looks at forms by their width, and what it finds there: for its pictures.

#include <vector>

#include "stability/evaluate.h"

namespace gonio::stabilities {

using Inputs = std::vector<double>;

/// n values from low to high, each by the same factor.
std::vector<double> in_logarithms(double low, double high, std::size_t n);

}  // namespace gonio::stabilities
