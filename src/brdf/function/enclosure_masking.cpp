// Every masking in enclosures, and in halves that are flushed or contracted, as enclosures may have
// them.
#include "brdf/catalogue/masking_terms.h"
#include "brdf/function/functions.h"
#include "number/enclosure.h"

namespace gonio {

GONIO_TERMS_AS_FUNCTIONS(Role::masking, MaskingTerms, Enclosure<Half>)
GONIO_TERMS_AS_FUNCTIONS(Role::masking, MaskingTerms, Enclosure<float>)
GONIO_TERMS_AS_FUNCTIONS(Role::masking, MaskingTerms, Enclosure<double>)
GONIO_TERMS_AS_FUNCTIONS(Role::masking, MaskingTerms, FlushedHalf)
GONIO_TERMS_AS_FUNCTIONS(Role::masking, MaskingTerms, ContractedHalf)
GONIO_TERMS_AS_FUNCTIONS(Role::masking, MaskingTerms, FlushedContractedHalf)

}  // namespace gonio
