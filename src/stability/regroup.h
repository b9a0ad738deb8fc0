#pragma once
/// \file
/// Regrouping: what a compiler may do to a shader's sums and products that are not `precise`, and what that costs a formula.
///
///   (a + b) − c → (a − c) + b,    (a b)/c → a (b (1/c))
///
/// Vulkan lets it use whatever holds in exact arithmetic   [Vulkan 1.4, Precision and Operation of SPIR-V Instructions].
/// Orders are drawn at random here; factors are not taken out, and products and sums not fused.

#include <cstdint>
#include <optional>
#include <vector>

#include "brdf/in_number/number.h"
#include "number/traced.h"
#include "stability/subject.h"

namespace gonio::stability {

/// Formula as a graph, and the node of its value.
struct Graph {
  Trace trace;
  int value = 0;
};

/// Formula with the same value in exact arithmetic, its sums and products in an order that the seed decides.
Graph regrouped(const Graph&, std::uint64_t seed);

/// Cost of regrouping, over inputs drawn from the subject's domain.
struct Regrouping {
  double written = 0;          ///< most relative error in the formula's own order
  double regrouped = 0;        ///< the same over all orders
  std::vector<double> at;      ///< inputs where that is
  std::uint64_t no_value = 0;  ///< inputs without a value in the formula's own order
  std::uint64_t lost = 0;      ///< further ones without a value in some order
  std::uint64_t inputs = 0;
};
inline constexpr std::uint64_t regroupings = 16;

/// What orders cost a subject; none of one with constants that the number does not hold.  The same whatever the threads.
///
/// Relative errors are against double, of the value or of the least that counts (2⁻¹⁴ in half, 2⁻⁶⁴ in float) where it is
/// smaller.
/// \throws Error  wrong usage of another number than half and float
std::optional<Regrouping> regrouping(const Subject&, Number);

}  // namespace gonio::stability
