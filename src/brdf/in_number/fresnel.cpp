// Every Fresnel in every number but fifty digits.
#include "brdf/catalogue/fresnel_terms.h"
#include "brdf/function/functions.h"
#include "brdf/in_number/terms_in.h"

namespace gonio {

GONIO_TERMS_IN(Role::fresnel, FresnelTerms)
GONIO_TERMS_AS_FUNCTIONS(Role::fresnel, FresnelTerms, double)
GONIO_TERMS_AS_FUNCTIONS(Role::fresnel, FresnelTerms, float)
GONIO_TERMS_AS_FUNCTIONS(Role::fresnel, FresnelTerms, Half)
GONIO_TERMS_AS_FUNCTIONS(Role::fresnel, FresnelTerms, Mixed)

}  // namespace gonio
