#include "base/rounded.h"

#include <cmath>

#include <fmt/format.h>

namespace gonio {
namespace {

/// What a product or a sum of doubles may be off by.
constexpr double own_rounding = 1e-12;

/// Unit of the last of so many digits.
double unit_of(double x, int digits) {
  return std::pow(10, std::floor(std::log10(std::abs(x))) + 1 - digits);
}

}  // namespace

std::string rounded_up(double x, int digits) {
  if (std::isfinite(x) && x > std::pow(10, digits) - 1)
    return fmt::format("{:.0f}", std::ceil(x * (1 - own_rounding)));
  const auto text = fmt::format("{:.{}g}", x, digits);
  const double read = std::stod(text);
  if (!std::isfinite(x) || x == 0 || read >= x * (1 - own_rounding)) return text;
  return fmt::format("{:.{}g}", read + unit_of(x, digits), digits);
}

std::string rounded_down(double x, int digits) {
  if (std::isfinite(x) && x >= std::pow(10, digits) - 1)
    return fmt::format("{:.0f}", std::floor(x * (1 + own_rounding)));
  const auto text = fmt::format("{:.{}g}", x, digits);
  const double read = std::stod(text);
  if (!std::isfinite(x) || x == 0 || read <= x * (1 + own_rounding)) return text;
  return fmt::format("{:.{}g}", read - unit_of(x, digits), digits);
}

std::string in_percent(double share) {
  constexpr int digits = 12;
  return fmt::format("{:.{}g}", 100 * share, digits);
}

}  // namespace gonio
