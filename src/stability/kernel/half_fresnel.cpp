// Every Fresnel  term in halves, for one instruction set.
#include "brdf/catalogue/fresnel_terms.h"
#include "stability/kernel/half_terms.h"

namespace gonio::stability {
inline namespace GONIO_ARCH {

GONIO_HALF_TERMS_OF(Role::fresnel, FresnelTerms)

}  // namespace GONIO_ARCH
}  // namespace gonio::stability
