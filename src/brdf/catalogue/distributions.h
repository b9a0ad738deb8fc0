#pragma once
/// \file
/// Every term of the role 'ndf', once: a new one is its struct and its name here.

#include "brdf/formula/ndf.h"
#include "brdf/formula/ndf_anisotropic.h"
#include "brdf/formula/ndf_ggx.h"
#include "brdf/formula/ndf_shipped.h"
#include "brdf/term/term_list.h"

namespace gonio::inline GONIO_ARCH {

using Distributions = TermList<BlinnPhong,
                               Beckmann,
                               Ggx,
                               GgxUeMobile,
                               GgxMobile,
                               GgxMobileCross,
                               Gtr,
                               Gtr1,
                               GtrAsWritten,
                               BeckmannAniso,
                               BeckmannAnisoAsWritten,
                               GgxAniso,
                               StudentT,
                               Charlie,
                               StudentTail>;

}  // namespace gonio::inline GONIO_ARCH
