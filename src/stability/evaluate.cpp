#include "stability/evaluate.h"

#include <bit>
#include <cstdint>

#include "base/error.h"
#include "number/half.h"
#include "number/mixed.h"

#include <fmt/format.h>

namespace gonio::stability {
namespace {

template <class T>
FrameAngles<double> to_double(const FrameAngles<T>& a, auto&& out) {
  return {{out(a.nol), out(a.nov), out(a.noh), out(a.voh), out(a.sin2_theta_h)},
          out(a.xoh),
          out(a.yoh),
          out(a.xol),
          out(a.yol),
          out(a.xov),
          out(a.yov)};
}

/// Angles that follow in the number, as doubles that hold them exactly.
template <class T>
FrameAngles<double> angles_in_number(Given given, std::span<const double> in) {
  std::vector<T> x;
  for (const double v : in) x.push_back(static_cast<T>(v));
  return to_double(angles_of<T>(given, x), [](const T& v) { return static_cast<double>(v); });
}

FrameAngles<double> angles_in(Number number, Given given, std::span<const double> in) {
  switch (number) {
    case Number::half:
      return angles_in_number<Half>(given, in);
    case Number::float_:
    case Number::mixed:
      return angles_in_number<float>(given, in);
    case Number::double_:
    case Number::wide:
      break;
  }
  return angles_in_number<double>(given, in);
}

std::size_t index_of(const Subject& s) {
  if (!s.term) throw wrong_usage(fmt::format("{}: a term is expected here, not a model", s.id));
  return *s.term;
}

}  // namespace

double rounded(Number number, double x, bool parameter) {
  if (number == Number::half || (number == Number::mixed && parameter))
    return static_cast<double>(Half(x));
  if (number == Number::float_ || number == Number::mixed)
    return static_cast<double>(static_cast<float>(x));
  return x;
}

std::vector<double> rounded(const Subject& s, Number number, std::span<const double> inputs) {
  std::vector<double> out;
  for (const double x : inputs) out.push_back(rounded(number, x, out.size() < s.parameters));
  return out;
}

double value_of(const Subject& s, Number number, std::span<const double> inputs) {
  const auto in = rounded(s, number, inputs);
  const auto parameters = std::span(in).first(s.parameters),
             angles = std::span(in).subspan(s.parameters);
  const auto row = angles_in(number, s.given, angles);
  double value = 0;
  catalogue_in(number).terms[index_of(s)].values(parameters, {&row, 1}, &value);
  return value;
}

std::string hex(Number number, double x, bool parameter) {
  if (number == Number::half || (number == Number::mixed && parameter)) {
    // A half's bits from those of the float that holds it: 5 of the exponent, 10 of the digits.
    const auto f = static_cast<float>(static_cast<Half>(x));
    const auto bits = std::bit_cast<std::uint32_t>(f), sign = bits >> 16 & 0x8000U,
               size = bits & 0x7fff'ffffU;
    std::uint32_t to = 0;
    if (size >= 0x7f80'0000U)
      to = size > 0x7f80'0000U ? 0x7e00U : 0x7c00U;
    else if (size >= 0x3880'0000U)
      to = (size - 0x3800'0000U) >> 13;
    else
      to = static_cast<std::uint32_t>(std::bit_cast<float>(size) * 0x1p24F);
    return fmt::format("0x{:04x}", sign | to);
  }
  if (number == Number::float_ || number == Number::mixed)
    return fmt::format("0x{:08x}", std::bit_cast<std::uint32_t>(static_cast<float>(x)));
  return fmt::format("0x{:016x}", std::bit_cast<std::uint64_t>(x));
}

}  // namespace gonio::stability
