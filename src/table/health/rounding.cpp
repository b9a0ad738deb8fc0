#include "table/health/rounding.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gonio {

double FileRounding::of(double y) const {
  return std::max(absolute, relative * y);
}

FileRounding rounding_of(const Table& t) {
  // From some values, evenly spread: the fewest decimals, and the fewest significant digits, that
  // hold them all.
  constexpr std::size_t looked_at = 400;
  constexpr int most_digits = 9;
  int decimals = 0, digits = 1;
  bool floats = true;
  std::size_t seen = 0;
  const std::size_t step = std::max<std::size_t>(t.size() / looked_at, 1);
  const auto is_whole = [](double x) {
    return std::abs(x - std::round(x)) <= 1e-13 * std::max(std::abs(x), 1.0);
  };
  for (const auto& plane : t.values)
    for (std::size_t i = 0; i < plane.size(); i += step) {
      const double v = plane[i];
      if (!(v > 0) || !std::isfinite(v)) continue;
      ++seen;
      floats = floats && static_cast<double>(static_cast<float>(v)) == v;
      while (decimals <= most_digits &&
             !(is_whole(v * std::pow(10, decimals)) && v * std::pow(10, decimals) >= 0.5))
        ++decimals;
      const int above = static_cast<int>(std::floor(std::log10(v)));
      while (digits <= most_digits && !is_whole(v * std::pow(10, digits - 1 - above))) ++digits;
    }
  FileRounding r;
  if (seen == 0) return r;
  const double uniform = 1 / std::sqrt(12.0);
  if (decimals <= most_digits) r.absolute = uniform * std::pow(10, -decimals);
  if (digits <= most_digits)
    r.relative = uniform * std::pow(10, 1 - digits);
  else if (floats)
    r.relative = uniform * double{std::numeric_limits<float>::epsilon()};
  return r;
}

}  // namespace gonio
