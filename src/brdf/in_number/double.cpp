// Every term in double.
#include "brdf/in_number/terms_in.h"

namespace gonio {

template <>
CatalogueIn catalogue_in<Number::double_>() {
  return {terms_in<double>, maps_in<double>};
}

}  // namespace gonio
