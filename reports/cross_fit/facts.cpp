// What the index decides by: how far GGX is from surfaces with other tails.
#include <algorithm>
#include <cmath>

#include "reports/cross_fit/cross_fit.h"

namespace gonio {

Facts facts(const CrossFitRows& r) {
  struct Sum {
    std::string truth;
    double squares = 0;
    std::size_t n = 0;
  };
  std::vector<Sum> sums;
  for (const auto& c : r.cases) {
    if (c.fitted != "ndf.ggx" || c.kind != "distribution" || c.metric != Metric::log ||
        c.layout != cross_layouts[0].name || c.truth.find("orders") != c.truth.npos ||
        !std::isfinite(c.log_rms))
      continue;
    auto at = std::ranges::find(sums, c.truth, &Sum::truth);
    if (at == sums.end()) at = sums.insert(at, {c.truth});
    at->squares += c.log_rms * c.log_rms;
    ++at->n;
  }
  Facts f;
  for (const auto& s : sums)
    f.tails.push_back({s.truth, std::sqrt(s.squares / static_cast<double>(s.n))});
  return f;
}

}  // namespace gonio
