#pragma once
/// \file
/// Places where the atlas looks at forms by their width, and what it finds there: for its pictures.

#include <string_view>
#include <vector>

#include "stability/evaluate.h"

namespace gonio::stabilities {

using Inputs = std::vector<double>;

/// n values from low to high, each by the same factor.
std::vector<double> in_logarithms(double low, double high, std::size_t n);
/// The subject of a term whose angles are given so.
stability::Subject one_subject(std::string_view id, std::string_view given);

}  // namespace gonio::stabilities
