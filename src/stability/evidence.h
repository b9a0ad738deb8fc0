#pragma once
/// \file
/// Evidence for what a formula does in a number: of three kinds, which are never mixed.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/names.h"
#include "brdf/in_number/number.h"
#include "number/half.h"
#include "stability/kernel/tolerance.h"

namespace gonio::stability {

///   exhaustive  every input there is was looked at
///   searched    seeds and climbing: the worst that was found, and there may be worse
///   proved      it holds for every input of the domain
///   open        neither proved nor refuted
enum class Evidence { exhaustive, searched, proved, open };

/// Arithmetic of a processor: a number, and what compilers and drivers may do to it.
struct Arithmetic {
  Number number = Number::half;
  bool flush = false;     ///< results below the least normal number become 0
  bool contract = false;  ///< a b + c is rounded once
  /// Results are all that Vulkan allows a GPU (Rounding::vulkan, number/rounding.h), and not one processor's: proofs know
  /// it, looking does not.
  bool any_gpu = false;

  friend bool operator==(const Arithmetic&, const Arithmetic&) = default;
};

/// Requirement that every input of a domain must keep; a value, not infinite, is part of each.
struct Requirement {
  enum class Kind { finite, nonnegative, relative, absolute } kind = Kind::finite;
  double limit = 0;  ///< of relative: most |x / f − 1|; of absolute: most |x − f|

  std::string text() const;
};

/// Something's largest value, and the inputs where it is; empty: nowhere.
struct Worst {
  double value = 0;
  std::vector<double> at;
};
/// Number of inputs at which something happens, and the first of them.
struct Count {
  std::uint64_t count = 0;
  std::vector<double> first;
};

/// Statement about a subject over its domain, in one arithmetic, from looking at inputs.
struct Looked {
  Evidence evidence = Evidence::searched;
  std::uint64_t evaluations = 0;
  Worst relative;  ///< |x / f − 1| where f and x are normal numbers
  Worst ulp;       ///< |x − f| in units of the last digit of f
  double condition =
      0;            ///< of the inputs, where `ulp` is: how many units a unit of the inputs is worth
  Worst beyond;     ///< ulp over max(1, condition)
  Count no_value;   ///< NaN or infinite, where f is a number of this kind's range
  Count negative;   ///< below 0, where f is not
  Count overflow;   ///< infinite because f is larger than the largest number
  Count undefined;  ///< NaN or infinite where f is no number, either
  Count negative_too;  ///< below 0, as f is
  /// Off by more than the tolerance; the least number that is asked for is 2⁻¹⁴ in half and mixed, 2⁻⁶⁴ in float and double,
  /// below which a result is black in whatever light; or no value.
  Count lost;
  Count vanished;      ///< 0 where f is a normal number
  Count irreciprocal;  ///< another value with light and view exchanged
  Count not_monotone;  ///< at the next value of the last input it rises where f falls, or falls
                       ///< where f rises
  HalfFlags flags;     ///< raised on the way to the worst relative error, of half
  /// Of the parameter that decides: from there on every input looked at keeps the tolerance, has a value, and is not negative.
  std::optional<double> safe_from, finite_from, nonnegative_from;
  Tolerance tolerance{0};  ///< relative 0.02 in half
  bool settled = true;     ///< searches from two seeds agree within a factor of two

  /// The least value of the parameter that decides from which the requirement is kept; its tolerance is that of the looking.
  const std::optional<double>& from(Requirement::Kind kind) const {
    return kind == Requirement::Kind::finite        ? finite_from
           : kind == Requirement::Kind::nonnegative ? nonnegative_from
                                                    : safe_from;
  }
};

}  // namespace gonio::stability

namespace gonio {
template <>
inline constexpr std::array<std::string_view, 4> names_of<stability::Evidence>{
    "exhaustive", "searched", "proved", "open"};
}  // namespace gonio
