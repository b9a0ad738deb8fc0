#pragma once
/// \file
/// Fifty decimal digits: the truth that the other numbers are judged by.
///
/// Costs five seconds in every file that includes it, so few do.  Constants of formulas come as long
/// double (real.h), so where a formula has others than fractions of two, it has their first 19 digits;
/// π has all.

#include "number/real.h"

#include <boost/multiprecision/cpp_bin_float.hpp>

namespace gonio {

/// Expression templates off: `auto x = a * b` must be a number.
using Wide = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>,
                                           boost::multiprecision::et_off>;

inline namespace GONIO_ARCH {

template <>
struct RealTraits<Wide> {
  using Base = Wide;
  using Plain = Wide;
  using Mask = bool;
  static Wide select(bool m, const Wide& a, const Wide& b) { return m ? a : b; }
};

template <>
inline Wide pi<Wide>() {
  return boost::math::constants::pi<Wide>();
}

}  // namespace GONIO_ARCH
}  // namespace gonio
