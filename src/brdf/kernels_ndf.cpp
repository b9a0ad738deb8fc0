// Compiled once per instruction set (GONIO_ARCH): the loops of the normal distributions.
#include "brdf/distributions.h"
#include "brdf/term_kernels.h"

namespace gonio::inline GONIO_ARCH {

GONIO_TERMS_OF(Role::ndf, Distributions)

}  // namespace gonio::inline GONIO_ARCH
