#pragma once
/// \file
/// Every term of the role 'masking', once: a new one is its struct and its name here.

#include "brdf/masking.h"
#include "brdf/term_list.h"

namespace gonio::inline GONIO_ARCH {

using MaskingTerms = TermList<SmithGgxSeparable, SmithGgxCorrelated>;

}  // namespace gonio::inline GONIO_ARCH
