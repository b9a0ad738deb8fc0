// Every Fresnel as a graph, of which shaders are written.
#include "brdf/catalogue/fresnel_terms.h"
#include "brdf/function/functions.h"
#include "number/half.h"
#include "number/traced.h"

namespace gonio {

GONIO_TERMS_AS_FUNCTIONS(Role::fresnel, FresnelTerms, Traced<float>)
GONIO_TERMS_AS_FUNCTIONS(Role::fresnel, FresnelTerms, Traced<Half>)

}  // namespace gonio
