#pragma once
/// \file
/// Health of a table: what it can be trusted for, before anything is fitted to it.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/names.h"
#include "table/health/next_direction.h"
#include "table/health/noise.h"
#include "table/health/peak.h"
#include "table/table.h"

namespace gonio {

class TableFacts;

/// ∫ f cos θ_o dω_o at one incident angle, per channel; `coverage` is the share of the
/// cosine-weighted hemisphere that valid samples speak for in the channel that has the fewest; what
/// lacks counts as their mean.  NaN for a channel where more than half lacks.
struct AlbedoSample {
  double theta_i_deg, phi_i_deg;
  std::vector<double> albedo;
  double coverage;
  double error;  ///< no channel's integral over what is between samples is further off
};

/// Why a highlight's width is not the surface's alone.
enum class PeakLimit {
  none,
  samples,  ///< fewer than three within the half width, or each an average over more than that
  bins,     ///< the other bin convention changes alpha by more than a tenth
  aperture  ///< no wider than 1.5 times what the instrument makes of a mirror
};
template <>
inline constexpr std::array<std::string_view, 4> names_of<PeakLimit>{"none", "samples", "bins",
                                                                     "aperture"};

/// The specular peak, and what limits it.
struct Highlight : Peak {
  PeakLimit limit = PeakLimit::none;
  /// relative change of Peak::alpha, with its sign, under the other bin convention; absent without bins
  std::optional<double> bin_sensitivity;
};
/// "half width 5.6° (like GGX alpha 0.15), 23 samples within: resolved"
std::string peak_in_words(const Highlight&);

enum class Verdict { no, weakly, yes };
template <>
inline constexpr std::array<std::string_view, 3> names_of<Verdict>{"no", "weakly", "yes"};

/// Verdict on whether the table can determine something, and the figure that says so.
struct Prospect {
  std::string of;
  Verdict verdict;
  std::string because;
};

struct Health {
  std::size_t samples = 0, values = 0, valid = 0;
  std::array<std::size_t, 4> masked{};  ///< values by Mask; [valid] is `valid`
  double largest = 0, smallest_positive = 0;
  double noise_floor = 0;          ///< see noise_floor()
  std::size_t copied_rows = 0;     ///< incident angles that only repeat another, see copied_rows()
  std::size_t copied_columns = 0;  ///< outgoing angles likewise
  std::vector<AlbedoSample> albedo;
  std::vector<std::string> albedo_left_out;  ///< angles of incidence without an albedo, and why
  /// median |f(wi,wo) − f(wo,wi)| / mean (table/health/reciprocity.h); absent where the layout cannot tell
  std::optional<double> reciprocity_error;
  std::string reciprocity_note;
  Noise noise;
  std::optional<Highlight> peak;
  std::size_t peak_profiles = 0;  ///< PeakSearch::profiles
  double peak_contrast = 0;       ///< PeakSearch::contrast
  std::optional<Peak> retro;      ///< see retro_peak()
  std::vector<Prospect> prospects;
  /// Oddities of the values themselves: more light than arrives, or a cosine left in them.
  std::vector<std::string> warnings;
};

Health inspect(const Table&);

/// Median of the stated standard uncertainties over their values; NaN where none are stated.
double typical_uncertainty(const Table&);

/// The noise floor that negative values betray [1/sr]: 1.4826 · median |negative| above the horizon,
/// where negatives are noise, make up at least 0.1 % of the values there, and are neither one number that
/// marks missing data nor an offset; else 0.
double noise_floor(TableFacts&);
/// The same, of an offset as well: what logarithms of dark values bear to be shifted by.
double spread_of_negatives(const Table&);
/// Median |negative| [1/sr] where such values follow their neighbours, as those do from which too much was taken off; else 0.
double negative_offset(TableFacts&);
double noise_floor(const Table&);
/// The channel that holds all the negative values, where these follow their neighbours and are no noise.
std::optional<std::size_t> negative_channel(TableFacts&);

/// For each angle of an in/out grid's axis 0 (incident) or 1 (outgoing) the first of the run of angles
/// that hold the very same values, bit for bit: itself, unless it was filled in from its neighbour.  A
/// slice of one value is no copy.  Empty for other tables.
std::vector<std::size_t> first_of_copies(const Table&, std::size_t axis = 0);
/// Number of angles that are not the first of their run.
std::size_t copied_rows(const Table&, std::size_t axis = 0);
/// Pairs of an incident and an outgoing angle, [θ_i · sizes of θ_o + θ_o], one of which only repeats
/// another.  Empty where none does.
std::vector<bool> copied_pairs(const Table&);

/// Incident angles of a list: those within 0.001° are one.
struct IncidentAngles {
  std::size_t count = 0;
  std::vector<std::uint32_t> number;  ///< of each sample's, in ascending order
};
IncidentAngles incident_angles(const DirectionList&);

/// "45 theta_i × 45 theta_o × 90 phi", "855 samples"
std::string layout_text(const Table&);

/// Document of `gonio inspect --json`.  \param next  of --plan-next
std::string to_json(const Table&,
                    const Health&,
                    std::optional<std::vector<NextDirection>> next = {});
/// JSON Schema of that document.
std::string health_schema();

}  // namespace gonio
