#pragma once
/// \file
/// Walkers from facet to facet of Smith's microsurface, side by side: what walk.cpp and tabulated_lobe.cpp count.

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include "base/random.h"
#include "brdf/catalogue/foreign_terms.h"
#include "geometry/sampling.h"
#include "integrate/rule/slopes.h"
#include "integrate/scattering/microsurface.h"
#include "integrate/scattering/visible_facets.h"

namespace gonio::walking {

/// A factor of a walk's weight over a block, in the best instruction set: the product rule of a lobe
/// (brdf/term/product.h) with nothing below it.
class Term {
 public:
  Term(const BoundModel& m, const TermUse& t, std::size_t channel = 0)
      : add_(kernels<double>().terms[term_of_channel(t.term, channel)].add_product) {
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
  std::array<double, most_parameters> parameters_{};
};

/// A lobe as a surface with its terms.
struct Surface {
  Microsurface facets;
  Term ndf, masking;
  std::vector<Term> fresnel;  ///< by channel, or one for all
};

inline std::vector<Surface> surfaces_of(const BoundModel& m) {
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

inline std::size_t padded(std::size_t n) {
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
  double area(std::size_t i) const { return area_[i]; }    ///< σ(−w)
  double area_in() const { return area_in_[0]; }           ///< σ(v)
  double first(std::size_t i) const { return first_[i]; }  ///< D of the first facet; of even walks
  /// A walk's light gathered on its way, for whom it concerns.
  double gathered(std::size_t channel, std::size_t i) const { return gathered_[channel][i]; }
  void gather(std::size_t channel, std::size_t i, double x) { gathered_[channel][i] += x; }
  Scratch<double>& scratch() { return scratch_; }
  /// Λ of directions above the surface, at most `most`; before any of them has entered.
  void lambdas(std::span<const Direction> up, double* lambda) {
    for (std::size_t i = 0; i < up.size(); ++i) fly_[i] = {-up[i].x, -up[i].y, -up[i].z};
    measure_areas(fly_, up.size(), area_);
    for (std::size_t i = 0; i < up.size(); ++i) lambda[i] = area_[i] / up[i].z - 1;
  }

  /// From here on the first four numbers of each walk are a point of a lattice, shifted at random: depth, facet and depth again.
  void spread_evenly() {
    for (auto& x : shift_) x = draw_.uniform();
    even_ = true;
  }

  /// One more, at the first facet of its way.
  void enter() { enter(n_++); }

  /// Each is reflected by its facet and flies on.
  void reflect() {
    if (surface_.facets.slopes == Microsurface::Slopes::ggx)
      reflect(GgxFacets(surface_.facets.alpha_x, surface_.facets.alpha_y));
    else
      reflect(BeckmannFacets(surface_.facets.alpha_x, surface_.facets.alpha_y));
    const auto x = block(n_);
    if (even_) keep_first();
    for (std::size_t c = 0; c < channels(); ++c) {
      double* const weight = weight_[c].data();
      surface_.fresnel[c](x, scratch_, weight, weight);
    }
    measure_areas(fly_, n_, area_);
    for (std::size_t i = 0; i < n_; ++i) {
      depth_[i] -= path(i, even(i, 3));
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
          number_[i] = number_[n_];
          first_[i] = first_[n_];
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
    number_[i] = entered_++;
    bounces_[i] = 0;
    depth_[i] = -path(i, even(i, 0));
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
  double path(std::size_t i, double uniform) { return -std::log(uniform) * fly_[i].z / area_[i]; }

  /// A number in (0, 1] for the k-th use of a walk's first bounce; of later ones, drawn.
  double even(std::size_t i, std::size_t k) {
    if (!even_ || bounces_[i] > 0) return draw_.uniform();
    // powers of 1/x, x⁵ = x + 1                                     [Roberts 2018]
    static constexpr std::array<double, 4> step{0.8566748838545029, 0.7338918566271259,
                                                0.6287067210378086, 0.5385972572236101};
    const double x = shift_[k] + step[k] * static_cast<double>(number_[i]);
    return 1 - (x - std::floor(x));
  }

  template <class Facets>
  void reflect(const Facets& facets) {
    double* const voh = columns_[3];
    for (std::size_t i = 0; i < n_; ++i) {
      auto& w = fly_[i];
      const auto m = [&] {
        if constexpr (std::is_same_v<Facets, GgxFacets>)
          if (even_ && bounces_[i] == 0) return facets(w, area_[i], {even(i, 1), even(i, 2)});
        return facets(w, area_[i], draw_);
      }();
      const double along = -(w.x * m.x + w.y * m.y + w.z * m.z);
      const double per_length = 1 / std::sqrt(m.x * m.x + m.y * m.y + m.z * m.z);
      voh[i] = std::clamp(along * per_length, 0.0, 1.0);
      facet_[i] = {m.x * per_length, m.y * per_length, m.z * per_length};
      const double twice = 2 * along * per_length * per_length;
      w = {w.x + twice * m.x, w.y + twice * m.y, w.z + twice * m.z};
    }
  }

  /// D of the facets of those that met their first.
  void keep_first() {
    std::size_t n = 0;
    for (std::size_t i = 0; i < n_; ++i) {
      if (bounces_[i] > 0) continue;
      const auto& m = facet_[i];
      columns_[2][n] = m.z;
      columns_[4][n] = m.x * m.x + m.y * m.y;
      columns_[5][n] = m.x;
      columns_[6][n++] = m.y;
    }
    double* d = scratch_[Scratch<double>::first_free];
    surface_.ndf(block(n), scratch_, scratch_.ones(), d);
    for (std::size_t i = 0; i < n_; ++i)
      if (bounces_[i] == 0) first_[i] = *d++;
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
  std::array<Direction, most> fly_, in_, facet_;
  std::array<double, most> depth_, area_, area_in_, first_;
  std::array<std::size_t, most> bounces_, number_;
  bool even_ = false;
  std::size_t entered_ = 0;
  std::array<double, 4> shift_{};
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

}  // namespace gonio::walking
