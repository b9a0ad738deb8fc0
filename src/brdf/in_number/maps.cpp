// Every map in every number but fifty digits.
#include "brdf/catalogue/maps.h"

#include "brdf/in_number/terms_in.h"

namespace gonio {

std::span<const MapIn> maps_in(Number number) {
  static constexpr auto in_double = table_in<double>(Maps{});
  static constexpr auto in_float = table_in<float>(Maps{});
  static constexpr auto in_half = table_in<Half>(Maps{});
  static constexpr auto in_mixed = table_in<Mixed>(Maps{});
  switch (number) {
    case Number::double_:
      return in_double;
    case Number::float_:
      return in_float;
    case Number::half:
      return in_half;
    case Number::mixed:
      return in_mixed;
    case Number::wide:
      break;
  }
  return maps_in_wide();
}

}  // namespace gonio
