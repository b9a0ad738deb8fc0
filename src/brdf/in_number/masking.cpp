// Every masking in every number but fifty digits.
#include "brdf/catalogue/masking_terms.h"
#include "brdf/function/functions.h"
#include "brdf/in_number/terms_in.h"

namespace gonio {

GONIO_TERMS_IN(Role::masking, MaskingTerms)
GONIO_TERMS_AS_FUNCTIONS(Role::masking, MaskingTerms, double)
GONIO_TERMS_AS_FUNCTIONS(Role::masking, MaskingTerms, float)
GONIO_TERMS_AS_FUNCTIONS(Role::masking, MaskingTerms, Half)
GONIO_TERMS_AS_FUNCTIONS(Role::masking, MaskingTerms, Mixed)

}  // namespace gonio
