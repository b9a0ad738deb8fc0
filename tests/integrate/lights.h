#pragma once
/// \file
/// Environments whose integrals are known.

#include <random>

#include "image/environment.h"

namespace gonio::test {

/// L = 1 + d·ω at texel centres, in red; 1 in green; 1 − d·ω in blue.
inline Environment gradient(std::size_t height, const Direction& d) {
  Environment e{2 * height, height, {}};
  for (std::size_t j = 0; j < height; ++j)
    for (std::size_t i = 0; i < e.width; ++i) {
      const double x = dot(
          d, direction(e.theta(static_cast<double>(j) + 0.5), e.phi(static_cast<double>(i) + 0.5)));
      e.radiance.push_back({static_cast<float>(1 + x), 1, static_cast<float>(1 - x)});
    }
  return e;
}

/// Texels of any brightness, and a sun.
inline Environment random_texels(std::size_t height, unsigned seed) {
  Environment e{2 * height, height, {}};
  std::mt19937 random(seed);
  for (std::size_t k = 0; k < 2 * height * height; ++k)
    for (auto& v : e.radiance.emplace_back()) v = static_cast<float>(random() % 1000) / 500;
  e.radiance[e.radiance.size() / 3] = {1000, 900, 800};
  return e;
}

}  // namespace gonio::test
