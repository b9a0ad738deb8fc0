#include "fitting/judge/bin_sensitivity.h"

#include <limits>

#include "fitting/judge/assess.h"

namespace gonio {

std::optional<BinSensitivity> bin_sensitivity(const Problem& p,
                                              const FitData<double>& scanned,
                                              const Sampling& in_use,
                                              const Sampling& elsewhere,
                                              Bins other,
                                              const Fitted& f) {
  const Fitted here = minimise(p, scanned, f.model, f.huber);
  const Fitted there = minimise(p, fit_data<double>(elsewhere, scan_samples), f.model, f.huber);
  if (!here.solution.converged || !there.solution.converged) return {};
  BinSensitivity s{std::string(name_of(other)), {}, 0, 0};
  s.log_rms_here = residual_statistics(here.model, in_use, scan_samples).log_rms;
  s.log_rms = residual_statistics(there.model, elsewhere, scan_samples).log_rms;
  for (const auto& q : p.start.model.parameters) {
    std::vector<double> change;
    for (std::size_t k = q.first; k < q.first + q.count; ++k) {
      const double x = here.model.values[k], y = there.model.values[k];
      change.push_back(x == 0 ? std::numeric_limits<double>::quiet_NaN() : y / x - 1);
    }
    s.relative_change.emplace_back(q.name, std::move(change));
  }
  return s;
}

}  // namespace gonio
