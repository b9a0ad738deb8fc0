// Every normal distribution in fifty digits.
#include "brdf/catalogue/distributions.h"
#include "brdf/function/functions.h"
#include "number/wide.h"

namespace gonio {

GONIO_TERMS_AS_FUNCTIONS(Role::ndf, Distributions, Wide)

}  // namespace gonio
