// Every diffuse term as a graph, of which shaders are written.
#include "brdf/catalogue/diffuse_terms.h"
#include "brdf/function/functions.h"
#include "number/half.h"
#include "number/traced.h"

namespace gonio {

GONIO_TERMS_AS_FUNCTIONS(Role::diffuse, DiffuseTerms, Traced<float>)
GONIO_TERMS_AS_FUNCTIONS(Role::diffuse, DiffuseTerms, Traced<Half>)

}  // namespace gonio
