#pragma once
/// \file
/// The specular peak as the samples show it, without fitting a model.

#include <optional>

#include "table/health.h"

namespace gonio {

/// At each of eight θ_d from 5° to 45° the samples' mean over channels (and φ_d) makes a profile over
/// θ_h: its height is the largest of the three values nearest θ_h = 0, its base the value that a tenth
/// of the profile stays below; the peak holds the medians over these profiles.  Absent where half of
/// the profiles or more stay below 1.5 times their base.  \param bins  where samples sit in their bins
std::optional<Peak> find_peak(const Table&, Bins bins);

}  // namespace gonio
