#pragma once
/// \file
/// Residuals of a thinned table, value by value, beside the angles that they may follow.

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "fitting/result/document.h"
#include "fitting/solve/problem.h"
#include "fitting/solve/search.h"
#include "table/health/facts.h"

namespace gonio::misfit {

/// Directions of misfit: what usually follows an angle, and the functions that tell it.
enum class Follows { nothing, theta_h, theta_d, grazing, azimuth };
inline constexpr std::array<std::string_view, 5> names{"", "theta_h", "theta_d", "grazing angles",
                                                       "the surface's azimuth"};

/// Smooth functions of the angles: of few samples the first `smooth`, of many the `fine`.
inline constexpr std::size_t smooth = 10, fine = 12;
inline constexpr std::array<Follows, fine> belongs{
    Follows::nothing, Follows::theta_h, Follows::theta_d, Follows::nothing,
    Follows::theta_h, Follows::theta_d, Follows::theta_d, Follows::grazing,
    Follows::grazing, Follows::grazing, Follows::theta_h, Follows::theta_h};

/// Cells of the residual map: five of the page's along each angle.
inline constexpr std::size_t rows = 9, columns = 6;
/// Edges of a row in θ_h, of a column in θ_d [degrees].
double row_edge(std::size_t row);
double column_edge(std::size_t column);

/// One value of a thinned table, as a fit compares it.
struct Value {
  std::size_t unit, channel;
  std::size_t sample;   ///< of the table
  double r;             ///< residual, clipped as the robust loss does
  double whole;         ///< before that
  double root_count;    ///< √ of the samples that it counts as, a factor of the residual
  double active;        ///< 1, or 0 where it is clipped; its weight while that settles
  double change;        ///< of the residual, by a relative change of f
  double slope;         ///< of the residual, by f, without the table's weights
  double rounding;      ///< of the residual, by what the datum's digits leave out
  double f;             ///< [1/sr]
  double variance = 0;  ///< of the residual, up to a factor
  double noise = std::numeric_limits<double>::quiet_NaN();  ///< of ln f, as its neighbours show it
  std::array<double, most_columns> j{};  ///< derivatives by the unknowns of its channel
};

/// Angles under which an instrument may scale all values alike: θ_i, the place of the light, θ_o, φ_o, and the
/// place of the detector.
enum class SharedAngle { incident, light, outgoing, azimuth, detector };
inline constexpr std::size_t shared_angles = 5;
inline constexpr std::array<std::string_view, shared_angles> shared_angle_names{
    "incident angle", "direction of the light", "outgoing angle", "azimuth", "detector position"};

/// One sample: its values share their errors.
struct Unit {
  std::array<double, fine> functions;
  std::size_t cell;
  std::array<std::size_t, shared_angles> angle;  ///< its number along each axis
  double count;                                  ///< samples that it counts as
  double nov;
  DirectionPair at;
};

/// Residuals of a table, and the units that share their errors.
struct Left {
  std::vector<Value> values;
  std::vector<Unit> units;
  std::vector<std::vector<std::size_t>> unknowns;  ///< of each channel looked at
  std::vector<std::size_t> slots;                  ///< of the unknowns
  /// Numbers of angles along each axis; 0 where the layout has no such axis.
  std::array<std::size_t, shared_angles> angles{};
  /// Place of each angle, which neighbours share but for the last number.
  std::array<std::vector<std::array<long, 2>>, shared_angles> places;
  std::size_t without_logarithm = 0;  ///< values of 0 where f is not
  double samples = 0;                 ///< that the values count as
  double directions = 0;              ///< that the units count as
  bool robust = false;
  bool stated = false;  ///< whether residuals are in standard errors that the table states
  /// Whether the surface was turned beneath the light, by anything but half turns.
  bool turned = false;
};

/// A parameter at a bound can take nothing up: it is no unknown here.
Left left_over(const Sampling&, const Problem&, const Fitted&, TableFacts&);

/// Noise is taken as the likeliest of three: of one size in f, in proportion to f, or to f/cos θ_o, as where light was divided by the
/// cosine; normal, or Cauchy's for a robust fit, before anything is clipped.  Where the table states it, it is that.
/// \return  whether in proportion to f
bool find_variances(Left&);

/// Noise of a channel's values that is no part of f: √(f² + floor²), in standard deviations, times `part`.
struct UnevenNoise {
  double part, floor;
};
/// That of each channel; empty where a part of f is all of it, the same in each channel.
std::vector<UnevenNoise> uneven_noise(const Left&);

/// Cell that is most clearly off: by its mean less two standard errors.
std::optional<MisfitCell> worst_cell(const Left&);

/// True where little else is left than rounding: of all values together, and of each by its own, lest one
/// whose digits say little hides what others miss by far.
/// \param r  their residuals
bool only_rounded(const std::vector<Value>&, std::span<const double> r);

/// About so many values, units evenly spread.
Left thinned(const Left&, std::size_t values);

}  // namespace gonio::misfit
