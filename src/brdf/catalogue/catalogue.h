#pragma once
/// \file
/// Every term, role by role, and the combinations that are fused; a hot combination is one line.

#include "brdf/catalogue/diffuse_terms.h"
#include "brdf/catalogue/distributions.h"
#include "brdf/catalogue/fresnel_terms.h"
#include "brdf/catalogue/masking_terms.h"

namespace gonio::inline GONIO_ARCH {

/// In the order of Role.
using Catalogue = Joined<Distributions, MaskingTerms, FresnelTerms, DiffuseTerms>;

template <class... Lists>
struct FusedList {};

/// A whole model: its diffuse terms, and D, V, F of each lobe.
template <class Diffuse, class... Lobes>
struct ModelTerms {};

/// Models whose terms are inlined into one loop: the same formulas, worth it where a profile says so.
using Hot =
    FusedList<ModelTerms<TermList<>, TermList<Ggx, SmithGgxCorrelated, Schlick>>,
              ModelTerms<TermList<>, TermList<Ggx, SmithGgxCorrelated, Conductor>>,
              ModelTerms<TermList<>, TermList<Beckmann, SmithBeckmannCorrelated, Schlick>>,
              ModelTerms<TermList<>, TermList<Beckmann, SmithBeckmannRational, Schlick>>,
              ModelTerms<TermList<>, TermList<Gtr, SmithGgxCorrelated, Schlick>>,
              ModelTerms<TermList<Lambert>, TermList<Ggx, SmithGgxCorrelated, Schlick>>,
              // as they ship (model/presets.h)
              ModelTerms<TermList<LambertCoupled>, TermList<Ggx, SmithGgxCorrelated, Schlick>>,
              ModelTerms<TermList<LambertCoupled>, TermList<Ggx, SmithGgxSeparable, Schlick>>,
              ModelTerms<TermList<Lambert>, TermList<Ggx, SmithGgxCorrelated, SchlickF90>>,
              ModelTerms<TermList<DisneyDiffuse>,
                         TermList<GgxAniso, DisneyRemap, Schlick>,
                         TermList<Gtr1, DisneyCoat, SchlickWeighted>>,
              ModelTerms<TermList<>, TermList<GgxUeMobile, UeJointClamped, SchlickUe>>,
              ModelTerms<TermList<>, TermList<GgxMobile, UeMobileSimple, ConstantReflectance>>,
              ModelTerms<TermList<>, TermList<Ggx, UnityMobile, ConstantReflectance>>>;

/// [Diffuse,] D, V, F whose normal equations are fused: what most fits are of.
using HotFits = FusedList<TermList<Ggx, SmithGgxCorrelated, Schlick>,
                          TermList<Lambert, Ggx, SmithGgxCorrelated, Schlick>,
                          TermList<LambertCoupled, Ggx, SmithGgxCorrelated, Schlick>,
                          TermList<Lambert, Gtr, SmithGgxCorrelated, Schlick>>;

}  // namespace gonio::inline GONIO_ARCH
