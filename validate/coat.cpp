#include "validate/coat.h"

#include <algorithm>

#include "brdf/formula/coat.h"
#include "brdf/model/evaluate.h"
#include "geometry/half_difference.h"
#include "integrate/albedo/directional_albedo.h"
#include "integrate/rule/quadrature.h"

namespace gonio::validating {
namespace {

constexpr Goal coat_goal{1e-5, 200'000};

std::vector<std::vector<double>> albedos_of(const BoundModel& b, std::span<const double> mu) {
  std::vector<std::vector<double>> out;
  for (const auto& a : directional_albedo(b, mu, 0, coat_goal)) out.push_back(a.value);
  return out;
}

}  // namespace

Coated::Coated(const BoundModel& coated, Coating coating)
    : coat_(coated), below_(coated), coating_(coating) {
  coat_.model.diffuse.clear();
  below_.model.lobes.clear();
}

std::vector<std::vector<double>> Coated::albedos(std::span<const double> mu) const {
  auto out = albedos_of(coat_, mu);
  const auto below = albedos_of(below_, mu);
  if (coating_ == Coating::view) {
    for (std::size_t m = 0; m < mu.size(); ++m)
      for (std::size_t c = 0; c < out[m].size(); ++c)
        out[m][c] += left_by_view(out[m][c]) * below[m][c];
    return out;
  }
  // ∫ (1 − E(l)) f_below cos θ_l dω_l; rings of directions share E.
  constexpr int rings = 24, turns = 16;
  const auto nodes = cosine_hemisphere(rings, turns);
  std::vector<double> light;
  for (std::size_t i = 0; i < nodes.size(); i += turns) light.push_back(nodes[i].direction.z);
  const auto coat = albedos_of(coat_, light);
  for (std::size_t m = 0; m < mu.size(); ++m) {
    const Direction view = direction(std::acos(mu[m]), 0);
    std::vector<FrameAngles<double>> angles;
    for (const auto& n : nodes) angles.push_back(frame_angles({n.direction, view}));
    const auto f = evaluate(below_, angles);
    for (std::size_t c = 0; c < out[m].size(); ++c) {
      double sum = 0;
      for (std::size_t i = 0; i < nodes.size(); ++i)
        sum += nodes[i].weight * f[c][i] * left_by_view(coat[i / turns][c]);
      out[m][c] += left_by_view(out[m][c]) * sum;
    }
  }
  return out;
}

std::vector<double> Coated::left_below(double light, double view) const {
  const std::vector<double> at{light, view};
  const auto e = albedos_of(coat_, at);
  std::vector<double> left;
  for (std::size_t c = 0; c < e[1].size(); ++c)
    left.push_back(coating_ == Coating::both ? left_by_both(e[0][c], e[1][c])
                                             : left_by_view(e[1][c]));
  return left;
}

std::vector<std::vector<double>> Coated::values(
    const std::vector<FrameAngles<double>>& angles) const {
  auto f = evaluate(coat_, angles);
  const auto below = evaluate(below_, angles);
  const auto left = left_below(angles[0].nol, angles[0].nov);
  for (std::size_t c = 0; c < f.size(); ++c)
    for (std::size_t i = 0; i < f[c].size(); ++i) f[c][i] += left[c] * below[c][i];
  return f;
}

}  // namespace gonio::validating
