#pragma once
/// \file
/// Materials of usual models, drawn at random.

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "brdf/model/model.h"

#include <fmt/format.h>

namespace gonio::test {

/// Parameters of a usual model, each somewhere in what materials have.
inline std::vector<std::string> material_of(const std::string& model, std::mt19937_64& random) {
  const auto between = [&](double a, double b) {
    return std::uniform_real_distribution(a, b)(random);
  };
  const auto by_ratio = [&](double a, double b) { return a * std::pow(b / a, between(0, 1)); };
  const bool two = compose(model, 1).lobes.size() > 1;
  std::vector<std::string> settings;
  for (const auto& p : compose(model, 1).parameters) {
    double v = between(p.about->fit.low, p.about->fit.high);
    if (p.name == "alpha") v = two ? by_ratio(0.03, 0.1) : by_ratio(0.04, 0.6);
    if (p.name == "alpha_2") v = by_ratio(0.25, 0.6);
    if (p.name == "alpha_x") v = between(0.2, 0.6);
    if (p.name == "alpha_y") v = between(0.04, 0.15);
    if (p.name == "gamma") v = between(0, 1) < 0.5 ? between(1.2, 1.7) : between(2.4, 4);
    if (p.name == "f0" || p.name == "f0_2")
      v = between(0.03, compose(model, 1).diffuse.empty() ? 0.95 : 0.3);
    if (p.name == "f90") v = between(0.2, 0.8);
    if (p.name == "weight" || p.name == "weight_2") v = between(0.2, 0.9);
    if (p.name == "kd") v = between(0.05, 0.6);
    if (p.name == "eta") v = between(1.3, 2.2);
    if (p.name == "k") v = between(1.5, 6);
    settings.push_back(fmt::format("{}={}", p.name, v));
  }
  return settings;
}

}  // namespace gonio::test
