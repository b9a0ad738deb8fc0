#include "fitting/judge/stated.h"

#include <cmath>

namespace gonio {

std::optional<BesideStated> beside_stated(const Sampling& s,
                                          const Problem& p,
                                          double cost,
                                          double values) {
  const double freedom = values - static_cast<double>(p.free.size());
  if (!s.in_uncertainties() || s.metric() == Metric::relative || p.options.robust || freedom < 1)
    return {};
  // χ² is nearly the cube of a normal variate [Wilson, Hilferty 1931].
  constexpr double one_in_1000 = 3.09;
  const double part = 2 / (9 * freedom);
  return BesideStated{2 * cost / freedom,
                      2 * cost / freedom <= std::pow(1 - part + one_in_1000 * std::sqrt(part), 3)};
}

}  // namespace gonio
