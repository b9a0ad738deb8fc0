// What the index decides by: how long the tails of measured highlights are, and what fits leave of
// them.
#include <algorithm>

#include "base/quantile.h"
#include "reports/cross_fit/cross_fit.h"

namespace gonio {

Facts facts(const CrossFitRows& r) {
  Facts f;
  if (r.published.empty()) return f;
  const auto middle = [&](double PublishedFit::*of) {
    std::vector<double> all;
    for (const auto& p : r.published) all.push_back(p.*of);
    return median(all);
  };
  std::vector<double> gamma;
  for (const auto& p : r.published)
    if (p.gamma_determined) gamma.push_back(p.gamma);
  if (gamma.empty()) return f;
  const auto longer = std::ranges::count_if(gamma, [](double g) { return g < 2; });
  f.tails = Facts::Tails{gamma.size(), static_cast<std::size_t>(longer), median(gamma),
                         middle(&PublishedFit::ggx_log_rms), middle(&PublishedFit::gtr_log_rms)};
  return f;
}

}  // namespace gonio
