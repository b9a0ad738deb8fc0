// Every term in float.
#include "brdf/in_number/terms_in.h"

namespace gonio {

template <>
CatalogueIn catalogue_in<Number::float_>() {
  return {terms_in<float>, maps_in<float>};
}

}  // namespace gonio
