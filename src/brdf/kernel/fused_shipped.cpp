// Compiled once per instruction set (GONIO_ARCH): whole models as they ship (model/presets.h).
#include "brdf/formula/diffuse.h"
#include "brdf/formula/masking_shipped.h"
#include "brdf/formula/ndf.h"
#include "brdf/formula/ndf_anisotropic.h"
#include "brdf/formula/ndf_shipped.h"
#include "brdf/kernel/fused.h"
#include "optics/fresnel_approximate.h"

namespace gonio::inline GONIO_ARCH {
namespace {

using Hot =
    FusedList<ModelTerms<TermList<DisneyDiffuse>,
                         TermList<GgxAniso, DisneyRemap, Schlick>,
                         TermList<Gtr1, DisneyCoat, SchlickWeighted>>,
              ModelTerms<TermList<DisneyDiffuse>,
                         TermList<GgxAniso, SmithGgxAnisoSeparable, Schlick>,
                         TermList<Gtr1, DisneyCoat, SchlickWeighted>>,
              ModelTerms<TermList<>, TermList<GgxUeMobile, UeJointClamped, SchlickUe>>,
              ModelTerms<TermList<>, TermList<GgxMobile, UeMobileSimple, ConstantReflectance>>>;
using HotFits = FusedList<>;

}  // namespace

GONIO_FUSED(FusedGroup::shipped, Hot, HotFits)

}  // namespace gonio::inline GONIO_ARCH
