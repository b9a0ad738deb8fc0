#include "integrate/rule/quadrature.h"

#include <cmath>
#include <numbers>

namespace gonio {

std::vector<Node> gauss_legendre(int n) {
  std::vector<Node> nodes(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) {
    // Newton on P_n from the Chebyshev guess; P_n by its three-term recurrence.
    double x = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5)), slope = 1;
    for (int step = 0; step < 100; ++step) {
      double p = 1, before = 0;
      for (int k = 1; k <= n; ++k) {
        const double next = ((2 * k - 1) * x * p - (k - 1) * before) / k;
        before = p;
        p = next;
      }
      slope = n * (x * p - before) / (x * x - 1);
      const double dx = p / slope;
      x -= dx;
      if (std::abs(dx) < 1e-15) break;
    }
    nodes[static_cast<std::size_t>(n - 1 - i)] = {(1 + x) / 2, 1 / ((1 - x * x) * slope * slope)};
  }
  return nodes;
}

std::vector<HemisphereNode> cosine_hemisphere(int n_theta, int n_phi) {
  std::vector<HemisphereNode> nodes;
  const double step = 2 * std::numbers::pi / n_phi;
  for (const auto& u : gauss_legendre(n_theta)) {  // u = cos²θ: cos θ dω = dφ du / 2
    const double c = std::sqrt(u.x), s = std::sqrt(1 - u.x);
    for (int k = 0; k < n_phi; ++k) {
      const double phi = (k + 0.5) * step;
      nodes.push_back({{s * std::cos(phi), s * std::sin(phi), c}, u.weight * step / 2});
    }
  }
  return nodes;
}

}  // namespace gonio
