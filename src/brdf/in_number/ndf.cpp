// Every normal distribution in every number but fifty digits, and with its operations counted.
#include "brdf/catalogue/distributions.h"
#include "brdf/function/functions.h"
#include "number/counted.h"
#include "number/half.h"
#include "number/mixed.h"

namespace gonio {

GONIO_TERMS_AS_FUNCTIONS(Role::ndf, Distributions, double)
GONIO_TERMS_AS_FUNCTIONS(Role::ndf, Distributions, float)
GONIO_TERMS_AS_FUNCTIONS(Role::ndf, Distributions, Half)
GONIO_TERMS_AS_FUNCTIONS(Role::ndf, Distributions, Mixed)
GONIO_TERMS_AS_FUNCTIONS(Role::ndf, Distributions, Counted<double>)

}  // namespace gonio
