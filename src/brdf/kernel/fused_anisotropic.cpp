// Compiled once per instruction set (GONIO_ARCH): whole models with a tangent.
#include "brdf/formula/diffuse.h"
#include "brdf/formula/masking.h"
#include "brdf/formula/ndf_anisotropic.h"
#include "brdf/kernel/fused.h"
#include "optics/fresnel_approximate.h"

namespace gonio::inline GONIO_ARCH {
namespace {

using Model = ModelTerms<TermList<Lambert>, TermList<GgxAniso, SmithGgxAnisoCorrelated, Schlick>>;
using Hot = FusedList<Model>;
using HotFits = FusedList<Model>;

}  // namespace

GONIO_FUSED(FusedGroup::anisotropic, Hot, HotFits)

}  // namespace gonio::inline GONIO_ARCH
