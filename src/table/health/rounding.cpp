#include "table/health/rounding.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace gonio {
namespace {

constexpr double uniform = 0.28867513459481287;  ///< standard deviation of a step of 1: 1/√12

int decade_of(double y) {
  return static_cast<int>(std::floor(std::log10(y)));
}
bool is_whole(double x) {
  return std::abs(x - std::round(x)) <= 1e-13 * std::max(std::abs(x), 1.0);
}
bool ends_in_zero(double x) {
  return std::fmod(std::round(x), 10) == 0;
}

/// The step of which all values are whole multiples, as a converter's counts times a factor are; 0 where there is none.
/// The least gap says how large it is roughly, greater and greater multiples ever more exactly.
/// \param written  half a unit of a value's last digit
template <class Written>
double common_step(std::vector<double> values, Written&& written) {
  constexpr std::size_t fewest = 16;  // fewer may meet a step by chance
  constexpr double coarser = 8;       // than what is written, or any value meets it
  std::ranges::sort(values);
  double gap = HUGE_VAL, unsure = 0;
  std::vector<double> distinct;
  for (const double v : values) {
    const double here = distinct.empty() ? v : v - distinct.back();
    if (here <= 2.5 * written(v)) continue;  // one number, written in two ways
    if (here < gap) gap = here, unsure = 2 * written(v);
    distinct.push_back(v);
  }
  if (distinct.size() < fewest) return 0;
  double low = gap - unsure, high = gap + unsure;
  for (const double v : distinct) {
    const double off = written(v), k = std::round(2 * v / (low + high));
    if (!(low > 0) || !(k >= 1) || !(v * (1 / low - 1 / high) < 0.5)) return 0;
    low = std::max(low, (v - off) / k), high = std::min(high, (v + off) / k);
    if (!(low <= high)) return 0;
  }
  const double step = (low + high) / 2;
  return step > coarser * written(step) ? step : 0;
}

}  // namespace

double FileRounding::of(double y) const {
  if (digits > 0) return y > 0 ? uniform * std::pow(10, decade_of(y) + 1 - digits) : 0;
  return std::max(absolute, relative * y);
}

FileRounding rounding_of(const Table& t) {
  // From some values, evenly spread: the fewest decimals, and the fewest significant digits, that
  // hold them all.
  constexpr std::size_t looked_at = 400;
  constexpr int most_digits = 9;
  constexpr double smallest = 1e-290;  // whose digits a double can show
  int decimals = 0, digits = 1;
  bool floats = true;
  std::vector<double> seen;
  const std::size_t step = std::max<std::size_t>(t.size() / looked_at, 1);
  for (const auto& plane : t.values)
    for (std::size_t i = 0; i < plane.size(); i += step)
      if (plane[i] > smallest && std::isfinite(plane[i])) seen.push_back(plane[i]);
  const auto in_decimals = [&](double v) { return v * std::pow(10, decimals); };
  const auto in_digits = [&](double v) { return v * std::pow(10, digits - 1 - decade_of(v)); };
  for (const double v : seen) {
    floats = floats && static_cast<double>(static_cast<float>(v)) == v;
    while (decimals <= most_digits && !(is_whole(in_decimals(v)) && in_decimals(v) >= 0.5))
      ++decimals;
    while (digits <= most_digits && !is_whole(in_digits(v))) ++digits;
  }
  FileRounding r;
  if (seen.empty()) return r;
  const bool by_decimals = decimals <= most_digits, by_digits = digits <= most_digits;
  const auto written = [&](double v) {
    constexpr double at_least = 1e-9;  // of a double that was computed
    const double last = by_decimals ? std::pow(10, -decimals) : 0,
                 of_digits = by_digits ? std::pow(10, decade_of(v) + 1 - digits) : 0;
    return std::max({last / 2, of_digits / 2, at_least * v});
  };
  if (const double common = common_step(seen, written); common > 0) {
    r.absolute = uniform * common;
    return r;
  }
  const auto zeros = [&](const auto& places) {
    return std::ranges::count_if(seen, [&](double v) { return ends_in_zero(places(v)); });
  };
  if (by_decimals && !(by_digits && zeros(in_digits) < zeros(in_decimals)))
    r.absolute = uniform * std::pow(10, -decimals);
  else if (by_digits)
    r.digits = digits;
  else if (floats)
    r.relative = uniform * double{std::numeric_limits<float>::epsilon()};
  return r;
}

}  // namespace gonio
