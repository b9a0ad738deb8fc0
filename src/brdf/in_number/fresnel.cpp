// Every Fresnel in every number but fifty digits.
#include "brdf/catalogue/fresnel_terms.h"
#include "brdf/in_number/terms_in.h"

namespace gonio {

GONIO_TERMS_IN(Role::fresnel, FresnelTerms)

}  // namespace gonio
