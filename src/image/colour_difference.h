#pragma once
/// \file
/// Difference between two colours as seen: CIELAB and CIEDE2000.

#include <array>

namespace gonio {

/// CIE 1976 L*a*b*: lightness L of 0 to 100, a from green to red, b from blue to yellow.
struct Lab {
  double l, a, b;
};
/// \param white  XYZ of a perfect diffuser in the same light
Lab lab(const std::array<double, 3>& xyz, const std::array<double, 3>& white);

/// ΔE₀₀ with k_L = k_C = k_H = 1; 1 is about what is just seen side by side.
///                                    [CIE 142-2001; Sharma, Wu and Dalal 2005, Eq. 2 to 22]
double delta_e_2000(const Lab&, const Lab&);

}  // namespace gonio
