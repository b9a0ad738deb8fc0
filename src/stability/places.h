#pragma once
/// \file
/// Places of a number's values in their order: neighbours are one apart, 0 has place 0.

#include <cstdint>

#include "brdf/in_number/number.h"
#include "number/parameter.h"

namespace gonio::stability {

/// Place of x, a value of the number.  \param parameter  as in `rounded` (evaluate.h)
std::int64_t place_of(Number, double x, bool parameter);
double at_place(Number, std::int64_t place, bool parameter);

/// First and last place within a range; where it holds none, that of the value next to its lower end.
struct Places {
  std::int64_t first, last;
};
Places places_within(Number, const Range&, bool parameter);

}  // namespace gonio::stability
