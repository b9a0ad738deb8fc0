// Every masking as a script for Gappa.
#include "brdf/catalogue/masking_terms.h"
#include "brdf/function/functions.h"
#include "number/scripted.h"

namespace gonio {

GONIO_TERMS_AS_FUNCTIONS(Role::masking, MaskingTerms, Scripted<Half>)
GONIO_TERMS_AS_FUNCTIONS(Role::masking, MaskingTerms, Scripted<float>)
GONIO_TERMS_AS_FUNCTIONS(Role::masking, MaskingTerms, Scripted<double>)

}  // namespace gonio
