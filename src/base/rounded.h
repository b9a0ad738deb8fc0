#pragma once
/// \file
/// Numbers as text that claims no more than they do: bounds rounded outwards, shares as they were given.

#include <string>

namespace gonio {

/// A number to so many digits, never below it: "0.004" of 0.00391.  A limit from which on something holds stays one where it is read.
std::string rounded_up(double, int digits = 2);
/// A number to so many digits, never above it: "1.4" of 1.4502, for "more than".  \param x  not negative
std::string rounded_down(double x, int digits = 2);
/// A share that somebody gave, in percent with all its digits: "99.5" of 0.995.
std::string in_percent(double share);

}  // namespace gonio
