// Compiled once per instruction set (GONIO_ARCH): the diffuse terms over texels.
#include "brdf/catalogue/diffuse_terms.h"
#include "fitting/lanes/terms.h"

namespace gonio::inline GONIO_ARCH {

GONIO_TEXEL_TERMS_OF(Role::diffuse, DiffuseTerms)

}  // namespace gonio::inline GONIO_ARCH
