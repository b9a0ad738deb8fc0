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
double common_step(std::vector<double> values) {
  constexpr std::size_t fewest = 12;     // fewer may meet a step by chance
  constexpr double of_one_value = 1e-7;  // as far as one number is printed in two ways
  constexpr double off = 0.02;           // steps
  std::ranges::sort(values);
  double step = 0;
  std::vector<double> distinct;
  for (const double v : values) {
    const double gap = distinct.empty() ? v : v - distinct.back();
    if (gap <= of_one_value * v) continue;
    step = distinct.empty() ? gap : std::min(step, gap);
    distinct.push_back(v);
  }
  if (distinct.size() < fewest) return 0;
  double products = 0, squares = 0;
  for (const double v : distinct) {
    const double k = std::round(v / step);
    if (!(k >= 1) || std::abs(v / step - k) > off) return 0;
    products += k * v, squares += k * k;
    step = products / squares;
  }
  return step;
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
  constexpr double coarser = 1.5;
  if (const double common = common_step(seen);
      common > (decimals <= most_digits ? coarser * std::pow(10, -decimals) : 0)) {
    r.absolute = uniform * common;
    return r;
  }
  const bool by_decimals = decimals <= most_digits, by_digits = digits <= most_digits;
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
