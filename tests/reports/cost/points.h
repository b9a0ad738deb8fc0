#pragma once
/// \file
/// Points for every picture of the cost report but those of forms.

#include <string_view>
#include <vector>

#include "reports/cost/cost.h"

namespace gonio::test {

inline std::vector<CostPoint> few_cost_points() {
  std::vector<CostPoint> points;
  for (const std::string_view picture : {"compensation", "split_sum", "fit"})
    points.push_back({picture, "series", "label", {2, 0.1}, 0.1, 0});
  for (const double ns : {3.0, 1.0, 2.0})
    points.push_back(
        {"quadrature", "one integral, roughness 0.5, mu 0.5", "1e-3", {ns, 0.1}, 1 / ns, 0});
  return points;
}

}  // namespace gonio::test
