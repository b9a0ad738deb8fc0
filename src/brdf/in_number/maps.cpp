// Every map in every number but fifty digits.
#include "brdf/catalogue/maps.h"

#include "brdf/function/map_functions.h"
#include "number/half.h"
#include "number/mixed.h"

namespace gonio {

GONIO_MAPS_AS_FUNCTIONS(double)
GONIO_MAPS_AS_FUNCTIONS(float)
GONIO_MAPS_AS_FUNCTIONS(Half)
GONIO_MAPS_AS_FUNCTIONS(Mixed)

}  // namespace gonio
