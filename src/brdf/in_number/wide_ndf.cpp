// Every normal distribution in fifty digits.
#include "brdf/catalogue/distributions.h"
#include "brdf/function/functions.h"
#include "brdf/in_number/wide.h"

namespace gonio {

GONIO_TERMS_IN_WIDE(Role::ndf, Distributions)
GONIO_TERMS_AS_FUNCTIONS(Role::ndf, Distributions, Wide)

}  // namespace gonio
