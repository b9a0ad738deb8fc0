// Every map as a graph, of which shaders are written.
#include "brdf/catalogue/maps.h"
#include "brdf/function/map_functions.h"
#include "number/half.h"
#include "number/traced.h"

namespace gonio {

GONIO_MAPS_AS_FUNCTIONS(Traced<float>)
GONIO_MAPS_AS_FUNCTIONS(Traced<Half>)

}  // namespace gonio
