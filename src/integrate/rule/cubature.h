#pragma once
/// \file
/// Adaptive Gauss–Kronrod quadrature of a few functions at once, over the rectangles of a plane or
/// the intervals of a line, with a bound of its error.

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace gonio {

/// When to stop: at an absolute error, or after so many evaluations.
struct Goal {
  double error = 1e-8;
  std::size_t evaluations = 4'000'000;
};

/// Integrals with one bound for the error of each: over the rectangles, along both axes, the sum of
///
///   |Kronrod − Gauss|, the error of the lesser rule; but at least the square of the relative error of a third rule,
///   on the 8 nodes that Gauss lacks, since the first two may agree by chance;
///   where Gauss's error is a tenth of the third rule's or more, there is a kink: 4 times the larger of these
///   two errors, and at least 1/1024 of the whole's error in each of its halves
///
/// and what summing rounds off.  It is true where the nodes see the function: a kink between the last
/// node and the end of the first rectangles is not seen (of max(x − a, 0) on a line, a drawn at random,
/// 4 to 9 % of the bounds were too small; of kinks across a plane 3 in 200 at goals of 1e-4 and 1e-6, none
/// at 1e-8).  Not reached within the evaluations allowed: the bound says what was.
///
/// Infinite, with the integral's sign, where halving a rectangle time and again leaves as much in one
/// half: a singularity belongs at 0, where numbers are densest.  Not a number where a value was none.
struct Integral {
  std::vector<double> value;
  double error = 0;
  std::size_t evaluations = 0;
};

struct Rectangle {
  std::array<double, 2> low, high;  ///< of a line, low[1] = high[1] = 0
};

/// Nodes on a line of constant y.
inline constexpr std::size_t line_nodes = 15;

/// f at lines of 15 points: y has one value a line, x has 15; out[function] is as long as x.
using Integrand = std::function<void(
    std::span<const double> x, std::span<const double> y, std::span<double* const> out)>;

/// Rectangles are split where the error is, many at a time, so that an integrand sees long columns; the
/// result does not depend on threads.
Integral integrate(const Integrand& f,
                   std::size_t functions,
                   std::vector<Rectangle> rectangles,
                   const Goal& goal);

}  // namespace gonio
