#pragma once
/// \file
/// Share of the light that a rough surface gives back, by the number of facets that it met.

#include <cstddef>
#include <vector>

namespace gonio {

/// At one direction; each element over channels is one of the model's.
struct Scattered {
  std::vector<double> albedo;              ///< [channel]: what leaves, all orders
  std::vector<double> error;               ///< [channel], of albedo: what each solution says of it
  std::vector<std::vector<double>> order;  ///< [channel][n − 1]: what leaves after n bounces
  std::vector<double> rest;                ///< [channel]: still inside where it was cut off
  std::vector<std::vector<double>> order_error;  ///< [channel][n − 1]; of the walk only
  std::size_t bounces = 0;                       ///< that all walks took
};

}  // namespace gonio
