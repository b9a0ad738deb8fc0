// Every masking as a graph, of which shaders are written.
#include "brdf/catalogue/masking_terms.h"
#include "brdf/function/functions.h"
#include "number/half.h"
#include "number/traced.h"

namespace gonio {

GONIO_TERMS_AS_FUNCTIONS(Role::masking, MaskingTerms, Traced<float>)
GONIO_TERMS_AS_FUNCTIONS(Role::masking, MaskingTerms, Traced<Half>)

}  // namespace gonio
