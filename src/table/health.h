#pragma once
/// \file
/// What a table can be trusted for, before anything is fitted to it.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "table/table.h"

namespace gonio {

/// ∫ f cos θ_o dω_o at one incident angle, per channel; `coverage` is the share of the
/// cosine-weighted hemisphere that valid samples speak for in the channel that has the fewest; what
/// lacks counts as their mean.  NaN for a channel where more than half lacks.
struct AlbedoSample {
  double theta_i_deg;
  std::vector<double> albedo;
  double coverage;
};

/// The specular peak as the samples near θ_h = 0 show it, from the channels' mean.
struct Peak {
  double half_width_deg;  ///< θ_h at which the value above the base has halved
  double alpha;  ///< of the GGX lobe with that width: s/√(√2 − 1 + s²), s = sin(half width)
  double samples_within;  ///< distinct θ_h within the half width
  bool resolved;          ///< at least three of them
  double height, base;    ///< [1/sr]
};

struct Health {
  std::size_t samples = 0, values = 0, valid = 0;
  std::array<std::size_t, 4> masked{};  ///< values by Mask; [valid] is `valid`
  double largest = 0, smallest_positive = 0;
  double noise_floor = 0;       ///< see noise_floor()
  std::size_t copied_rows = 0;  ///< incident angles that only repeat another, see copied_rows()
  std::vector<AlbedoSample> albedo;
  /// median |f(wi,wo) − f(wo,wi)| / mean (table/reciprocity.h); absent where the layout cannot tell
  std::optional<double> reciprocity_error;
  std::string reciprocity_note;
  std::optional<Peak> peak;
  /// relative change of Peak::alpha, with its sign, under the other bin convention; absent without bins
  std::optional<double> bin_sensitivity;
};

Health inspect(const Table&);

/// The noise floor that negative values betray [1/sr]: 1.4826 · median |negative| above the horizon,
/// where negatives are noise, make up at least 0.1 % of the values there, and are not one number that
/// marks missing data; else 0.
double noise_floor(const Table&);

/// For each incident angle of an in/out grid the first of the run of angles that hold the very same
/// values, bit for bit: itself, unless it was filled in from its neighbour.  A table of one value has
/// no copies.  Empty for other tables.
std::vector<std::size_t> first_of_copies(const Table&);
/// How many incident angles are not the first of their run.
std::size_t copied_rows(const Table&);

/// What `gonio inspect --json` prints.
std::string to_json(const Table&, const Health&);

}  // namespace gonio
