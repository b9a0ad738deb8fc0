#pragma once
/// \file
/// Terms over columns of halves: the border between plain code and code compiled per instruction set.
///
/// A column is 64-byte aligned and padded to a multiple of `padding` (brdf/kernel/kernels.h); halves are held as
/// floats, and rounded on their way in.

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "brdf/kernel/kernels.h"
#include "number/half.h"
#include "stability/kernel/given.h"
#include "stability/kernel/tolerance.h"

namespace gonio::stability {

/// Combinations of HalfRules, by `index_of`.
inline constexpr std::array<HalfRules, 4> all_rules{
    {{false, false}, {true, false}, {false, true}, {true, true}}};
constexpr std::size_t index_of(const HalfRules& rules) {
  return (rules.flush ? 1U : 0U) + (rules.contract ? 2U : 0U);
}

/// Columns of a frame's angles, in the order of FrameAngles.
template <class F>
using AngleColumns = std::array<F*, 11>;

/// A term in halves, and by rules.
using HalfColumn = void (*)(const Block<float>&, const float* parameters, float* out);
using HalfByRules = std::array<HalfColumn, all_rules.size()>;

/// Halves compared with what they should be.
struct Compared {
  std::uint64_t no_value = 0, negative = 0, overflow = 0, vanished = 0;  ///< as in Looked
  std::uint64_t beyond_tolerance =
      0;  ///< more than the tolerance allows, f at least 2⁻¹⁴; or no value
  double relative = 0, ulp = 0;                   ///< the largest, as in Looked
  std::uint64_t undefined = 0, negative_too = 0;  ///< as in Looked

  friend bool operator==(const Compared&, const Compared&) = default;
};

/// Column kernels for one instruction set.
struct HalfKernels {
  std::string_view instruction_set;
  /// Angles that follow from the columns in.
  using HalfAngles = void (*)(Given,
                              std::size_t n,
                              std::span<const float* const> in,
                              const AngleColumns<float>& out);
  std::array<HalfAngles, all_rules.size()> angles;
  void (*double_angles)(Given,
                        std::size_t n,
                        std::span<const double* const> in,
                        const AngleColumns<double>& out);
  /// Adds to what was found.
  void (*compare)(
      std::size_t n, const float* x, const double* f, const Tolerance& tolerance, Compared&);
  std::span<const std::array<HalfColumn, all_rules.size()>>
      terms;  ///< in the order of the catalogue
};
/// Kernels of the best set that may be taken here, or of the named one (brdf/kernel/kernels.h).
const HalfKernels& half_kernels(std::string_view instruction_set = {});

}  // namespace gonio::stability
