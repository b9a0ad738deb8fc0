#pragma once
/// \file
/// Every term in every number, one sample at a time: what `gonio term` prints, and what says how much
/// a number type loses and what a term costs.  For millions of samples see kernel/kernels.h.
///
/// Indices are those of the catalogue.

#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "base/names.h"
#include "geometry/angles.h"
#include "number/counted.h"

namespace gonio {

/// mixed: as a mobile shader declares them, parameters are half and angles float.
enum class Number { double_, float_, half, wide, mixed };
template <>
inline constexpr std::array<std::string_view, 5> names_of<Number>{"double", "float", "half", "wide",
                                                                  "mixed"};

/// The term at each row.  Parameters and angles are rounded to the number on their way in, results to double on their way out;
/// all between is computed in the number.
std::vector<double> values_in(Number,
                              std::size_t term,
                              std::span<const double> parameters,
                              std::span<const FrameAngles<double>> rows);
/// The same, of a masking term G2 = 4 NoL NoV V, which is 0 where a cosine is.
std::vector<double> shown_in(Number,
                             std::size_t term,
                             std::span<const double> parameters,
                             std::span<const FrameAngles<double>> rows);
/// A map's outputs, rounded in and out as a term's.
std::vector<double> map_in(Number, std::size_t map, std::span<const double> parameters);

/// A term in fifty digits.
struct WideValue {
  double value, rest;  ///< the value is their sum
  /// Σ |∂ ln f / ∂ ln xᵢ| over parameters and angles: how many units of the value's last digit a unit
  /// of the inputs' last digits is worth.  NaN where the value is 0.
  double condition;

  /// |x / f − 1|; 0 where both are 0
  double relative_error(double x) const;
};
WideValue wide_value(std::size_t term,
                     std::span<const double> parameters,
                     const FrameAngles<double>& angles);

/// Operations that a term costs.
struct TermOperations {
  Operations parameters;  ///< once for given parameters
  Operations sample;      ///< for each sample, on its own, its division included
  Operations fraction;    ///< the same, left a fraction: a product divides once for all its factors

  /// True of a fraction.
  bool divides() const { return sample[Operation::div] > fraction[Operation::div]; }
};
TermOperations operations_of(std::size_t term);

}  // namespace gonio
