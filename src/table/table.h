#pragma once
/// \file
/// The table: reflectance samples, where each was taken, and what is known about them.  Every reader
/// ends in one, every instrument starts from one.

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/memory.h"
#include "base/names.h"
#include "geometry/aperture.h"
#include "geometry/half_difference.h"

namespace gonio {

/// Where a stored sample sits in its bin.  Files do not say, tools disagree, and half a bin shifts
/// alpha by 4 to 15 %: so it is explicit everywhere.
enum class Bins { centre, edge };
template <>
inline constexpr std::array<std::string_view, 2> names_of<Bins>{"centre", "edge"};

/// One axis of a grid: size bins over [0, span].
struct Axis {
  enum class Spacing {
    uniform,    ///< angle = span (i + offset)/size
    quadratic,  ///< angle = span ((i + offset)/size)², MERL's theta_h
    inclusive,  ///< angle = span i/(size − 1): both ends are samples, there are no bins
    constant    ///< one sample, at span
  };
  std::string name;  ///< theta_h, theta_d, phi_d, theta_i, theta_o or phi
  Spacing spacing;
  std::size_t size;
  double span;  ///< [rad]

  bool has_bins() const { return spacing == Spacing::uniform || spacing == Spacing::quadratic; }
  /// The angle of sample i [rad].
  double angle(double i, Bins) const;
  /// Its inverse: fractional sample index of an angle; may lie outside [0, size − 1].
  double index(double angle, Bins) const;
  bool operator==(const Axis&) const = default;
};

/// Samples on three axes, the last fastest.
struct Grid {
  enum class Kind {
    half_difference,  ///< theta_h, theta_d, phi_d; phi_h = 0; over 2π in phi_d if not reciprocal
    in_out            ///< theta_i, theta_o, phi = phi_o − phi_i; phi = π is the mirror direction
  };
  Kind kind;
  std::array<Axis, 3> axes;
  Bins bins = Bins::centre;

  std::size_t size() const { return axes[0].size * axes[1].size * axes[2].size; }
  std::array<std::size_t, 3> unravel(std::size_t i) const {
    const std::size_t row = i / axes[2].size;
    return {row / axes[1].size, row % axes[1].size, i % axes[2].size};
  }
  bool operator==(const Grid&) const = default;
};

/// Samples anywhere, in degrees as their file has them.
struct DirectionList {
  std::vector<double> theta_i_deg, phi_i_deg, theta_o_deg, phi_o_deg;
};

/// Model and disturbances that a synthesized table was made from.
struct Truth {
  std::string model;
  std::vector<std::pair<std::string, std::vector<double>>> parameters;
  double noise = 0;     ///< σ of the multiplicative noise exp(σ z)
  double floor = 0;     ///< added to every value [1/sr]
  double outliers = 0;  ///< share of samples replaced
  std::uint64_t seed = 0;
};

/// The values of one channel; `Values(n)` is not filled.
using Values = std::vector<double, ArrayAllocator<double>>;

/// A reader refuses a table of more values, directions included, than this: 0.5 GB.
inline constexpr std::size_t most_values = std::size_t{1} << 26;

/// A reader refuses a table of more channels than this.
inline constexpr std::size_t most_channels = 4096;

/// Where a format stores f cos θ_o, the cosine is divided out, but not below this: within 0.6° of the
/// horizon the quotient is noise over the angle's own error.  There the value becomes NaN.
inline constexpr double least_cosine = 0.01;

/// Values as stored: f_r in 1/sr, without the cosine; invalid ones included (see mask()).
struct ColumnMap;

struct Table {
  std::string path;
  std::string sha256;  ///< of the file, where reading it had a reason to know
  std::string format;  ///< "csv", "merl", "mbsdf", "exr", "rgl", "klems", "alta", "utia", "ngan",
                       ///< "astm", "ssdd", "zemax", "tensor_tree", "brdf_json", "xompt"
  std::vector<std::string> channels;  ///< "r", "g", "b"; "f" if there is one
  std::variant<Grid, DirectionList> where;
  std::vector<Values> values;  ///< [channel][sample]
  /// Standard uncertainty of each value [1/sr], above 0 where the value is one; empty: none is stated.
  std::vector<Values> errors;
  std::vector<double> weights;    ///< per sample; empty: all 1
  bool negative_is_noise = true;  ///< else a negative value is the format's mark for "no data"
  std::optional<Truth> truth;     ///< if gonio made it
  std::vector<std::pair<std::string, std::string>> notes;  ///< further metadata, as strings
  std::vector<std::string> warnings;  ///< what is odd about the file, though it could be read
  /// How the columns of a CSV file were read; null: of another table.
  std::shared_ptr<const ColumnMap> columns;
  /// f_r of a channel between the samples of a list, where the format itself defines it everywhere;
  /// NaN where it does not.
  std::function<double(const DirectionPair&, std::size_t channel)> between;
  /// The angle that each value of a list is an average over, for wi and wo alike; 0: points.
  double patch_deg = 0;
  Aperture aperture;            ///< what each value is the mean over, as far as the file says
  std::vector<double> patches;  ///< ∫ cos θ_o dω_o of the patch that each sample's value is the
                                ///< mean of; empty: points

  std::string mask;  ///< expression that leaves samples out; "": none
  /// Samples that it left out, for pictures; null: none.
  std::shared_ptr<const Table> left_out;

  std::size_t size() const { return values.empty() ? 0 : values[0].size(); }
  const Grid* grid() const { return std::get_if<Grid>(&where); }
  const DirectionList* list() const { return std::get_if<DirectionList>(&where); }
  /// The convention assumed; of a list, which has no bins, the default.
  Bins bins() const { return grid() ? grid()->bins : Bins::centre; }
  /// True where a bin convention matters.
  bool has_bins() const;
};

/// The angles of each sample, quickly: sines and cosines of a grid's axes are computed once.
class SampleAngles {
 public:
  explicit SampleAngles(const Table& t) : SampleAngles(t, t.bins()) {}
  /// Angles as if the grid followed that convention.
  SampleAngles(const Table&, Bins);

  Angles<double> operator()(std::size_t i) const;
  /// Samples that differ in the last axis alone: those of a grid's row, or one of a list.
  std::size_t row_size() const;
  /// Angles of one row, sample by sample.
  class Row;
  Row row(std::size_t number) const;
  DirectionPair directions(std::size_t i) const;
  /// With the surface's tangent at azimuth 0; a grid does not say how the surface was turned.
  FrameAngles<double> frame(std::size_t i) const { return frame_angles(directions(i)); }
  HalfDifference half_difference(std::size_t i) const;
  /// Incident zenith angle [rad].
  double theta_i(std::size_t i) const;

 private:
  const Table& table_;
  Bins bins_;
  std::array<std::vector<SinCos>, 3> axes_;
};

class SampleAngles::Row {
 public:
  Row(const SampleAngles& at, std::size_t number);
  /// True where noh, voh and sin2_theta_h are the same in the whole row; then nol and nov are
  /// middle() ∓ swing() cos_phi_d().
  bool is_level() const { return theta_h_ != nullptr; }
  double middle() const { return theta_h_->cos * theta_d_->cos; }
  double swing() const { return theta_h_->sin * theta_d_->sin; }
  std::size_t first() const { return first_; }  ///< sample of the row
  double cos_phi_d(std::size_t column) const { return at_->axes_[2][column].cos; }
  Angles<double> operator()(std::size_t column) const {
    if (!theta_h_) return (*at_)(first_ + column);
    return angles(*theta_h_, *theta_d_, at_->axes_[2][column].cos);
  }

 private:
  const SampleAngles* at_;
  std::size_t first_;
  const SinCos *theta_h_ = nullptr, *theta_d_ = nullptr;  ///< of a half/difference grid
};

inline SampleAngles::Row SampleAngles::row(std::size_t number) const {
  return Row(*this, number);
}

/// Why a value is not used.
enum class Mask { valid, below_horizon, negative, not_finite };
template <>
inline constexpr std::array<std::string_view, 4> names_of<Mask>{"valid", "below_horizon",
                                                                "negative", "not_finite"};
/// The cosine up to which a direction is below the horizon: that of 90° in radians is not quite 0.
inline constexpr double horizon_cosine = 1e-9;
/// Geometry first: a value below the horizon is that, whatever is stored there.
inline Mask mask(const Angles<double>& a, double value) {
  if (!(a.nol > horizon_cosine && a.nov > horizon_cosine)) return Mask::below_horizon;
  if (!std::isfinite(value)) return Mask::not_finite;
  return value < 0 ? Mask::negative : Mask::valid;
}

/// f_r between samples.
class Interpolator {
 public:
  explicit Interpolator(const Table& t) : table_(t), at_(t) {}
  /// Value of a grid: trilinear over the valid corners of the cell; NaN where they carry half of its weight
  /// or less, or outside the grid by more than a bin.  Of a list: Table::between, or NaN.
  double operator()(const DirectionPair&, std::size_t channel) const;

 private:
  const Table& table_;
  SampleAngles at_;
};

}  // namespace gonio
