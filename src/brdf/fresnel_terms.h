#pragma once
/// \file
/// Every term of the role 'fresnel', once: a new one is its struct and its name here.

#include "brdf/term_list.h"
#include "optics/fresnel.h"

namespace gonio::inline GONIO_ARCH {

using FresnelTerms = TermList<Schlick, SchlickWeighted, Dielectric, Conductor>;

}  // namespace gonio::inline GONIO_ARCH
