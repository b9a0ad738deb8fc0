// Every normal distribution as a graph, of which shaders are written.
#include "brdf/catalogue/distributions.h"
#include "brdf/function/functions.h"
#include "number/half.h"
#include "number/traced.h"

namespace gonio {

GONIO_TERMS_AS_FUNCTIONS(Role::ndf, Distributions, Traced<float>)
GONIO_TERMS_AS_FUNCTIONS(Role::ndf, Distributions, Traced<Half>)

}  // namespace gonio
