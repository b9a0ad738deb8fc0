#pragma once
/// \file
/// Tolerance of a value's error.

namespace gonio::stability {

/// Error that a value x may have: |x − f| ≤ max(relative · |f|, absolute), with the least number that is asked for where |f| is less.
struct Tolerance {
  double relative, absolute = 0;

  Tolerance(double of_value, double of_all = 0) : relative(of_value), absolute(of_all) {}
};

}  // namespace gonio::stability
