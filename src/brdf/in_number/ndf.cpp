// Every normal distribution in every number but fifty digits.
#include "brdf/catalogue/distributions.h"
#include "brdf/function/functions.h"
#include "brdf/in_number/terms_in.h"

namespace gonio {

GONIO_TERMS_IN(Role::ndf, Distributions)
GONIO_TERMS_AS_FUNCTIONS(Role::ndf, Distributions, double)
GONIO_TERMS_AS_FUNCTIONS(Role::ndf, Distributions, float)
GONIO_TERMS_AS_FUNCTIONS(Role::ndf, Distributions, Half)
GONIO_TERMS_AS_FUNCTIONS(Role::ndf, Distributions, Mixed)

}  // namespace gonio
