// Every Fresnel in every number but fifty digits, and with its operations counted.
#include "brdf/catalogue/fresnel_terms.h"
#include "brdf/function/functions.h"
#include "number/counted.h"
#include "number/half.h"
#include "number/mixed.h"

namespace gonio {

GONIO_TERMS_AS_FUNCTIONS(Role::fresnel, FresnelTerms, double)
GONIO_TERMS_AS_FUNCTIONS(Role::fresnel, FresnelTerms, float)
GONIO_TERMS_AS_FUNCTIONS(Role::fresnel, FresnelTerms, Half)
GONIO_TERMS_AS_FUNCTIONS(Role::fresnel, FresnelTerms, Mixed)
GONIO_TERMS_AS_FUNCTIONS(Role::fresnel, FresnelTerms, Counted<double>)

}  // namespace gonio
