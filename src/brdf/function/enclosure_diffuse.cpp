// Every diffuse term in enclosures, and in halves that are flushed or contracted, as enclosures may
// have them.
#include "brdf/catalogue/diffuse_terms.h"
#include "brdf/function/functions.h"
#include "number/enclosure.h"

namespace gonio {

GONIO_TERMS_AS_FUNCTIONS(Role::diffuse, DiffuseTerms, Enclosure<Half>)
GONIO_TERMS_AS_FUNCTIONS(Role::diffuse, DiffuseTerms, Enclosure<float>)
GONIO_TERMS_AS_FUNCTIONS(Role::diffuse, DiffuseTerms, Enclosure<double>)
GONIO_TERMS_AS_FUNCTIONS(Role::diffuse, DiffuseTerms, FlushedHalf)
GONIO_TERMS_AS_FUNCTIONS(Role::diffuse, DiffuseTerms, ContractedHalf)
GONIO_TERMS_AS_FUNCTIONS(Role::diffuse, DiffuseTerms, FlushedContractedHalf)

}  // namespace gonio
