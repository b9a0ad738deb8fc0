#pragma once
/// \file
/// Every term, role by role.

#include "brdf/catalogue/diffuse_terms.h"
#include "brdf/catalogue/distributions.h"
#include "brdf/catalogue/fresnel_terms.h"
#include "brdf/catalogue/masking_terms.h"

namespace gonio::inline GONIO_ARCH {

/// In the order of Role.
using Catalogue = Joined<Distributions, MaskingTerms, FresnelTerms, DiffuseTerms>;

}  // namespace gonio::inline GONIO_ARCH
