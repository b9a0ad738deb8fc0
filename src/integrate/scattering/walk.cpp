#include "integrate/scattering/walk.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/error.h"
#include "base/random.h"
#include "base/whole_loop.h"
#include "brdf/catalogue/registry.h"
#include "geometry/sampling.h"
#include "integrate/albedo/directional_albedo.h"
#include "integrate/rule/slopes.h"
#include "integrate/scattering/microsurface.h"
#include "integrate/scattering/visible_facets.h"

#include <fmt/format.h>

namespace gonio {
namespace {

constexpr std::size_t chunk_walks = 1 << 14;

/// A factor of a walk's weight over a block, in the best instruction set: the product rule of a lobe
/// (brdf/term/product.h) with nothing below it.
class Term {
 public:
  Term(const BoundModel& m, const TermUse& t, std::size_t channel = 0)
      : add_(kernels<double>().terms[t.term].add_product) {
    std::ranges::copy(term_parameters(m, t, channel), parameters_.begin());
  }
  /// out = factor · term
  void operator()(const Block<double>& x,
                  Scratch<double>& s,
                  const double* factor,
                  double* out) const {
    add_(x, parameters_.data(), {factor, nullptr, s.zeros(), out, nullptr});
  }
  bool operator==(const Term&) const = default;

 private:
  TermKernels<double>::Value add_;
  std::array<double, max_parameters> parameters_{};
};

/// A lobe as a surface with its terms.
struct Surface {
  Microsurface facets;
  Term ndf, masking;
  std::vector<Term> fresnel;  ///< by channel, or one for all
};

std::vector<Surface> surfaces_of(const BoundModel& m) {
  const auto facets = microsurfaces(m);
  std::vector<Surface> all;
  for (std::size_t k = 0; k < facets.size(); ++k) {
    const auto& lobe = m.model.lobes[k];
    Surface s{facets[k], {m, lobe.ndf}, {m, lobe.masking}, {}};
    for (std::size_t c = 0; c < m.model.channels; ++c) s.fresnel.emplace_back(m, lobe.fresnel, c);
    if (std::ranges::all_of(s.fresnel, [&](const Term& t) { return t == s.fresnel[0]; }))
      s.fresnel.resize(1, s.fresnel[0]);
    all.push_back(std::move(s));
  }
  return all;
}

std::size_t padded(std::size_t n) {
  return (n + padding - 1) / padding * padding;
}

/// Walkers side by side, as columns.
class Walkers {
 public:
  static constexpr std::size_t most = Scratch<double>::block;
  /// A column of them, as kernels take it.
  struct alignas(64) Weights : std::array<double, most> {};

  /// They enter against v, a unit vector above the surface, or, without it, from all over the hemisphere
  /// as even light does.
  Walkers(const Surface& s, const std::optional<Direction>& v, Draws draws)
      : surface_(s),
        draw_(draws),
        from_everywhere_(!v),
        angles_(true),
        weight_(s.fresnel.size()),
        gathered_(s.fresnel.size()) {
    columns_ = angles_.resize(most);
    for (auto* const c : columns_) std::fill_n(c, most, 0.0);
    std::fill_n(columns_[1], most, 1.0);  // v of the masking is the normal
    std::fill_n(columns_[2], most, 1.0);
    if (!v) return;
    in_[0] = {-v->x, -v->y, -v->z};
    measure_areas(in_, 1, area_in_);
  }

  std::size_t size() const { return n_; }
  std::size_t channels() const { return weight_.size(); }
  double weight(std::size_t channel, std::size_t i) const { return weight_[channel][i]; }
  const double* weights(std::size_t channel) const { return weight_[channel].data(); }
  std::size_t bounces(std::size_t i) const { return bounces_[i]; }
  const Direction& flight(std::size_t i) const { return fly_[i]; }
  double depth(std::size_t i) const { return depth_[i]; }
  double area(std::size_t i) const { return area_[i]; }  ///< σ(−w)
  double area_in() const { return area_in_[0]; }         ///< σ(v)
  /// A walk's light gathered on its way, for whom it concerns.
  double gathered(std::size_t channel, std::size_t i) const { return gathered_[channel][i]; }
  void gather(std::size_t channel, std::size_t i, double x) { gathered_[channel][i] += x; }
  Scratch<double>& scratch() { return scratch_; }

  /// One more, at the first facet of its way.
  void enter() { enter(n_++); }

  /// Each is reflected by its facet and flies on.
  void reflect() {
    if (surface_.facets.slopes == Microsurface::Slopes::ggx)
      reflect(GgxFacets(surface_.facets.alpha_x, surface_.facets.alpha_y));
    else
      reflect(BeckmannFacets(surface_.facets.alpha_x, surface_.facets.alpha_y));
    const auto x = block(n_);
    for (std::size_t c = 0; c < channels(); ++c) {
      double* const weight = weight_[c].data();
      surface_.fresnel[c](x, scratch_, weight, weight);
    }
    measure_areas(fly_, n_, area_);
    for (std::size_t i = 0; i < n_; ++i) {
      depth_[i] -= path(i);
      ++bounces_[i];
    }
  }

  /// Those for whom `ends` is true are replaced by new ones while `left` is not 0.
  void replace(std::size_t& left, auto&& ends) {
    for (std::size_t i = n_; i-- > 0;)
      if (ends(i)) {
        if (left > 0) {
          --left;
          enter(i);
        } else {
          --n_;
          fly_[i] = fly_[n_];
          depth_[i] = depth_[n_];
          area_[i] = area_[n_];
          bounces_[i] = bounces_[n_];
          for (auto& w : weight_) w[i] = w[n_];
          for (auto& g : gathered_) g[i] = g[n_];
        }
      }
  }

 private:
  Block<double> block(std::size_t n) { return angles_.block().part(0, padded(n)); }

  void enter(std::size_t i) {
    const std::size_t k = next_in();
    fly_[i] = in_[k];
    area_[i] = area_in_[k];
    depth_[i] = 0;
    depth_[i] = -path(i);
    bounces_[i] = 0;
    for (auto& w : weight_) w[i] = 1;
    for (auto& g : gathered_) g[i] = 0;
  }

  /// Its place among those that wait to enter, which are drawn as many as fit at once.
  std::size_t next_in() {
    if (!from_everywhere_) return 0;
    if (waiting_ == 0) {
      for (auto& d : in_) {
        const auto v = cosine_direction({draw_.uniform(), 1 - draw_.uniform()});
        d = {-v.x, -v.y, -v.z};
      }
      measure_areas(in_, most, area_in_);
      waiting_ = most;
    }
    return --waiting_;
  }

  /// The flight to the next facet, as a change of τ towards the top.
  double path(std::size_t i) { return -std::log(draw_.uniform()) * fly_[i].z / area_[i]; }

  template <class Facets>
  void reflect(const Facets& facets) {
    double* const voh = columns_[3];
    for (std::size_t i = 0; i < n_; ++i) {
      auto& w = fly_[i];
      const auto m = facets(w, area_[i], draw_);
      const double along = -(w.x * m.x + w.y * m.y + w.z * m.z);
      const double per_length = 1 / std::sqrt(m.x * m.x + m.y * m.y + m.z * m.z);
      voh[i] = std::clamp(along * per_length, 0.0, 1.0);
      const double twice = 2 * along * per_length * per_length;
      w = {w.x + twice * m.x, w.y + twice * m.y, w.z + twice * m.z};
    }
  }

  /// σ(−w) of the first n.
  void measure_areas(std::span<const Direction> w, std::size_t n, std::span<double> area) {
    for (std::size_t i = 0; i < n; ++i) {
      columns_[0][i] = std::min(std::abs(w[i].z), 1.0);
      columns_[7][i] = w[i].x;
      columns_[8][i] = w[i].y;
    }
    double* const v = scratch_[Scratch<double>::first_free];
    surface_.masking(block(n), scratch_, scratch_.ones(), v);
    for (std::size_t i = 0; i < n; ++i)
      // upwards less what cancels where next to nothing is met
      area[i] = std::max(0.25 / v[i] - std::max(w[i].z, 0.0), 1e-30);
  }

  const Surface& surface_;
  Draws draw_;
  bool from_everywhere_;
  std::size_t n_ = 0, waiting_ = 0;
  Scratch<double> scratch_;
  AngleBlock angles_;
  std::span<double* const> columns_;
  std::array<Direction, most> fly_, in_;
  std::array<double, most> depth_, area_, area_in_;
  std::array<std::size_t, most> bounces_;
  std::vector<Weights> weight_;
  std::vector<std::array<double, most>> gathered_;
};

/// Sums over walks, by channel.
struct Tally {
  std::size_t walks = 0, bounces = 0;
  std::vector<double> sum, square, rest;                  // [channel]
  std::vector<std::vector<double>> order, order_squares;  // [channel][n − 1]

  explicit Tally(std::size_t channels)
      : sum(channels), square(channels), rest(channels), order(channels), order_squares(channels) {}

  void add(std::size_t c, double x) {
    sum[c] += x;
    square[c] += x * x;
  }
  void add_to_order(std::size_t c, std::size_t n, double x) {
    if (order[c].size() < n) {
      order[c].resize(n);
      order_squares[c].resize(n);
    }
    order[c][n - 1] += x;
    order_squares[c][n - 1] += x * x;
  }
  void add(const Tally& t) {
    walks += t.walks;
    bounces += t.bounces;
    for (std::size_t c = 0; c < sum.size(); ++c) {
      sum[c] += t.sum[c];
      square[c] += t.square[c];
      rest[c] += t.rest[c];
      add_elements(order[c], t.order[c]);
      add_elements(order_squares[c], t.order_squares[c]);
    }
  }
  double mean(double of_sum) const { return of_sum / static_cast<double>(walks); }
  /// Standard error of the mean, squared.
  double variance(double of_sum, double of_squares) const {
    const auto n = static_cast<double>(walks);
    return std::max(0.0, of_squares - of_sum * of_sum / n) / (n * std::max(n - 1, 1.0));
  }

 private:
  static void add_elements(std::vector<double>& to, const std::vector<double>& x) {
    to.resize(std::max(to.size(), x.size()));
    for (std::size_t k = 0; k < x.size(); ++k) to[k] += x[k];
  }
};

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

/// A chunk of walks; `count` sees the walkers at each facet and each walk's end.
template <class Count>
Tally walk_chunk(Walkers& w, Count& count, std::size_t walks, std::size_t most_bounces) {
  Tally t(w.channels());
  t.walks = walks;
  std::size_t left = walks;
  for (; left > 0 && w.size() < Walkers::most; --left) w.enter();
  while (w.size() > 0) {
    t.bounces += w.size();
    count.at_facets(w, t);
    w.reflect();
    w.replace(left, [&](std::size_t i) {
      const bool out = w.depth(i) < 0;
      if (!out && w.bounces(i) < most_bounces) return false;
      count.at_end(w, i, t);
      if (!out)
        for (std::size_t c = 0; c < w.channels(); ++c) t.rest[c] += w.weight(c, i);
      return true;
    });
  }
  return t;
}

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
