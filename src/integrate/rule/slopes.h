#pragma once
/// \file
/// Half vectors by their slopes, in columns: what the integrals over facets share.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "brdf/model/evaluate.h"

namespace gonio {

/// Columns of angles that are written one by one, longer when needed; of the last run's length.
class AngleBlock {
 public:
  explicit AngleBlock(bool frame) : frame_(frame) {}
  /// \return NoL, NoV, NoH, VoH, sin² θ_h, and where there is a frame XoH, YoH, XoL, YoL, XoV, YoV: each
  ///         n long, padded with 0.5
  std::span<double* const> resize(std::size_t n);
  Block<double> block() const;
  /// A further column, as long.
  double* extra(std::size_t i);

 private:
  bool frame_;
  std::size_t capacity_ = 0, padded_ = 0;
  std::vector<Column<double>> columns_, extra_;
  std::vector<double*> pointers_;
};

/// Sets the k-th of such columns to a half vector and the light that v mirrors in it,
/// NoL = 2 VoH NoH − NoV.
/// \return NoL; 0 where the light or v is behind: the columns then hold what no term minds
double put_half_vector(std::span<double* const> columns,
                       std::size_t k,
                       double nov,
                       double noh,
                       double voh,
                       double sin2_theta_h);

/// A term's values for one channel, in its own order.
std::vector<double> term_parameters(const BoundModel&, const TermUse&, std::size_t channel);

/// A term over a block: D, V, F, or a diffuse term by itself.
void term_values(std::size_t term,
                 std::span<const double> parameters,
                 const Block<double>&,
                 double* out);

/// The widths (α_x, α_y) of a distribution: 2.6 times the slope tan θ_h at which D cos⁴θ_h, the density of
/// slopes, has begun to fall as fast as 1/√tan θ_h; of GGX that is α.  At most 1.
std::array<double, 2> slope_widths(std::size_t ndf, std::span<const double> parameters);

}  // namespace gonio
