// Every normal distribution as a script for Gappa.
#include "brdf/catalogue/distributions.h"
#include "brdf/function/functions.h"
#include "number/scripted.h"

namespace gonio {

GONIO_TERMS_AS_FUNCTIONS(Role::ndf, Distributions, Scripted<Half>)
GONIO_TERMS_AS_FUNCTIONS(Role::ndf, Distributions, Scripted<float>)
GONIO_TERMS_AS_FUNCTIONS(Role::ndf, Distributions, Scripted<double>)

}  // namespace gonio
