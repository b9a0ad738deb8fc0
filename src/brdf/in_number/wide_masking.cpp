// Every masking in fifty digits.
#include "brdf/catalogue/masking_terms.h"
#include "brdf/function/functions.h"
#include "number/wide.h"

namespace gonio {

GONIO_TERMS_AS_FUNCTIONS(Role::masking, MaskingTerms, Wide)

}  // namespace gonio
