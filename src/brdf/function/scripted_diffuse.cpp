// Every diffuse term as a script for Gappa.
#include "brdf/catalogue/diffuse_terms.h"
#include "brdf/function/functions.h"
#include "number/scripted.h"

namespace gonio {

GONIO_TERMS_AS_FUNCTIONS(Role::diffuse, DiffuseTerms, Scripted<Half>)
GONIO_TERMS_AS_FUNCTIONS(Role::diffuse, DiffuseTerms, Scripted<float>)
GONIO_TERMS_AS_FUNCTIONS(Role::diffuse, DiffuseTerms, Scripted<double>)

}  // namespace gonio
