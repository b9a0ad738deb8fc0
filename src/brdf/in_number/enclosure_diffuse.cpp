// Every diffuse term in enclosures.
#include "brdf/catalogue/diffuse_terms.h"
#include "brdf/in_number/functions.h"
#include "number/enclosure.h"

namespace gonio {

GONIO_TERMS_AS_FUNCTIONS(Role::diffuse, DiffuseTerms, Enclosure<Half>)
GONIO_TERMS_AS_FUNCTIONS(Role::diffuse, DiffuseTerms, Enclosure<float>)
GONIO_TERMS_AS_FUNCTIONS(Role::diffuse, DiffuseTerms, Enclosure<double>)

}  // namespace gonio
