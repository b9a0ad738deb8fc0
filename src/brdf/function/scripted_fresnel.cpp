// Every Fresnel as a script for Gappa.
#include "brdf/catalogue/fresnel_terms.h"
#include "brdf/function/functions.h"
#include "number/scripted.h"

namespace gonio {

GONIO_TERMS_AS_FUNCTIONS(Role::fresnel, FresnelTerms, Scripted<Half>)
GONIO_TERMS_AS_FUNCTIONS(Role::fresnel, FresnelTerms, Scripted<float>)
GONIO_TERMS_AS_FUNCTIONS(Role::fresnel, FresnelTerms, Scripted<double>)

}  // namespace gonio
