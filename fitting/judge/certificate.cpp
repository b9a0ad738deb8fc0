#include "fitting/judge/certificate.h"

#include <cmath>
#include <limits>

namespace gonio {

Certificate certificate_of(const Problem& p, const Profile& profile) {
  Certificate c;
  c.evidence = profile.cells.empty() ? "open" : "searched";
  for (const std::size_t k : profile.parameters)
    c.parameters.push_back(p.start.model.parameters[k].name);
  c.lowest = c.thinned_cost = std::numeric_limits<double>::quiet_NaN();
  if (!profile.cells.empty()) c.thinned_cost = profile.optimum;
  c.moves = profile.moves;
  for (const auto& cell : profile.cells) {
    c.cells.push_back({cell.at, cell.cost, cell.cost_of_all});
    c.lowest = std::fmin(c.lowest, cell.cost_of_all);  // of a number and NaN, the number
  }
  return c;
}

}  // namespace gonio
