// Every Fresnel in enclosures.
#include "brdf/catalogue/fresnel_terms.h"
#include "brdf/in_number/functions.h"
#include "number/enclosure.h"

namespace gonio {

GONIO_TERMS_AS_FUNCTIONS(Role::fresnel, FresnelTerms, Enclosure<Half>)
GONIO_TERMS_AS_FUNCTIONS(Role::fresnel, FresnelTerms, Enclosure<float>)
GONIO_TERMS_AS_FUNCTIONS(Role::fresnel, FresnelTerms, Enclosure<double>)

}  // namespace gonio
