// Every masking  term in halves, for one instruction set.
#include "brdf/catalogue/masking_terms.h"
#include "stability/kernel/half_terms.h"

namespace gonio::stability {
inline namespace GONIO_ARCH {

GONIO_HALF_TERMS_OF(Role::masking, MaskingTerms)

}  // namespace GONIO_ARCH
}  // namespace gonio::stability
