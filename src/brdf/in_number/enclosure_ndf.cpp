// Every normal distribution in enclosures.
#include "brdf/catalogue/distributions.h"
#include "brdf/in_number/functions.h"
#include "number/enclosure.h"

namespace gonio {

GONIO_TERMS_AS_FUNCTIONS(Role::ndf, Distributions, Enclosure<Half>)
GONIO_TERMS_AS_FUNCTIONS(Role::ndf, Distributions, Enclosure<float>)
GONIO_TERMS_AS_FUNCTIONS(Role::ndf, Distributions, Enclosure<double>)

}  // namespace gonio
