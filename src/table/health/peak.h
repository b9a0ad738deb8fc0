#pragma once
/// \file
/// A table's highlight as the samples show it, without fitting a model.

#include <optional>

#include "table/table.h"

namespace gonio {

/// Where a highlight may sit.
enum class Around {
  half_vector,  ///< θ_h = 0, where a mirror or a microfacet lobe has it
  retro         ///< θ_d = 0: wo = wi, where a retro-reflector sends the light
};

/// The highlight over the angle θ_h (or θ_d, around the retro direction), from the channels' mean.
struct Peak {
  double half_width_deg;  ///< angle at which the value above the base has halved
  double
      alpha;  ///< of the GGX lobe with that width over θ_h: s/√(√2 − 1 + s²), s = sin(half width)
  double samples_within;  ///< distinct angles within the half width
  bool resolved;          ///< at least three of them, and no narrower than Table::patch_deg
  double height, base;    ///< [1/sr]
  double base_deg;        ///< angle that a tenth of the samples, which show the base, lie beyond
};

struct PeakSearch {
  std::optional<Peak> peak;
  std::size_t profiles = 0;  ///< that reach the place where the highlight would be
  double contrast = 0;  ///< median of their height/base; infinite where the base is not positive
};

/// At each of eight θ_d from 5° to 45° (around the retro direction: of eight θ_h) the samples' mean
/// over channels (and φ_d) makes a profile over the other angle, used if it has eight angles or more,
/// the first within 3° of 0 and not 0.25° later than the best profile's: one that starts beside a
/// narrow highlight says nothing of it.  Its height is the largest of the three values nearest 0 (around
/// the retro direction the second: a highlight there is more than one value), its base the value that a
/// tenth of the profile stays below; the peak holds the medians over these profiles.  Absent where half
/// of the profiles or more stay below 1.5 times their base.
/// \param bins  where samples sit in their bins
PeakSearch find_peak(const Table&, Bins bins, Around = Around::half_vector);

/// The highlight around the retro direction, where it is the table's highlight: at least twice its
/// base, and higher above it than the one around the half vector.  A microfacet lobe cannot describe it.
std::optional<Peak> retro_peak(const Table&, const std::optional<Peak>& half_vector);

}  // namespace gonio
