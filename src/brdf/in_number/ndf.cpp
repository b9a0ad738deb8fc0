// Every normal distribution in every number but fifty digits.
#include "brdf/catalogue/distributions.h"
#include "brdf/in_number/terms_in.h"

namespace gonio {

GONIO_TERMS_IN(Role::ndf, Distributions)

}  // namespace gonio
