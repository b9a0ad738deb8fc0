// Compiled once per instruction set (GONIO_ARCH): whole models of GGX.
#include "brdf/formula/diffuse.h"
#include "brdf/formula/masking_shipped.h"
#include "brdf/formula/ndf_ggx.h"
#include "brdf/kernel/fused.h"
#include "optics/fresnel.h"
#include "optics/fresnel_approximate.h"

namespace gonio::inline GONIO_ARCH {
namespace {

using Correlated = TermList<Ggx, SmithGgxCorrelated, Schlick>;
using Hot =
    FusedList<ModelTerms<TermList<>, Correlated>,
              ModelTerms<TermList<>, TermList<Ggx, SmithGgxCorrelated, Conductor>>,
              ModelTerms<TermList<Lambert>, Correlated>,
              // as they ship (model/presets.h)
              ModelTerms<TermList<LambertCoupled>, Correlated>,
              ModelTerms<TermList<LambertCoupled>, TermList<Ggx, SmithGgxSeparable, Schlick>>,
              ModelTerms<TermList<Lambert>, TermList<Ggx, SmithGgxCorrelated, SchlickF90>>,
              ModelTerms<TermList<>, TermList<Ggx, UnityMobile, ConstantReflectance>>>;

/// Models of most fits.
using HotFits = FusedList<ModelTerms<TermList<>, Correlated>,
                          ModelTerms<TermList<Lambert>, Correlated>,
                          ModelTerms<TermList<LambertCoupled>, Correlated>>;

}  // namespace

GONIO_FUSED(FusedGroup::ggx, Hot, HotFits)

}  // namespace gonio::inline GONIO_ARCH
