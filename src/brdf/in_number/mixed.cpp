// Every term in half and float, as a mobile shader declares them.
#include "number/mixed.h"

#include "brdf/in_number/terms_in.h"

namespace gonio {
inline namespace GONIO_ARCH {

template <>
struct Doors<Mixed> {
  static Mixed parameter(double x) { return Mixed(Half(x)); }
  static Mixed angle(double x) { return Mixed(static_cast<float>(x)); }
  static double out(const Mixed& x) { return x.value(); }
};

}  // namespace GONIO_ARCH

template <>
CatalogueIn catalogue_in<Number::mixed>() {
  return {terms_in<Mixed>, maps_in<Mixed>};
}

}  // namespace gonio
