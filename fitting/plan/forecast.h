#pragma once
/// \file
/// Forecast of a fit's intervals once more directions are measured.  Includes Eigen: for the sources of this room.

#include <span>
#include <vector>

#include <Eigen/Core>

namespace gonio {

/// Derivatives of the residuals of one sample, over the noise of a value: [channel][unknown].
using SampleRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using SampleList = std::span<const SampleRows* const>;

/// Findings of a fit so far.  Unknowns are in any unit, the same here and in SampleRows.
struct FitSoFar {
  Eigen::MatrixXd information;     ///< Σ j jᵀ over the table's values, j as in SampleRows
  std::vector<SampleRows> values;  ///< these, sample by sample, where they are few; else empty
  Eigen::VectorXd range;           ///< within which each unknown is looked for
  Eigen::VectorXd std_error;       ///< as the fit tells it; NaN where it tells none
  Eigen::VectorXd width;           ///< of the fit's 95 % interval; NaN where there is none
  double freedom = 1;              ///< values less unknowns
  /// True where new values would err as the table's do beyond their noise: by a misfit, or together.
  bool in_proportion = false;
};

/// Intervals of a fit to the table and further samples.  With the information A of both, and a range that is known
/// beforehand (a uniform density's variance),
///
///   V = (A + diag(12/range²))⁻¹,   width_k = 2 t √(V_kk (1 + (e_k² − 1) o_k)),   t of N − p degrees of freedom
///
/// o_k is the table's share in the variance, Σ b² over its values over V_kk, b = (V j)_k; e_k² is what the fit's own variance (of a
/// sandwich, which knows of noise that is not alike) is of that which noise alike would make, as far as ν values can tell it:
/// (ν e² + 8)/(ν + 8).  Where there is a misfit, or incident angles share errors, standard errors stay in proportion to the fit's,
/// and Student's t, of as few degrees of freedom as the fit's width is of its error, gains one by each sample: a further angle.
/// The table is taken to say nothing of an unknown without an interval.
class Forecast {
 public:
  explicit Forecast(FitSoFar);

  /// V with these samples besides.
  Eigen::MatrixXd covariance(SampleList more) const;
  /// Widths of the intervals that the spread of the estimates asks.  No sample widens one with e_k² of 1 or more; of a fit that tells
  /// less than its noise makes, one may.
  Eigen::VectorXd widths(SampleList more) const;
  /// Widths that the fit will tell.  It allows for what few values know of their own noise: HC3's Σ b²/(1 − h) in place of Σ b², and as
  /// many degrees of freedom as values that an unknown rests on, 1/Σ β⁴ with β² = b²/V_kk.  See Sandwich and uncertainty().
  /// Within each 2 t √… as above.
  Eigen::VectorXd told_widths(SampleList more) const;
  /// Diagonal of V after one more sample, of a V that is known:  V_kk − |L⁻¹ J V|²,  L Lᵀ = 1 + J V Jᵀ.
  static Eigen::VectorXd variances_after(const Eigen::MatrixXd& v, const SampleRows& j);

 private:
  struct Sums;
  Sums sums(SampleList more) const;
  Eigen::VectorXd factor(const Sums&) const;
  /// Student's t of an unknown with these samples, of at most so many degrees of freedom.
  double t_of(const Sums&, Eigen::Index unknown, double most) const;

  FitSoFar fit_;
  Eigen::VectorXd excess_;  ///< e²
  Eigen::VectorXd
      shared_;  ///< degrees of freedom of the fit's widths, where they stay in proportion
};

}  // namespace gonio
