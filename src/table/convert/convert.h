#pragma once
/// \file
/// A table in another layout, and what that loses.

#include <optional>
#include <string>
#include <vector>

#include "base/names.h"
#include "table/table.h"

namespace gonio {

struct ConvertOptions {
  std::string format;                 ///< merl, mbsdf, utia, csv, exr, rgl or zemax
  std::vector<std::string> channels;  ///< which, in this order; empty: all
  /// Bin convention of the result; else the source's.  The result's sizes where the layout leaves them open: the
  /// source's if that is of the format, else 45 × 45 × 90 (MBSDF) or 90 × 90 (slice).
  std::optional<Bins> bins;
  std::optional<std::size_t> n_theta;  ///< of MBSDF, and of RGL's incident angles (32)
  std::optional<std::size_t> n_phi;    ///< of MBSDF
  std::optional<std::size_t> n_grid;   ///< of RGL's values, along each side (64)
  bool spectral = false;               ///< of RGL: r, g, b as spectra (rgb_spectra.h)
  std::optional<double> phi_d_deg;     ///< of a slice; else as the source's, or 90
  double reach_deg = 2;  ///< from a list: how far an empty bin looks for a sample, in wi and in wo
};

/// Differences are relative to the mean of the two values: 2 |a − b|/(a + b), at most 2.
struct Loss {
  enum class Method {
    copied,        ///< the same bins, or the same list
    listed,        ///< each bin as its direction; those below the horizon are left out
    interpolated,  ///< between the source's samples (Interpolator)
    gathered  ///< the mean of the samples in a bin; in an empty bin the nearest within reach, to
              ///< a quarter of that
  };
  Method method = Method::copied;
  std::size_t bins = 0;          ///< above the horizon
  std::size_t without_data = 0;  ///< of these, in the channel where that is most
  std::size_t nearest = 0;       ///< of these, those that took a sample from outside
  std::size_t left_out = 0;      ///< bins below the horizon that a list does not name
  /// Medians over the pairs of values that the result has one for: φ and −φ (in MBSDF), (wi, wo) and
  /// (wo, wi) (in MERL's 180 bins).  Absent where the source has one for both already.
  std::optional<double> mirror, reciprocity;
  bool one_phi_d = false;   ///< the source is a slice, taken to hold for every phi_d
  bool rounded = false;     ///< to float, 6e-8
  bool replicated = false;  ///< one channel as three
  bool weights_dropped = false;
  std::vector<std::string> dropped;  ///< channels
  std::vector<std::string> renamed;  ///< channels that have become r, g, b
  bool filled = false;      ///< what is without data has the value of the nearest that is not
  bool to_spectra = false;  ///< r, g, b have become spectra
  /// Mean change of f as the surface is turned (change_with_azimuth()), averaged over; absent where that is not known.
  std::optional<double> azimuth;
  /// There and back: the result, interpolated at the source's valid samples, against their values.
  std::size_t compared = 0, lost = 0;  ///< values; those that nothing comes back for
  double rms = 0, largest = 0;         ///< differences
  std::optional<double> most;          ///< the one that 99 % do not pass; of RGL
  DirectionPair largest_at{};          ///< where that is
};
template <>
inline constexpr std::array<std::string_view, 4> names_of<Loss::Method>{"copied", "listed",
                                                                        "trilinear", "gathered"};

/// RGL's isotropic files are refused tables that change more than that as they are turned.
inline constexpr double most_change = 0.15;

struct Conversion {
  Table table;
  Loss loss;
};

/// To RGL: the function between the samples (Interpolator; of a list that has none its MBSDF grid, gathered) at the points that
/// rgl_table() chooses, turned eight times where the table has several azimuths of light.  There and back is by what renderers
/// evaluate (table/format/rgl/function.h), but for least_cosine above the horizon, where the format's values say nothing.  bad_input where f changes as the surface is turned
/// (most_change).
///
/// To Zemax: light from azimuth 0, φ and −φ averaged; lists and the change with azimuth as to RGL.
///
/// Masked values stay without data: −1 in MERL, else NaN.  The truth stays where values do.  Wrong
/// usage where the format cannot hold the channels; bad_input where a list's samples reach less than
/// half of the bins, and where one is to become UTIA's that neither has UTIA's directions nor says what lies between its own.
Conversion convert(const Table&, const ConvertOptions&);

}  // namespace gonio
