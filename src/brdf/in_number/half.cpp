// Every term in binary16, rounded after every operation.
#include "number/half.h"

#include "brdf/in_number/terms_in.h"

namespace gonio {

template <>
CatalogueIn catalogue_in<Number::half>() {
  return {terms_in<Half>, maps_in<Half>};
}

}  // namespace gonio
