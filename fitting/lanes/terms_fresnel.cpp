// Compiled once per instruction set (GONIO_ARCH): the Fresnel over texels.
#include "brdf/catalogue/fresnel_terms.h"
#include "fitting/lanes/terms.h"

namespace gonio::inline GONIO_ARCH {

GONIO_TEXEL_TERMS_OF(Role::fresnel, FresnelTerms)

}  // namespace gonio::inline GONIO_ARCH
