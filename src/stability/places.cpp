#include "stability/places.h"

#include <bit>
#include <cmath>
#include <limits>

#include "stability/evaluate.h"

namespace gonio::stability {
namespace {

bool is_half(Number number, bool parameter) {
  return number == Number::half || (number == Number::mixed && parameter);
}
bool is_float(Number number) {
  return number == Number::float_ || number == Number::mixed;
}

/// Place of a size ≥ 0: its bits.
std::int64_t bits_of(Number number, double size, bool parameter) {
  if (is_half(number, parameter)) {
    if (size < 0x1p-14) return static_cast<std::int64_t>(size * 0x1p24);
    const int exponent = std::ilogb(size);
    return ((exponent + 14) << 10) + static_cast<std::int64_t>(std::ldexp(size, 10 - exponent));
  }
  if (is_float(number)) return std::bit_cast<std::int32_t>(static_cast<float>(size));
  return std::bit_cast<std::int64_t>(size);
}
double from_bits(Number number, std::int64_t bits, bool parameter) {
  if (is_half(number, parameter)) {
    const auto exponent = static_cast<int>(bits >> 10), digits = static_cast<int>(bits & 1023);
    return exponent == 0 ? std::ldexp(digits, -24) : std::ldexp(1024 + digits, exponent - 25);
  }
  if (is_float(number))
    return static_cast<double>(std::bit_cast<float>(static_cast<std::int32_t>(bits)));
  return std::bit_cast<double>(bits);
}

}  // namespace

double largest(Number number) {
  if (number == Number::half) return 65504;
  return is_float(number) ? static_cast<double>(std::numeric_limits<float>::max())
                          : std::numeric_limits<double>::max();
}
int least_exponent(Number number) {
  return number == Number::half ? -14 : is_float(number) ? -126 : -1022;
}

std::int64_t place_of(Number number, double x, bool parameter) {
  return x < 0 ? -bits_of(number, -x, parameter) : bits_of(number, std::abs(x), parameter);
}

double at_place(Number number, std::int64_t place, bool parameter) {
  return place < 0 ? -from_bits(number, -place, parameter) : from_bits(number, place, parameter);
}

Places places_within(Number number, const Range& range, bool parameter) {
  const auto next_to = [&](double x) {
    const auto place = place_of(number, rounded(number, x, parameter), parameter);
    return place == 0 && x > 0 ? 1 : place;
  };
  return {next_to(range.low), next_to(range.high)};
}

}  // namespace gonio::stability
