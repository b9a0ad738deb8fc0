// Compiled once per instruction set (GONIO_ARCH): the masking and shadowing over texels.
#include "brdf/catalogue/masking_terms.h"
#include "fitting/lanes/terms.h"

namespace gonio::inline GONIO_ARCH {

GONIO_TEXEL_TERMS_OF(Role::masking, MaskingTerms)

}  // namespace gonio::inline GONIO_ARCH
