#include "fitting/judge/lack_of_fit.h"

#include <algorithm>
#include <cmath>

#include "fitting/judge/regression.h"

namespace gonio {
namespace {

constexpr double significant = 0.01;    ///< probability below which a misfit is one
constexpr double worth_telling = 0.01;  ///< of f
constexpr double of_an_interval = 1;    ///< squares beyond noise, of those of noise

}  // namespace

LackOfFit lack_of_fit(
    const Sampling& s, const Problem& p, const Fitted& f, double samples_used, bool shared) {
  using namespace misfit;
  LackOfFit found;
  Misfit& m = found.misfit;
  bool by_logarithms = s.metric() == Metric::log;
  Left left = left_over(s, p, f);
  if (!by_logarithms && p.free.size() > 0 && !only_rounded(left.values) && find_variances(left) &&
      100 * left.without_logarithm <= left.values.size()) {
    // Whose squares weigh such noise unequally the highlight alone determines the parameters, whose
    // errors move faint values by far more than these are wrong: and none of that is a misfit.
    const Sampling logs = s.by(Metric::log, p.offset);
    left = left_over(logs, p, compared_by(logs, p, scan_samples, f));
    by_logarithms = true;
  }
  const double looked_at = left.samples;
  const bool measured = !s.table().truth && p.options.intervals != Intervals::independent &&
                        p.options.intervals != Intervals::by_angle;
  const Regression r = regress(left, shared, measured && !shared);
  if (!r.tested) {
    m.note = r.rounded ? "what is left is no more than the values' own rounding"
             : shared  ? "the incident angles, whose values share errors, are too few to tell"
                       : "the values are too few to tell";
    return found;
  }
  m.tested = true;
  m.p = r.p;
  m.worst_cell = r.worst;
  if (auto& cell = m.worst_cell) {  // of the data, where it was of f
    const double off = cell->difference;
    cell->difference = by_logarithms ? std::expm1(off) : off / (1 - std::min(off, 0.99));
  }
  m.size = r.size;
  const double most = std::ranges::max(r.follows);
  for (std::size_t g = 1; g < names.size(); ++g)
    if (r.follows[g] > 0.5 * most) m.follows.emplace_back(names[g]);
  // Of all values, noise is as much less as there are more of them than were looked at; what values
  // share is not.
  const double more = shared ? 1 : std::max(1.0, samples_used / looked_at);
  const double excess = r.excess / r.noise * more;
  m.told = r.p < significant && r.size > r.rounding &&
           (r.size > worth_telling || excess > of_an_interval);
  if (m.told) found.widening = std::sqrt(1 + 16 * excess);
  return found;
}

double widened(double error, double widening, double seen_against) {
  return std::hypot(error, std::sqrt(widening * widening - 1) *
                               (std::isnan(seen_against) ? error : seen_against));
}

void widen(Uncertainty& u, const LackOfFit& l, std::span<const double> seen_against) {
  for (std::size_t i = 0; i < u.std_error.size(); ++i) {
    double& e = u.std_error[i];
    const double wider = widened(e, l.widening, seen_against[i]);
    u.variance[i] *= wider * wider / (e * e);
    e = wider;
  }
}

}  // namespace gonio
