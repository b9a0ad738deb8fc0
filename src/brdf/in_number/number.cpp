#include "brdf/in_number/number.h"

#include "brdf/in_number/conversion.h"

namespace gonio {
namespace {

using Rows = std::span<const FrameAngles<double>>;
std::vector<double> values(
    Number number, std::size_t term, bool g2, std::span<const double> parameters, Rows rows) {
  switch (number) {
    case Number::double_:
      return values_over<double>(term, g2, parameters, rows);
    case Number::float_:
      return values_over<float>(term, g2, parameters, rows);
    case Number::half:
      return values_over<Half>(term, g2, parameters, rows);
    case Number::mixed:
      return values_over<Mixed>(term, g2, parameters, rows);
    case Number::wide:
      break;
  }
  return values_over_wide(term, g2, parameters, rows);
}

}  // namespace

std::vector<double> values_in(Number number,
                              std::size_t term,
                              std::span<const double> parameters,
                              Rows rows) {
  return values(number, term, false, parameters, rows);
}
std::vector<double> shown_in(Number number,
                             std::size_t term,
                             std::span<const double> parameters,
                             Rows rows) {
  return values(number, term, catalogue()[term].role() == Role::masking, parameters, rows);
}

std::vector<double> map_in(Number number, std::size_t map, std::span<const double> parameters) {
  switch (number) {
    case Number::double_:
      return map_over<double>(map, parameters);
    case Number::float_:
      return map_over<float>(map, parameters);
    case Number::half:
      return map_over<Half>(map, parameters);
    case Number::mixed:
      return map_over<Mixed>(map, parameters);
    case Number::wide:
      break;
  }
  return map_over_wide(map, parameters);
}

}  // namespace gonio
