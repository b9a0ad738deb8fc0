// Compiled once per instruction set (GONIO_ARCH): whole models of Beckmann and GTR.
#include "brdf/formula/diffuse.h"
#include "brdf/formula/masking_shipped.h"
#include "brdf/formula/ndf.h"
#include "brdf/kernel/fused.h"
#include "optics/fresnel_approximate.h"

namespace gonio::inline GONIO_ARCH {
namespace {

using Hot = FusedList<ModelTerms<TermList<>, TermList<Beckmann, SmithBeckmannCorrelated, Schlick>>,
                      ModelTerms<TermList<>, TermList<Beckmann, SmithBeckmannRational, Schlick>>,
                      ModelTerms<TermList<>, TermList<Gtr, SmithGgxCorrelated, Schlick>>>;
using HotFits =
    FusedList<ModelTerms<TermList<Lambert>, TermList<Gtr, SmithGgxCorrelated, Schlick>>>;

}  // namespace

GONIO_FUSED(FusedGroup::isotropic, Hot, HotFits)

}  // namespace gonio::inline GONIO_ARCH
