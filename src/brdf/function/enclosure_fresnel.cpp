// Every Fresnel in enclosures, and in halves that are flushed or contracted, as enclosures may have
// them.
#include "brdf/catalogue/fresnel_terms.h"
#include "brdf/function/functions.h"
#include "number/enclosure.h"

namespace gonio {

GONIO_TERMS_AS_FUNCTIONS(Role::fresnel, FresnelTerms, Enclosure<Half>)
GONIO_TERMS_AS_FUNCTIONS(Role::fresnel, FresnelTerms, Enclosure<float>)
GONIO_TERMS_AS_FUNCTIONS(Role::fresnel, FresnelTerms, Enclosure<double>)
GONIO_TERMS_AS_FUNCTIONS(Role::fresnel, FresnelTerms, FlushedHalf)
GONIO_TERMS_AS_FUNCTIONS(Role::fresnel, FresnelTerms, ContractedHalf)
GONIO_TERMS_AS_FUNCTIONS(Role::fresnel, FresnelTerms, FlushedContractedHalf)

}  // namespace gonio
