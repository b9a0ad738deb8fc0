// Compiled once per instruction set (GONIO_ARCH): the normal distributions over texels.
#include "brdf/catalogue/distributions.h"
#include "fitting/lanes/terms.h"

namespace gonio::inline GONIO_ARCH {

GONIO_TEXEL_TERMS_OF(Role::ndf, Distributions)

}  // namespace gonio::inline GONIO_ARCH
