#pragma once
/// \file
/// Every term of the role 'fresnel', once: a new one is its struct and its name here.

#include "brdf/term/term_list.h"
#include "optics/fresnel.h"
#include "optics/fresnel_approximate.h"

namespace gonio::inline GONIO_ARCH {

using FresnelTerms = TermList<Schlick,
                              SchlickF90,
                              SchlickWeighted,
                              SchlickF90Weighted,
                              SchlickMetallic,
                              SchlickReflectance,
                              SchlickUe,
                              SchlickSphericalGaussian,
                              LinearAsWritten,
                              ConstantReflectance,
                              Disney2015,
                              F82Tint,
                              Lazanyi,
                              Dielectric,
                              DielectricWeighted,
                              Conductor,
                              ConductorWeighted,
                              Gulbrandsen>;

}  // namespace gonio::inline GONIO_ARCH
