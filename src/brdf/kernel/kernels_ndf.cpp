// Compiled once per instruction set (GONIO_ARCH): the loops of the normal distributions.
#include "brdf/catalogue/distributions.h"
#include "brdf/kernel/term_kernels.h"

namespace gonio::inline GONIO_ARCH {

GONIO_TERMS_OF(Role::ndf, Distributions)

}  // namespace gonio::inline GONIO_ARCH
