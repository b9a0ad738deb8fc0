#pragma once
/// \file
/// Every term of the role 'diffuse', once: a new one is its struct and its name here.

#include "brdf/formula/diffuse.h"
#include "brdf/term/term_list.h"

namespace gonio::inline GONIO_ARCH {

using DiffuseTerms = TermList<Lambert,
                              LambertCoupled,
                              LambertMetallic,
                              LambertMetallicCoupled,
                              DisneyDiffuse,
                              DisneyDiffuseCoupled,
                              FrostbiteDiffuse,
                              HammonDiffuse,
                              OrenNayar,
                              OrenNayarFujii,
                              Eon>;

}  // namespace gonio::inline GONIO_ARCH
