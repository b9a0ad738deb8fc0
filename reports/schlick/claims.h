#pragma once
/// \file
/// Claims on the Fresnel term beside its own error.  For this room only.

#include "reports/schlick/schlick.h"

namespace gonio {

/// Adds the verdicts: on what other factors get wrong, on F0 as the mark of a metal, on a colour beside F.
void judge_what_stands_beside_f(Findings&, const SchlickRows&);

}  // namespace gonio
