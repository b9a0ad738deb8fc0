#pragma once
/// \file
/// Uncertainty of the parameters: how well the data determine them.

#include <vector>

#include "fitting/judge/assess.h"
#include "fitting/result/document.h"
#include "fitting/solve/solve.h"

namespace gonio {

/// Per free slot, in their order.
struct Uncertainty {
  std::vector<ParameterStatus> status;
  std::vector<double> std_error;  ///< NaN where not known
  double t = 1.96;                ///< half width of the 95 % interval in standard errors
  std::vector<std::vector<double>> correlations;  ///< NaN for what has no error
  double condition = 1;  ///< largest over smallest eigenvalue of the bread, scaled to unit diagonal
};

/// Standard errors by the sandwich B⁻¹ M B⁻¹, which holds whether or not the metric whitens the
/// noise, with the usual correction for the degrees of freedom spent [White 1980; Liang, Zeger 1986].
/// The interval's half width is Student's t with clusters − 1 degrees of freedom, or values − unknowns;
/// without any degree of freedom nothing is known of the errors.
///
/// A parameter at its bound has no error and is held there for the others.  Any other is not
/// identifiable if moving it over its whole range changes nothing, if it belongs to a direction in
/// which the bread is singular, or if its interval is as wide as its range.
/// \param clusters  0: values are independent
Uncertainty uncertainty(const Sandwich&,
                        std::span<const double> x,
                        const Bounds&,
                        std::size_t values_used,
                        std::size_t clusters);

/// 97.5 % quantile of Student's t for ν > 0 degrees of freedom.
double student_t_975(double degrees_of_freedom);

}  // namespace gonio
