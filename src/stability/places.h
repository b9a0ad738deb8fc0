#pragma once
/// \file
/// Values of a number: their range, and their places in order, neighbours one apart, 0 at place 0.

#include <cstdint>

#include "brdf/in_number/number.h"
#include "number/parameter.h"

namespace gonio::stability {

/// Place of x, a value of the number.  \param parameter  as in `rounded` (evaluate.h)
std::int64_t place_of(Number, double x, bool parameter);
double at_place(Number, std::int64_t place, bool parameter);

/// Largest finite value of a number; of mixed ones that of a float, which results are.
double largest(Number);
/// Exponent of its least normal value.
int least_exponent(Number);

/// First and last place of a range, whose ends are rounded to nearest as a shader's constants are; what is above 0 stays
/// above.
struct Places {
  std::int64_t first, last;
};
Places places_within(Number, const Range&, bool parameter);

}  // namespace gonio::stability
