#include "table/health/directional_albedo.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "integrate/rule/quadrature.h"
#include "table/format/rgl/function.h"
#include "table/grid_cell.h"
#include "table/health/key_counts.h"

#include <tbb/parallel_for.h>

namespace gonio {
namespace {

/// Mean over the nodes where there is a value, times π; `value(node, channel)` is NaN elsewhere.
/// Less than half of the hemisphere says nothing about its mean: noisy dark channels keep their peak.
template <class Value>
AlbedoSample integrate(double theta_i_deg,
                       const std::vector<HemisphereNode>& nodes,
                       std::size_t channels,
                       Value value) {
  AlbedoSample a{theta_i_deg, {}, 1};
  for (std::size_t c = 0; c < channels; ++c) {
    double sum = 0, weight = 0;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const double v = value(k, c);
      if (!std::isfinite(v)) continue;
      sum += nodes[k].weight * v;
      weight += nodes[k].weight;
    }
    a.albedo.push_back(weight > std::numbers::pi / 2 ? sum / weight * std::numbers::pi
                                                     : std::nan(""));
    a.coverage = std::min(a.coverage, weight / std::numbers::pi);
  }
  return a;
}

/// The part of the sum that one sample makes, in the channel where that is most.
template <class Value>
double largest_share(const std::vector<HemisphereNode>& nodes,
                     const std::vector<std::size_t>& nearest,
                     std::size_t channels,
                     Value value) {
  double share = 0;
  for (std::size_t c = 0; c < channels; ++c) {
    std::map<std::size_t, double> parts;
    double sum = 0;
    for (std::size_t k = 0; k < nodes.size(); ++k)
      if (const double v = value(k, c); std::isfinite(v)) {
        parts[nearest[k]] += nodes[k].weight * v;
        sum += nodes[k].weight * v;
      }
    for (const auto& [sample, part] : parts) share = std::max(share, sum > 0 ? part / sum : 0);
  }
  return share;
}

std::vector<AlbedoSample> of_function(const Table& t, double step_deg) {
  std::vector<AlbedoSample> all(static_cast<std::size_t>(std::ceil(90 / step_deg)));
  tbb::parallel_for(std::size_t{0}, all.size(), [&](std::size_t k) {
    all[k] = directional_albedo(t, step_deg * static_cast<double>(k));
  });
  return all;
}

std::vector<AlbedoSample> samples_of_list(const Table& t) {
  constexpr double reach_deg = 12;
  const double reach = std::cos(reach_deg * degree);
  const auto fewest =
      static_cast<std::size_t>(1 / (1 - reach));  // caps of that size in a hemisphere
  const auto nodes = cosine_hemisphere(24, 48);
  const DirectionList& l = *t.list();
  const Hashes hashes = hashes_of(t.size(), [&](std::size_t i) -> AngleKey<2> {
    return {std::lround(l.theta_i_deg[i] * 1e6), std::lround(l.phi_i_deg[i] * 1e6)};
  });
  std::map<std::pair<double, double>, std::vector<std::size_t>> groups;
  for (const std::size_t i : KeyCounts(hashes).among(hashes, fewest))
    if (l.theta_i_deg[i] < 90 && l.theta_o_deg[i] < 90)
      groups[{l.theta_i_deg[i], l.phi_i_deg[i]}].push_back(i);
  const SampleAngles at(t);
  std::vector<AlbedoSample> all;
  for (const auto& [incident, group] : groups) {
    const auto& samples = group;  // clang 14 lets no lambda have a structured binding
    if (samples.size() < fewest) continue;
    // In the order of their cosines: a node looks at those no farther from it in zenith angle than
    // it may be at all.
    std::vector<std::pair<Direction, std::size_t>> by_height;
    for (const auto i : samples) by_height.emplace_back(at.directions(i).wo, i);
    const auto height = [](const auto& s) { return s.first.z; };
    std::ranges::stable_sort(by_height, {}, height);
    std::vector<std::size_t> nearest(nodes.size());
    std::vector<double> closeness(nodes.size(), -1);
    tbb::parallel_for(std::size_t{0}, nodes.size(), [&](std::size_t k) {
      const double zenith = theta_of(nodes[k].direction), margin = reach_deg * degree + 1e-6;
      const double highest = zenith < margin ? 1.0 : std::cos(zenith - margin);
      auto s = std::ranges::lower_bound(by_height, std::cos(zenith + margin), {}, height);
      for (; s != by_height.end() && s->first.z <= highest; ++s)
        if (const double c = dot(s->first, nodes[k].direction);
            c > closeness[k] || (c == closeness[k] && s->second < nearest[k])) {
          closeness[k] = c;
          nearest[k] = s->second;
        }
    });
    double within = 0;
    for (std::size_t k = 0; k < nodes.size(); ++k)
      if (closeness[k] >= reach) within += nodes[k].weight;
    if (within < 0.95 * std::numbers::pi) continue;
    const auto value = [&](std::size_t k, std::size_t c) {
      if (closeness[k] < reach) return std::nan("");
      const std::size_t i = nearest[k];
      const double v = t.values[c][i];
      return mask(at(i), v) == Mask::valid ? v : std::nan("");
    };
    if (largest_share(nodes, nearest, t.channels.size(), value) <= 0.1)
      all.push_back(integrate(incident.first, nodes, t.channels.size(), value));
  }
  return all;
}

}  // namespace

AlbedoSample directional_albedo(const Table& t, double theta_i_deg) {
  const auto nodes = cosine_hemisphere(48, 96);
  const Direction wi = direction(theta_i_deg * degree, 0);
  if (t.grid()) {
    const SampleAngles at(t);
    std::vector<GridCell> cells;
    for (const auto& node : nodes) cells.push_back(cell_around(t, at, {wi, node.direction}));
    return integrate(theta_i_deg, nodes, t.channels.size(), [&](std::size_t node, std::size_t c) {
      return cells[node].mean_of(t.values[c]);
    });
  }
  const Interpolator between(t);
  // The cosine of the integral takes back what RGL divides by.
  const RglFunction rgl = rgl_function(t);
  return integrate(theta_i_deg, nodes, t.channels.size(), [&](std::size_t node, std::size_t c) {
    const DirectionPair p{wi, nodes[node].direction};
    return rgl ? rgl(p, c) : between(p, c);
  });
}

std::vector<AlbedoSample> albedo_curve(const Table& t, double step_deg) {
  if (t.between) return of_function(t, step_deg);
  if (t.list()) return samples_of_list(t);
  const bool slice = std::ranges::any_of(
      t.grid()->axes, [](const Axis& a) { return a.spacing == Axis::Spacing::constant; });
  return slice ? std::vector<AlbedoSample>{} : of_function(t, step_deg);
}

std::vector<AlbedoSample> directional_albedo(const Table& t) {
  return albedo_curve(t, 15);
}

}  // namespace gonio
