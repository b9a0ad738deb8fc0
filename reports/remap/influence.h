#pragma once
/// \file
/// The claim on how much masking matters at all.  For this room only.

#include "reports/remap/remap.h"

namespace gonio {

/// Adds the verdict, where a form without masking was measured.
void judge_influence_of_masking(Findings&, const RemapRows&);

}  // namespace gonio
