// Compiled once per instruction set (GONIO_ARCH): the loops of the diffuse terms.
#include "brdf/catalogue/diffuse_terms.h"
#include "brdf/kernel/term_kernels.h"

namespace gonio::inline GONIO_ARCH {

GONIO_TERMS_OF(Role::diffuse, DiffuseTerms)

}  // namespace gonio::inline GONIO_ARCH
