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

/// Integrals with one bound for the error of each: Σ |Kronrod − Gauss| over the rectangles (along both
/// axes) and what summing rounds off.  The Kronrod rule is far more exact than the Gauss rule that it is
/// compared with, and where these two agree by chance the 8 nodes that are not Gauss's do not: the bound
/// is true wherever the nodes see the function at all.  Not reached within the evaluations allowed: the
/// bound says what was.  Infinite, with the integral's sign, where halving a rectangle time and again
/// leaves as much in one half: a singularity belongs at 0, where numbers are densest.  Not a number
/// where a value was none.
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
