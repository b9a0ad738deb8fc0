#pragma once
/// \file
/// Every term, once.  A new term is its struct and its name in this list; a hot combination is one
/// line in the second.

#include "brdf/diffuse.h"
#include "brdf/masking.h"
#include "brdf/ndf.h"
#include "optics/fresnel.h"

namespace gonio::inline GONIO_ARCH {

template <template <class> class... Terms>
struct TermList {};

using Catalogue = TermList<Ggx,
                           Gtr,  // D
                           SmithGgxSeparable,
                           SmithGgxCorrelated,  // V
                           Schlick,
                           Dielectric,
                           Conductor,  // F
                           Lambert,
                           LambertCoupled>;  // diffuse

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
