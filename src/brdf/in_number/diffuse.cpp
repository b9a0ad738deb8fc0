// Every diffuse term in every number but fifty digits, and with its operations counted.
#include "brdf/catalogue/diffuse_terms.h"
#include "brdf/function/functions.h"
#include "number/counted.h"
#include "number/half.h"
#include "number/mixed.h"

namespace gonio {

GONIO_TERMS_AS_FUNCTIONS(Role::diffuse, DiffuseTerms, double)
GONIO_TERMS_AS_FUNCTIONS(Role::diffuse, DiffuseTerms, float)
GONIO_TERMS_AS_FUNCTIONS(Role::diffuse, DiffuseTerms, Half)
GONIO_TERMS_AS_FUNCTIONS(Role::diffuse, DiffuseTerms, Mixed)
GONIO_TERMS_AS_FUNCTIONS(Role::diffuse, DiffuseTerms, Counted<double>)

}  // namespace gonio
