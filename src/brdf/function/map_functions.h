#pragma once
/// \file
/// Maps as functions over a number T of any kind, as functions.h has the terms.

#include <span>
#include <vector>

namespace gonio {

/// A map: one value per output.
template <class T>
using MapFunction = std::vector<T> (*)(std::span<const T> parameters);

/// All, in the order of the catalogue; compiled for Traced<float> and Traced<Half>.
template <class T>
std::span<const MapFunction<T>> map_functions();

}  // namespace gonio
