// Compiled once per instruction set (GONIO_ARCH): the loops of the Fresnel.
#include "brdf/catalogue/fresnel_terms.h"
#include "brdf/kernel/term_kernels.h"

namespace gonio::inline GONIO_ARCH {

GONIO_TERMS_OF(Role::fresnel, FresnelTerms)

}  // namespace gonio::inline GONIO_ARCH
