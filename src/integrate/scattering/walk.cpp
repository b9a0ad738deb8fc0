#include "integrate/scattering/walk.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/error.h"
#include "base/whole_loop.h"
#include "integrate/albedo/directional_albedo.h"
#include "integrate/scattering/walkers.h"

#include <fmt/format.h>

namespace gonio {
namespace {

using namespace walking;

constexpr std::size_t chunk_walks = 1 << 14;

/// Counts what leaves.
struct Leaving {
  void at_facets(Walkers&, Tally&) {}
  void at_end(const Walkers& w, std::size_t i, Tally& t) const {
    if (w.depth(i) < 0)
      for (std::size_t c = 0; c < w.channels(); ++c) {
        t.add(c, w.weight(c, i));
        t.add_to_order(c, w.bounces(i), w.weight(c, i));
      }
  }
};

/// Gathers what goes along one direction, over its cosine.
class Towards {
 public:
  Towards(const Surface& s, const Direction& l)
      : surface_(s), l_(l), lambda_(Walkers(s, l, Draws(0)).area_in() / l.z - 1), angles_(true) {
    columns_ = angles_.resize(Walkers::most);
    for (auto* const c : columns_) std::fill_n(c, Walkers::most, 0.5);
  }

  void at_facets(Walkers& w, Tally& t) {
    for (std::size_t i = 0; i < w.size(); ++i) {
      const auto& d = w.flight(i);
      const double x = l_.x - d.x, y = l_.y - d.y, z = l_.z - d.z;
      const double length2 = std::max(x * x + y * y + z * z, 1e-30), length = std::sqrt(length2);
      const bool faces_up = z > 0;
      columns_[2][i] = faces_up ? z / length : 1;
      columns_[3][i] = std::min(length / 2, 1.0);
      columns_[4][i] = faces_up ? (x * x + y * y) / length2 : 0;
      columns_[5][i] = x / length;
      columns_[6][i] = y / length;
      share_[i] = faces_up ? std::exp(-w.depth(i) * lambda_) / (4 * w.area(i) * l_.z) : 0;
    }
    const auto block = angles_.block().part(0, padded(w.size()));
    double* const value = w.scratch()[Scratch<double>::first_free];
    surface_.ndf(block, w.scratch(), share_.data(), share_.data());
    for (std::size_t c = 0; c < w.channels(); ++c) {
      surface_.fresnel[c](block, w.scratch(), w.weights(c), value);
      for (std::size_t i = 0; i < w.size(); ++i) {
        const double x = value[i] * share_[i];
        w.gather(c, i, x);
        t.add_to_order(c, w.bounces(i) + 1, x);
      }
    }
  }
  void at_end(const Walkers& w, std::size_t i, Tally& t) const {
    for (std::size_t c = 0; c < w.channels(); ++c) t.add(c, w.gathered(c, i));
  }

 private:
  const Surface& surface_;
  Direction l_;
  double lambda_;
  AngleBlock angles_;
  std::span<double* const> columns_;
  Walkers::Weights share_{};
};

/// Chunks [first, last) of all walks, in parallel, added to `t` in their order; few at a time, for walks may
/// be so many that the chunks' sums would fill the memory.
template <class MakeCount>
void walk_chunks(const Surface& s,
                 const std::optional<Direction>& v,
                 const MakeCount& make_count,
                 std::size_t first,
                 std::size_t last,
                 const WalkGoal& goal,
                 const std::array<std::size_t, 2>& key,
                 Tally& t) {
  constexpr std::size_t at_once = 1024;
  for (; first < last; first += at_once) {
    const std::size_t n = std::min(at_once, last - first);
    std::vector<Tally> chunks(n, Tally(s.fresnel.size()));
    for_each_whole(n, [&](std::size_t i) {
      const std::size_t k = first + i;
      Walkers w(s, v, Draws(goal.seed, key[0], key[1], k));
      auto count = make_count();
      const std::size_t walks = std::min(chunk_walks, goal.walks - k * chunk_walks);
      chunks[i] = walk_chunk(w, count, walks, goal.bounces);
    });
    for (const auto& c : chunks) t.add(c);
  }
}

std::size_t chunks_of(std::size_t walks) {
  return (walks + chunk_walks - 1) / chunk_walks;
}

/// Until all walks are done or the error is.
Tally walk_until(const Surface& s,
                 const std::optional<Direction>& v,
                 const WalkGoal& goal,
                 const std::array<std::size_t, 2>& key) {
  Tally t(s.fresnel.size());
  // A first guess of the variance, and then as many as it says, a tenth more.
  const auto all = static_cast<double>(goal.walks);
  double wanted = goal.error > 0 ? std::min(all, 4.0 * chunk_walks) : all;
  for (std::size_t done = 0;;) {
    const std::size_t next = chunks_of(static_cast<std::size_t>(wanted));
    walk_chunks(
        s, v, [] { return Leaving{}; }, done, next, goal, key, t);
    done = next;
    double worst = 0;
    for (std::size_t c = 0; c < t.sum.size(); ++c)
      worst = std::max(worst, t.variance(t.sum[c], t.square[c]));
    const double target = goal.error * goal.error;
    if (worst <= target || t.walks == goal.walks) break;
    wanted = std::min(all, 1.1 * static_cast<double>(t.walks) * worst / target);
  }
  return t;
}

void check(const WalkGoal& goal) {
  if (goal.walks < 2 || goal.bounces < 1)
    throw wrong_usage(
        fmt::format("{} walks of {} bounces at most: 2 walks and 1 bounce are the fewest",
                    goal.walks, goal.bounces));
}

void check(const Direction& d) {
  if (!(d.z > 0 && std::abs(dot(d, d) - 1) < 1e-9))
    throw wrong_usage(
        fmt::format("({}, {}, {}) is no unit vector above the surface", d.x, d.y, d.z));
}

/// Means and their variances, added over lobes.
struct Means {
  std::vector<double> value, variance, rest;               // [channel]
  std::vector<std::vector<double>> order, order_variance;  // [channel][n − 1]
  std::size_t bounces = 0;

  explicit Means(std::size_t channels)
      : value(channels),
        variance(channels),
        rest(channels),
        order(channels),
        order_variance(channels) {}

  void add(const Tally& t) {
    bounces += t.bounces;
    for (std::size_t c = 0; c < value.size(); ++c) {
      const std::size_t k = t.sum.size() > 1 ? c : 0;
      value[c] += t.mean(t.sum[k]);
      variance[c] += t.variance(t.sum[k], t.square[k]);
      rest[c] += t.mean(t.rest[k]);
      const auto& sums = t.order[k];
      order[c].resize(std::max(order[c].size(), sums.size()));
      order_variance[c].resize(order[c].size());
      for (std::size_t n = 0; n < sums.size(); ++n) {
        order[c][n] += t.mean(sums[n]);
        order_variance[c][n] += t.variance(sums[n], t.order_squares[k][n]);
      }
    }
  }
};

std::vector<double> roots(std::vector<double> x) {
  for (double& v : x) v = std::sqrt(v);
  return x;
}
std::vector<std::vector<double>> roots(std::vector<std::vector<double>> x) {
  for (auto& v : x) v = roots(std::move(v));
  return x;
}

Scattered scattered(const Means& m) {
  return {m.value, roots(m.variance), m.order, m.rest, roots(m.order_variance), m.bounces};
}

}  // namespace

std::vector<Scattered> walk(const BoundModel& m,
                            std::span<const double> mu,
                            double phi,
                            const WalkGoal& goal) {
  check(goal);
  check_cosines(mu);
  check_azimuth(phi);
  const auto surfaces = surfaces_of(m);
  std::vector<Scattered> all(mu.size());
  for_each_whole(mu.size(), [&](std::size_t i) {
    const double sine = std::sqrt((1 - mu[i]) * (1 + mu[i]));
    const Direction v{sine * std::cos(phi), sine * std::sin(phi), mu[i]};
    Means means(m.model.channels);
    for (std::size_t lobe = 0; lobe < surfaces.size(); ++lobe)
      means.add(walk_until(surfaces[lobe], v, goal, {lobe, i}));
    all[i] = scattered(means);
  });
  return all;
}

Scattered walk_average(const BoundModel& m, const WalkGoal& goal) {
  check(goal);
  const auto surfaces = surfaces_of(m);
  Means means(m.model.channels);
  for (std::size_t lobe = 0; lobe < surfaces.size(); ++lobe)
    means.add(walk_until(surfaces[lobe], std::nullopt, goal, {lobe, 0}));
  return scattered(means);
}

WalkValue walk_value(const BoundModel& m,
                     const Direction& l,
                     const Direction& v,
                     const WalkGoal& goal) {
  check(goal);
  for (const auto& d : {l, v}) check(d);
  const auto surfaces = surfaces_of(m);
  Means means(m.model.channels);
  for (std::size_t lobe = 0; lobe < surfaces.size(); ++lobe) {
    Tally t(surfaces[lobe].fresnel.size());
    walk_chunks(
        surfaces[lobe], v, [&] { return Towards(surfaces[lobe], l); }, 0, chunks_of(goal.walks),
        goal, {lobe, 0}, t);
    means.add(t);
  }
  return {means.value, roots(means.variance), means.order, roots(means.order_variance), means.rest};
}

}  // namespace gonio
