#pragma once
/// \file
/// Residuals of a model by the logarithm that fits compare with, summed by incident angle.

#include <cstddef>
#include <map>

#include "brdf/model/model.h"
#include "fitting/sample/sampling.h"

namespace gonio {

/// Sums of ln(f + offset) − ln(y + offset) over values.
struct LogResiduals {
  double values = 0, sum = 0, squares = 0;

  void add(const LogResiduals& other) {
    values += other.values;
    sum += other.sum;
    squares += other.squares;
  }
  /// √(Σ r²/values); not a number without values.
  double rms() const;
};

/// Sums of each incident angle, by its key (IncidentKeys).
using ResidualsByAngle = std::map<std::size_t, LogResiduals>;
/// Residuals of a model at the samples, f no less than `faintest`; a value that counts as several is so many.
/// \param s     by Metric::log
/// \param most  about how many groups of samples are looked at
ResidualsByAngle log_residuals(const Sampling& s,
                               const BoundModel&,
                               std::size_t most = static_cast<std::size_t>(-1));
LogResiduals total(const ResidualsByAngle&);

/// Number of independent values that these are worth: values over the design effect 1 + (m − 1) ρ, m = Σ n²/Σ n over the n values of
/// each incident angle, ρ the correlation of residuals within one, from their variances within and between.  At least the number
/// of angles.                                                                 [Kish 1965; Donner & Koval 1980]
/// \param step  values of the table for one that was looked at
double effective_values(const ResidualsByAngle&, double step = 1);

}  // namespace gonio
