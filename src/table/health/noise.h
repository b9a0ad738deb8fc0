#pragma once
/// \file
/// Noise of a table's values, told from the values alone.

#include <optional>
#include <string>
#include <vector>

#include "table/table.h"

namespace gonio {

/// The spread among the values whose angle, or size, lies in [from, to).
struct NoiseBand {
  double from, to;
  std::size_t values;
  double sigma;
};

/// σ of ln f: the relative error that a value has independently of its neighbours.
///
/// On a line of samples (a grid's axis, or samples of a list that differ in one angle) each ln f is
/// compared with the polynomial through its 4 neighbours on either side; the difference, divided by
/// √(1 + Σ weights²), has the spread σ of one value whatever the smooth curve, and its median size
/// times 1.4826 is σ without regard for outliers.  Of the lines along each angle those with the
/// smallest spread speak.  Where 3 neighbours on either side leave a fourth more than 4 do, what is
/// left is the curve's own shape: then, and below 1e-4, σ is only an upper bound.  Errors that
/// neighbours share (an adjustment, a table that was smoothed or interpolated) cannot be seen.
struct Noise {
  std::optional<double> sigma;   ///< absent where no line has nine valid positive values
  bool bound = false;            ///< σ is at most that
  std::string along;             ///< the angle that varies along the lines, or "repeats"
  std::vector<double> channels;  ///< σ per channel; NaN where it cannot be told
  /// Where: over the larger of the two zenith angles [degrees], and over the value [1/sr].  Bands of
  /// fewer than 50 values are left out; empty where σ is a bound.
  std::vector<NoiseBand> over_angle, over_value;
};

/// Noise of one value: its difference from the polynomial through its neighbours, in ln f, scaled to the spread of one value.
struct NoiseSample {
  std::size_t sample, channel;
  double fewer, more;  ///< by 3 and by 4 neighbours on either side
};
/// Samples along the angle whose lines have the smallest spread, or pairs of repeated ones.
struct NoiseSamples {
  std::string along;
  std::vector<NoiseSample> all;
};
NoiseSamples noise_samples(const Table&);

/// Samples measured more than once tell most directly: where a list has 50 such pairs, they speak.
Noise estimate_noise(const Table&, const NoiseSamples&);
inline Noise estimate_noise(const Table& t) {
  return estimate_noise(t, noise_samples(t));
}

/// True where negative values follow their neighbours, as those do that an offset carries below 0: their distance from the line between
/// these, over their size, is small, by medians along the angle where it is most.  Noise is further off than it is large.
bool negatives_follow_neighbours(const Table&);

}  // namespace gonio
