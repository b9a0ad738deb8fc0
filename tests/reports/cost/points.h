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

/// Points on which the findings have something to say.
inline std::vector<CostPoint> told_cost_points() {
  std::vector<CostPoint> points;
  for (const char* label : {"single", "turquin", "kulla_conty"})
    points.push_back(
        {"compensation", "a light", label, {9.53, 0.21}, 0.0123, 0, 20, 2048, {2.1, 0.1}});
  points.push_back({"compensation",
                    "image-based light",
                    "fdez_aguera",
                    {9.53, 0.21},
                    0.0123,
                    0,
                    20,
                    0,
                    {2.1, 0.1}});
  points.push_back(
      {"quadrature", "one integral, roughness 0.5, mu 0.5", "1e-7", {2345, 12}, 1e-8, 0});
  points.push_back({"quadrature",
                    "random visible normals, roughness 0.5, mu 0.5",
                    "16384",
                    {812345, 1234},
                    0.00123,
                    0});
  points.push_back({"fit", "the whole table", "all 1458000 bins", {3.4e8, 1e6}, 0.00034, 1e-5});
  points.push_back({"fit", "bins chosen by chance", "256 bins", {5.4e6, 1e5}, 0.034, 0.01});
  return points;
}

}  // namespace gonio::test
