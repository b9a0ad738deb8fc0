// Every masking in every number but fifty digits, and with its operations counted.
#include "brdf/catalogue/masking_terms.h"
#include "brdf/function/functions.h"
#include "number/counted.h"
#include "number/half.h"
#include "number/mixed.h"

namespace gonio {

GONIO_TERMS_AS_FUNCTIONS(Role::masking, MaskingTerms, double)
GONIO_TERMS_AS_FUNCTIONS(Role::masking, MaskingTerms, float)
GONIO_TERMS_AS_FUNCTIONS(Role::masking, MaskingTerms, Half)
GONIO_TERMS_AS_FUNCTIONS(Role::masking, MaskingTerms, Mixed)
GONIO_TERMS_AS_FUNCTIONS(Role::masking, MaskingTerms, Counted<double>)

}  // namespace gonio
