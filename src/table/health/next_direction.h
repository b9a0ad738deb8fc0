#pragma once
/// \file
/// Direction to measure next, and what it does to the least known parameter.

#include <string>

namespace gonio {

/// Row of a plan: a pair of directions [°] whose measurement narrows `parameter`, the least known when it was chosen.
struct NextDirection {
  double theta_i_deg = 0, phi_i_deg = 0, theta_o_deg = 0, phi_o_deg = 0;
  std::string parameter;  ///< "alpha", "f0.r"
  /// Widths of its 95 % interval, in the parameter's own unit, before and after that measurement; NaN where there is none.
  double width_before = 0, width_after = 0;
  double over = 0;  ///< what widths are compared over: the parameter's value, or a hundredth of its
                    ///< range where that is more
};

/// "0.02 (10 %)": a width, and that over the value; "not known" of NaN.
std::string width_in_words(const NextDirection&, double width);

}  // namespace gonio
