// Every diffuse term in every number but fifty digits.
#include "brdf/catalogue/diffuse_terms.h"
#include "brdf/function/functions.h"
#include "brdf/in_number/terms_in.h"

namespace gonio {

GONIO_TERMS_IN(Role::diffuse, DiffuseTerms)
GONIO_TERMS_AS_FUNCTIONS(Role::diffuse, DiffuseTerms, double)
GONIO_TERMS_AS_FUNCTIONS(Role::diffuse, DiffuseTerms, float)
GONIO_TERMS_AS_FUNCTIONS(Role::diffuse, DiffuseTerms, Half)
GONIO_TERMS_AS_FUNCTIONS(Role::diffuse, DiffuseTerms, Mixed)

}  // namespace gonio
