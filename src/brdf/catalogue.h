#pragma once
/// \file
/// Every term, role by role, and the combinations that are fused; a hot combination is one line.

#include "brdf/diffuse_terms.h"
#include "brdf/distributions.h"
#include "brdf/fresnel_terms.h"
#include "brdf/masking_terms.h"

namespace gonio::inline GONIO_ARCH {

/// In the order of Role.
using Catalogue = Joined<Distributions, MaskingTerms, FresnelTerms, DiffuseTerms>;

template <class... Lists>
struct FusedList {};

/// D·V·F inlined into one loop: the same three formulas, worth it where a profile says so.
using Hot = FusedList<TermList<Ggx, SmithGgxCorrelated, Schlick>,
                      TermList<Ggx, SmithGgxCorrelated, Conductor>>;

/// [Diffuse,] D, V, F whose normal equations are fused: what most fits are of.
using HotFits = FusedList<TermList<Ggx, SmithGgxCorrelated, Schlick>,
                          TermList<Lambert, Ggx, SmithGgxCorrelated, Schlick>,
                          TermList<LambertCoupled, Ggx, SmithGgxCorrelated, Schlick>,
                          TermList<Lambert, Gtr, SmithGgxCorrelated, Schlick>>;

}  // namespace gonio::inline GONIO_ARCH
