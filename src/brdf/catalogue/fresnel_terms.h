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
                              SchlickUe,
                              SchlickSphericalGaussian,
                              LinearAsWritten,
                              ConstantReflectance,
                              Disney2015,
                              F82Tint,
                              Lazanyi,
                              Dielectric,
                              Conductor,
                              Gulbrandsen>;

}  // namespace gonio::inline GONIO_ARCH
