#include "integrate/light/irradiance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/sampling.h"
#include "integrate/rule/quadrature.h"

#include <tbb/parallel_for.h>

namespace gonio {
namespace {

constexpr double pi = std::numbers::pi;

void add(Rgb& to, double weight, const Rgb& c) {
  for (std::size_t k = 0; k < 3; ++k) to[k] += weight * c[k];
}

/// π²/N Σ L cos θ sin θ at θ = (i + offset) step, φ = (k + offset) step, of so many rows.
SampledIrradiance riemann(const Radiance& radiance,
                          const Direction& n,
                          std::size_t rows,
                          double offset) {
  const double step = pi / 2 / static_cast<double>(rows);
  const Frame surface(n);
  SampledIrradiance sum{{}, 4 * rows * rows};
  for (std::size_t k = 0; k < 4 * rows; ++k)
    for (std::size_t i = 0; i < rows; ++i) {
      const double theta = (static_cast<double>(i) + offset) * step;
      const Direction l = direction(theta, (static_cast<double>(k) + offset) * step);
      add(sum.value, l.z * std::sin(theta), radiance(surface.outside(l)));
    }
  for (double& v : sum.value) v *= pi * pi / static_cast<double>(sum.samples);
  return sum;
}

}  // namespace

Rgb irradiance(const Environment& map, const Direction& n) {
  struct Edge {  // between rows
    double theta, flat, steep;
    explicit Edge(double t)
        : theta(t),
          flat((t - std::sin(t) * std::cos(t)) / 2),
          steep(std::sin(t) * std::sin(t) / 2) {}
  };
  std::vector<Edge> edges;
  for (std::size_t j = 0; j <= map.height; ++j)
    edges.emplace_back(map.theta(static_cast<double>(j)));
  // where a column crosses the horizon, there is a kink: 1024 nodes around
  const auto nodes = gauss_legendre(static_cast<int>(std::max(1024 / map.width, std::size_t{4})));
  const double across = std::hypot(n.x, n.y), phi_n = phi_of(n),
               width = 2 * pi / static_cast<double>(map.width);
  Rgb sum{};
  for (std::size_t i = 0; i < map.width; ++i)
    for (const auto& node : nodes) {
      const double a = across * std::cos(map.phi(static_cast<double>(i) + node.x) - phi_n), b = n.z;
      const double horizon = std::atan2(std::abs(b), b < 0 ? a : -a);
      const Edge at(horizon);
      const auto until = [&](const Edge& e) {  // from the pole that n sees
        const bool beyond = b < 0 ? e.theta < horizon : e.theta > horizon;
        const Edge& f = beyond ? at : e;
        return a * f.flat + b * f.steep;
      };
      double before = until(edges[0]);
      for (std::size_t j = 0; j < map.height; ++j) {
        const double here = until(edges[j + 1]);
        add(sum, (here - before) * node.weight * width, map.texel(i, j));
        before = here;
      }
    }
  return sum;
}

SampledIrradiance sampled_irradiance(const Radiance& radiance,
                                     const Direction& n,
                                     IrradianceRule rule,
                                     std::size_t samples) {
  if (rule == IrradianceRule::cosine) {
    const Frame surface(n);
    SampledIrradiance sum{{}, samples};
    for (std::size_t i = 0; i < samples; ++i)
      add(sum.value, pi / static_cast<double>(samples),
          radiance(surface.outside(cosine_direction(
              hammersley(static_cast<std::uint32_t>(i), static_cast<double>(samples))))));
    return sum;
  }
  const auto rows = static_cast<std::size_t>(
      std::max(1.0, std::round(std::sqrt(static_cast<double>(samples) / 4))));
  return riemann(radiance, n, rows, rule == IrradianceRule::riemann ? 0 : 0.5);
}

std::vector<IrradianceError> irradiance_errors(const Radiance& radiance,
                                               const std::function<Rgb(const Direction&)>& exact,
                                               std::span<const std::size_t> counts,
                                               std::size_t normals) {
  std::vector<double> truth(normals);
  tbb::parallel_for(std::size_t{0}, normals, [&](std::size_t i) {
    truth[i] = luminance(exact(spiral_direction(i, normals)));
  });
  std::vector<IrradianceError> rows;
  using enum IrradianceRule;
  for (const auto rule : {riemann, riemann_midpoint, cosine})
    for (const std::size_t count : counts) {
      std::vector<double> off(normals);
      std::size_t taken = 0;
      tbb::parallel_for(std::size_t{0}, normals, [&](std::size_t i) {
        const auto s = sampled_irradiance(radiance, spiral_direction(i, normals), rule, count);
        off[i] = luminance(s.value) / truth[i] - 1;
        if (i == 0) taken = s.samples;
      });
      IrradianceError e{rule, taken};
      for (std::size_t i = 0; i < normals; ++i) {
        if (!(truth[i] > 0)) continue;
        e.rms += off[i] * off[i];
        e.bias += off[i];
        e.max = std::max(e.max, std::abs(off[i]));
        ++e.normals;
      }
      const auto n = static_cast<double>(e.normals);
      e.rms = std::sqrt(e.rms / n);
      e.bias /= n;
      if (e.normals == 0) e.max = std::numeric_limits<double>::quiet_NaN();
      rows.push_back(e);
    }
  return rows;
}

}  // namespace gonio
