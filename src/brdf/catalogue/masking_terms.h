#pragma once
/// \file
/// Every term of the role 'masking', once: a new one is its struct and its name here.

#include "brdf/formula/masking.h"
#include "brdf/formula/masking_classic.h"
#include "brdf/formula/masking_shipped.h"
#include "brdf/formula/smith_gtr.h"
#include "brdf/formula/smith_student.h"
#include "brdf/term/term_list.h"

namespace gonio::inline GONIO_ARCH {

using MaskingTerms = TermList<SmithGgxSeparable,
                              SmithGgxCorrelated,
                              SmithGgxAnisoCorrelated,
                              SmithBeckmannSeparable,
                              SmithBeckmannCorrelated,
                              SmithBeckmannAnisoCorrelated,
                              SmithBeckmannRational,
                              SmithGtrSeparable,
                              SmithGtrCorrelated,
                              SchlickGgxHalfAlpha,
                              SchlickGgxDirect,
                              SchlickGgxHalfRoughness,
                              SchlickBeckmann,
                              UeJoint,
                              UeJointClamped,
                              Hammon,
                              DisneyRemap,
                              DisneyCoat,
                              UnityMobile,
                              UnityMobileUrp,
                              UeMobileSimple,
                              CookTorrance,
                              Neumann,
                              Kelemen,
                              Implicit,
                              Unmasked,
                              SmithGgxAnisoSeparable,
                              SmithCharlie,
                              SmithStudentSeparable,
                              SmithStudentCorrelated>;

}  // namespace gonio::inline GONIO_ARCH
