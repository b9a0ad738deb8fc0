// Every diffuse term in every number but fifty digits.
#include "brdf/catalogue/diffuse_terms.h"
#include "brdf/in_number/terms_in.h"

namespace gonio {

GONIO_TERMS_IN(Role::diffuse, DiffuseTerms)

}  // namespace gonio
