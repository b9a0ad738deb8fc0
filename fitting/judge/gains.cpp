#include "fitting/judge/gains.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gonio::misfit {
namespace {

/// Number of parts into which values fall that share a group of either axis.
std::size_t parts_of(const std::vector<std::size_t>& a,
                     const std::vector<std::size_t>& b,
                     std::size_t groups_of_a,
                     std::size_t groups_of_b,
                     const std::vector<Value>& values) {
  std::vector<std::size_t> parent(groups_of_a + groups_of_b);
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t k) {
    while (parent[k] != k) k = parent[k] = parent[parent[k]];
    return k;
  };
  std::vector<bool> met(parent.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    if (values[i].active > 0 && values[i].change != 0) {
      met[a[i]] = met[groups_of_a + b[i]] = true;
      parent[root(a[i])] = root(groups_of_a + b[i]);
    }
  std::size_t parts = 0;
  for (std::size_t k = 0; k < parent.size(); ++k) parts += met[k] && root(k) == k;
  return parts;
}

}  // namespace

Gains::Gains(const Left& left, const std::vector<SharedAngle>& axes) : left_(left) {
  const std::size_t channels = left.unknowns.size();
  for (const SharedAngle axis : axes) {
    auto& of = of_axis_.emplace_back();
    const auto a = static_cast<std::size_t>(axis);
    of.weight.resize(left.angles[a] * channels);
    for (const auto& v : left.values) {
      of.group.push_back(left.units[v.unit].angle[a] * channels + v.channel);
      of.weight[of.group.back()] += v.active * v.change * v.change;
    }
    count_ +=
        static_cast<std::size_t>(std::ranges::count_if(of.weight, [](double w) { return w > 0; }));
  }
  for (std::size_t k = 1; k < of_axis_.size(); ++k)
    count_ -= parts_of(of_axis_[k - 1].group, of_axis_[k].group, of_axis_[k - 1].weight.size(),
                       of_axis_[k].weight.size(), left.values);
}

std::vector<double> Gains::taken_up(const std::vector<double>& scores,
                                    std::vector<std::vector<double>>* factors) const {
  std::vector<double> all(scores.size()), mean;
  constexpr int most_rounds = 50;
  constexpr double settled = 1e-10;  // of the squares
  double whole = 0;
  if (factors) {
    factors->clear();
    for (const auto& of : of_axis_) factors->emplace_back(of.weight.size());
  }
  for (int round = 0; round < (of_axis_.size() > 1 ? most_rounds : 1); ++round) {
    double moved = 0;
    for (std::size_t a = 0; a < of_axis_.size(); ++a) {
      const auto& of = of_axis_[a];
      mean.assign(of.weight.size(), 0);
      for (std::size_t i = 0; i < all.size(); ++i) {
        const auto& v = left_.values[i];
        mean[of.group[i]] += v.change * (scores[i] - v.active * all[i]);
      }
      for (std::size_t g = 0; g < mean.size(); ++g) {
        if (of.weight[g] > 0) mean[g] /= of.weight[g];
        moved += of.weight[g] * mean[g] * mean[g];
        if (factors) (*factors)[a][g] += mean[g];
      }
      for (std::size_t i = 0; i < all.size(); ++i)
        all[i] += left_.values[i].change * mean[of.group[i]];
    }
    whole += moved;
    if (moved <= settled * whole) break;
  }
  return all;
}

}  // namespace gonio::misfit
