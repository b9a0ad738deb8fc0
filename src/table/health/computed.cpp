#include "table/health/computed.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "base/quantile.h"

namespace gonio {

bool one_value_per_angle(const Table& t) {
  const DirectionList* l = t.list();
  if (!l) return false;
  constexpr std::size_t few = 8;  // values that may be alike by chance
  constexpr double alike = 1e-3, other = 1e-2;
  const SampleAngles at(t);
  const auto key_of = [](double theta_deg, double phi_deg) {
    return std::pair(std::lround(1000 * theta_deg), std::lround(1000 * phi_deg));
  };
  std::map<std::pair<long, long>, std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < t.size(); ++i) {
    groups[key_of(l->theta_i_deg[i], l->phi_i_deg[i])].push_back(i);
    if (groups.size() * few > t.size()) return false;
  }
  for (const auto& plane : t.values) {
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (const auto& [key, samples] : groups) {
      std::vector<double> values;
      for (const std::size_t i : samples)
        if (mask(at(i), plane[i]) == Mask::valid) values.push_back(plane[i]);
      if (values.size() < few) return false;
      const double middle = median(values);
      const auto same = std::ranges::count_if(
          values, [&](double v) { return std::abs(v - middle) <= alike * middle; });
      if (20 * same < 19 * std::ssize(values)) return false;
      std::set<std::pair<long, long>> directions;  // rows that repeat one say nothing
      for (const std::size_t i : samples)
        directions.insert(key_of(l->theta_o_deg[i], l->phi_o_deg[i]));
      if (directions.size() < few) return false;
      least = std::min(least, middle);
      most = std::max(most, middle);
    }
    if (!(most > least * (1 + other))) return false;
  }
  return !groups.empty();
}

}  // namespace gonio
