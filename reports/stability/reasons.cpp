// Targets that a form misses, and why.
#include <algorithm>
#include <optional>

#include "reports/stability/measure.h"

#include <fmt/format.h>

namespace gonio::stabilities {
namespace {

bool has_few_bits(Number n) {
  return n == Number::half || n == Number::mixed;
}

/// Reason of forms whose id begins so, found where their worst inputs are.
struct Known {
  std::string_view id;
  std::optional<bool> few_bits;  ///< none: in either
  std::string_view reason;
};
constexpr Known known[] = {
    {"ndf.beckmann", true,
     "the exponential makes a relative error of what its argument was rounded by, most far from "
     "the "
     "peak and at the horizon"},
    {"ndf.blinn_phong", true,
     "the exponent is p times a rounded logarithm; at NoH = 0 the number's own least value stands "
     "for it"},
    {"ndf.gtr", true,
     "the power makes a relative error of what gamma times a logarithm was rounded by, most at the "
     "horizon"},
    {"ndf.beckmann", false,
     "the exponential makes a relative error of what its argument was rounded by"},
    {"ndf.blinn_phong", false, "at NoH = 0 the number's own least value stands for it"},
    {"ndf.gtr", false,
     "the power makes a relative error of what gamma times a logarithm was rounded by"},
    {"ndf.shape_invariant", false,
     "the power makes a relative error of what gamma times a logarithm was rounded by"},
    {"ndf.student_t", false,
     "the power makes a relative error of what 1/tail times a logarithm was rounded by"},
    {"ndf.charlie",
     {},
     "the power makes a relative error of what 1/alpha times a logarithm was rounded by"},
    {"masking.smith_student_t", false,
     "an exponential and twenty summands, whose weights are found in the same number"},
    {"masking.smith_charlie",
     {},
     "Λ is an exponential of up to 20, and makes a relative error of what that was rounded by"},
    {"masking.smith_gtr", false,
     "a polynomial of 24 terms whose coefficients are found in the same number"},
    {"masking.smith_beckmann", false, "the error function and the exponential err by themselves"},
    {"fresnel.f82", {}, "the dip is a difference, which cancels where F is nearly 0"},
    {"fresnel.conductor", {}, "where eta is 1 and k nearly 0, F is a difference that cancels"},
    {"ndf.ggx.mobile", true,
     "NoH is rounded to half, and 1 − NoH² is left with few of its digits near the peak"},
    {"fresnel.dielectric", true,
     "next to the critical angle F depends on a difference that cancels"},
    {"fresnel.dielectric", false,
     "roundings of a dozen operations add up where F is near 1 and its inputs' own cost nothing"}};

}  // namespace

std::string text_of(const HalfFlags& flags) {
  if (flags.overflow && flags.underflow) return "overflow, underflow";
  return flags.overflow ? "overflow" : flags.underflow ? "underflow" : "";
}

bool misses_target(const StabilityRow& r, Number number) {
  constexpr double units = 8;
  if (!has_few_bits(number)) return r.ulp_beyond > units || r.nonfinite > 0 || r.negative > 0;
  if (r.is_absolute) return r.lost > 0;
  if (r.decides.empty()) return r.worst_rel > r.tolerance || r.nonfinite > 0;
  return !r.safe_from ||
         (r.decides.starts_with("alpha") ? *r.safe_from > usual_width
                                         : r.worst_rel > r.tolerance || r.nonfinite > 0);
}

std::string reason_of(const StabilityRow& r, Number number) {
  const auto at = std::ranges::find_if(known, [&](const Known& k) {
    return r.id.starts_with(k.id) &&
           k.few_bits.value_or(has_few_bits(number)) == has_few_bits(number);
  });
  if (at != std::end(known)) return std::string(at->reason);
  if (r.nonfinite + r.overflow > 0)
    return "values, or what is computed on the way, leave the range of the number";
  if (!r.flags.empty()) return fmt::format("on the way there is {}", r.flags);
  constexpr double few = 8, lost = 1000;  // units beyond what the inputs' own rounding is worth
  if (r.ulp_beyond <= few) return "what its inputs were rounded by already costs as much";
  if (r.ulp_beyond <= lost) return "roundings of its operations add up";
  return has_few_bits(number)
             ? "likely a difference that cancels on the way, or a half below its normal range"
             : "likely a difference that cancels on the way";
}

}  // namespace gonio::stabilities
