// Every masking in enclosures.
#include "brdf/catalogue/masking_terms.h"
#include "brdf/in_number/functions.h"
#include "number/enclosure.h"

namespace gonio {

GONIO_TERMS_AS_FUNCTIONS(Role::masking, MaskingTerms, Enclosure<Half>)
GONIO_TERMS_AS_FUNCTIONS(Role::masking, MaskingTerms, Enclosure<float>)
GONIO_TERMS_AS_FUNCTIONS(Role::masking, MaskingTerms, Enclosure<double>)

}  // namespace gonio
