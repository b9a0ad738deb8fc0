#pragma once
/// \file
/// Difference between two colours as seen: CIELAB and CIEDE2000, and ΔE_ITP for more light than a display's white.

#include <array>

namespace gonio {

/// ΔE2000 up to which nobody sees a difference, even side by side: the unit that CIEDE2000 is scaled to.  [CIE 142-2001]
inline constexpr double just_seen = 1;
/// ΔE2000 up to which a difference is seen only side by side, taken from what observers just saw in CIELAB.
///                                                  [Mahy, Van Eycken and Oosterlinck 1994]
inline constexpr double side_by_side = 2.3;

/// CIE 1976 L*a*b*: lightness L of 0 to 100, a from green to red, b from blue to yellow.
struct Lab {
  double l, a, b;
};
/// \param white  XYZ of a perfect diffuser in the same light
Lab lab(const std::array<double, 3>& xyz, const std::array<double, 3>& white);

/// ΔE₀₀ with k_L = k_C = k_H = 1; 1 is about what is just seen side by side.
///                                    [CIE 142-2001; Sharma, Wu and Dalal 2005, Eq. 2 to 22]
double delta_e_2000(const Lab&, const Lab&);

/// Light's intensity I, and its difference from yellow to blue T and from green to red P, each by what the eye tells apart over
/// five decades [ITU-R BT.2100-2, IC_T C_P; BT.2124-0: T = C_T/2].
struct Itp {
  double i, t, p;
};
/// \param rgb  linear light with BT.709's primaries [cd/m²]; negative is dark, 10 000 the most
Itp itp(const std::array<double, 3>& rgb);

/// ΔE_ITP = 720 √(ΔI² + ΔT² + ΔP²); 1 is about what is just seen.                   [ITU-R BT.2124-0]
double delta_e_itp(const Itp&, const Itp&);

}  // namespace gonio
