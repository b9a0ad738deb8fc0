// Every normal  distribution in halves, for one instruction set.
#include "brdf/catalogue/distributions.h"
#include "stability/kernel/half_terms.h"

namespace gonio::stability {
inline namespace GONIO_ARCH {

GONIO_HALF_TERMS_OF(Role::ndf, Distributions)

}  // namespace GONIO_ARCH
}  // namespace gonio::stability
