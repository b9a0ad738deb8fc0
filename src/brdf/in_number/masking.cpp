// Every masking in every number but fifty digits.
#include "brdf/catalogue/masking_terms.h"
#include "brdf/in_number/terms_in.h"

namespace gonio {

GONIO_TERMS_IN(Role::masking, MaskingTerms)

}  // namespace gonio
