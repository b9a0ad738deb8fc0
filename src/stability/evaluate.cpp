#include "stability/evaluate.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "base/error.h"
#include "brdf/in_number/conversion.h"
#include "brdf/in_number/number.h"
#include "stability/places.h"
#include "stability/value_over.h"

#include <fmt/format.h>

namespace gonio::stability {
namespace {

template <class T>
double value_in_number(const Subject& s, std::span<const double> inputs) {
  std::vector<T> in;
  for (const double x : inputs)
    in.push_back(in.size() < s.parameters ? Conversion<T>::parameter(x) : Conversion<T>::angle(x));
  return Conversion<T>::out(value_over<T>(s, in));
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

double value_of(const Subject& s, const Arithmetic& a, std::span<const double> inputs) {
  if (a.number != Number::half && (a.flush || a.contract))
    throw wrong_usage(fmt::format("{}: flushing and contraction are known only in half, not in {}",
                                  s.id, name_of(a.number)));
  switch (a.number) {
    case Number::half:
      return a.flush && a.contract ? value_in_number<FlushedContractedHalf>(s, inputs)
             : a.flush             ? value_in_number<FlushedHalf>(s, inputs)
             : a.contract          ? value_in_number<ContractedHalf>(s, inputs)
                                   : value_in_number<Half>(s, inputs);
    case Number::mixed:
      return value_in_number<Mixed>(s, inputs);
    case Number::float_:
      return value_in_number<float>(s, inputs);
    case Number::double_:
      return value_in_number<double>(s, inputs);
    case Number::wide:
      break;
  }
  return truth_of(s, inputs).value;
}
double value_of(const Subject& s, Number number, std::span<const double> inputs) {
  return value_of(s, Arithmetic{number}, inputs);
}

double share_of_cheap(const Subject& s) {
  std::size_t operations = 1;
  const auto add = [&](std::size_t term) {
    const auto o = operations_of(term);
    operations += o.parameters.total() + o.sample.total();
  };
  if (s.term) add(*s.term);
  if (s.model) {
    for (const auto& use : s.model->diffuse) add(use.term);
    for (const auto& lobe : s.model->lobes)
      for (const auto& use : {lobe.ndf, lobe.masking, lobe.fresnel}) add(use.term);
  }
  return std::min(1.0, 300.0 / static_cast<double>(operations));
}

std::string hex(Number number, double x, bool parameter) {
  if (number == Number::half || (number == Number::mixed && parameter)) {
    const double held = std::abs(rounded(number, x, parameter));
    const std::int64_t size = std::isnan(held)   ? 0x7e00
                              : std::isinf(held) ? 0x7c00
                                                 : place_of(number, held, parameter);
    return fmt::format("0x{:04x}", (std::signbit(x) ? 0x8000 : 0) | size);
  }
  if (number == Number::float_ || number == Number::mixed)
    return fmt::format("0x{:08x}", std::bit_cast<std::uint32_t>(static_cast<float>(x)));
  return fmt::format("0x{:016x}", std::bit_cast<std::uint64_t>(x));
}

}  // namespace gonio::stability
