// Compiled once per instruction set (GONIO_ARCH): the loops of the masking and shadowing.
#include "brdf/catalogue/masking_terms.h"
#include "brdf/kernel/term_kernels.h"

namespace gonio::inline GONIO_ARCH {

GONIO_TERMS_OF(Role::masking, MaskingTerms)

}  // namespace gonio::inline GONIO_ARCH
