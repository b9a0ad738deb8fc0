// Every normal distribution in enclosures, and in halves that are flushed or contracted, as
// enclosures may have them.
#include "brdf/catalogue/distributions.h"
#include "brdf/function/functions.h"
#include "number/enclosure.h"

namespace gonio {

GONIO_TERMS_AS_FUNCTIONS(Role::ndf, Distributions, Enclosure<Half>)
GONIO_TERMS_AS_FUNCTIONS(Role::ndf, Distributions, Enclosure<float>)
GONIO_TERMS_AS_FUNCTIONS(Role::ndf, Distributions, Enclosure<double>)
GONIO_TERMS_AS_FUNCTIONS(Role::ndf, Distributions, FlushedHalf)
GONIO_TERMS_AS_FUNCTIONS(Role::ndf, Distributions, ContractedHalf)
GONIO_TERMS_AS_FUNCTIONS(Role::ndf, Distributions, FlushedContractedHalf)

}  // namespace gonio
