// Compiled once per instruction set (GONIO_ARCH): steps towards the optimum, each texel in a lane
// of its own.
#include <algorithm>
#include <cstring>
#include <utility>

#include "brdf/kernel/lane.h"
#include "brdf/kernel/residual.h"
#include "fitting/lanes/worth.h"
#include "geometry/half_vector.h"

namespace gonio::inline GONIO_ARCH {
namespace {

using B = Lane<float>;

/// Rows of `padding` numbers, of which a register takes the first.
class Rows {
 public:
  Rows(float* at) : at_(at) {}  // NOLINT: an array of rows is that
  B operator[](std::size_t row) const { return load<B>(at_ + row * padding); }
  void put(std::size_t row, const B& x) const { store<B>(at_ + row * padding, x); }
  void add(std::size_t row, const B& x) const { put(row, (*this)[row] + x); }
  Rows from(std::size_t row) const { return at_ + row * padding; }

 private:
  float* at_;
};
constexpr std::size_t entry(std::size_t row, std::size_t column) {
  return row * (row + 1) / 2 + column;
}
constexpr std::size_t entries(std::size_t n) {
  return n * (n + 1) / 2;
}

/// x moved by a step: by a ratio e^step to its fourth digit, or by a difference.
B moved(const B& x, const B& step, bool by_ratio) {
  if (!by_ratio) return x + step;
  const B even = 12 + step * step, odd = step * 6;
  return x * (even + odd) / (even - odd);
}
/// The step from x to y, about.
B step_to(const B& x, const B& y, bool by_ratio) {
  return by_ratio ? 2 * (y - x) / (y + x) : y - x;
}

/// True in some lane.
bool any(const B& x) {
  alignas(64) std::array<float, lanes<B>> all;
  store<B>(all.data(), x);
  return std::ranges::any_of(all, [](float v) { return v != 0; });
}
B as_number(const mask_t<B>& m) {
  return select<B>(m, B(1), B(0));
}

/// JᵀJ, Jᵀr by the first n unknowns and the cost from the channels' sums, by steps from x.
B gather(const TexelUnknowns& u,
         std::size_t n,
         const UnknownOf& of,
         const float* const* sums,
         const Rows& x,
         const Rows& h,
         const Rows& g) {
  for (std::size_t e = 0; e < entries(n); ++e) h.put(e, B(0));
  for (std::size_t i = 0; i < n; ++i) g.put(i, B(0));
  B cost(0);
  for (std::size_t c = 0; c < of.size(); ++c) {
    const std::size_t k = of[c].size();
    const auto at = [&](std::size_t e) { return load<B>(sums[c] + e * padding); };
    cost = cost + at(0);
    std::size_t e = k + 1;
    for (std::size_t a = 0; a < k; ++a) {
      const std::size_t i = of[c][a];
      if (i < n) g.add(i, at(1 + a));
      for (std::size_t b = a; b < k; ++b, ++e) {
        const std::size_t j = of[c][b];
        if (i >= n || j >= n) continue;
        const B x2 = at(e);
        h.add(entry(std::max(i, j), std::min(i, j)), i == j && a != b ? x2 + x2 : x2);
      }
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (!u.by_ratio[i]) continue;
    const B s = x[i];
    g.put(i, s * g[i]);
    for (std::size_t j = u.first[i]; j <= i; ++j) h.put(entry(i, j), s * h[entry(i, j)]);
    for (std::size_t j = i; j < n; ++j)
      if (u.first[j] <= i) h.put(entry(j, i), s * h[entry(j, i)]);
  }
  return cost / 2;
}

/// The root of a matrix of the first n unknowns, L D Lᵀ within its profile; 1/D.  A pivot that is rounding of what it was counts as that
/// part of it.
void factorise(const TexelUnknowns& u, std::size_t n, const Rows& m, const Rows& per_pivot) {
  const B least = constant<B>(2e-7L), tiny = constant<B>(1e-35L);
  for (std::size_t i = 0; i < n; ++i) {
    const B whole = m[entry(i, i)];
    B pivot = whole;
    for (std::size_t j = u.first[i]; j < i; ++j) {
      B l = m[entry(i, j)];
      for (std::size_t k = std::max(u.first[i], u.first[j]); k < j; ++k)
        l = l - m[entry(i, k)] * m[entry(j, k)];  // the row holds L D so far
      m.put(entry(i, j), l);
    }
    for (std::size_t j = u.first[i]; j < i; ++j) {
      const B ld = m[entry(i, j)], l = ld * per_pivot[j];
      pivot = pivot - ld * l;
      m.put(entry(i, j), l);
    }
    per_pivot.put(i, B(1) / max<B>(max<B>(pivot, least * whole), tiny));
  }
}
/// Solves it for a right side, in place.
void solve(
    const TexelUnknowns& u, std::size_t n, const Rows& l, const Rows& per_pivot, const Rows& x) {
  for (std::size_t i = 0; i < n; ++i) {
    B sum = x[i];
    for (std::size_t j = u.first[i]; j < i; ++j) sum = sum - l[entry(i, j)] * x[j];
    x.put(i, sum);
  }
  for (std::size_t i = n; i-- > 0;) {
    const B xi = x[i] * per_pivot[i];
    x.put(i, xi);
  }
  for (std::size_t i = n; i-- > 0;) {
    const B xi = x[i];
    for (std::size_t j = u.first[i]; j < i; ++j) x.put(j, x[j] - l[entry(i, j)] * xi);
  }
}

/// Step of the first n unknowns from x inside the bounds, and where it leads: those that meet a bound, or the furthest that a ratio may
/// change by, stay there and the rest is solved for anew.  Damped is what f is not linear in.
/// \return what it promises of the cost
B step_inside(const TexelUnknowns& u,
              std::size_t n,
              const Rows& x,
              const Rows& h,
              const Rows& g,
              const B& damping,
              std::size_t rounds,
              const Rows& to,
              const Rows& scratch) {
  const Rows m = scratch, free = scratch.from(entries(n)), step = free.from(n),
             per_pivot = step.from(n);
  const B zero(0), one(1);
  const auto bound = [&](std::size_t i, float b) {
    const B step_there = step_to(x[i], B(b), u.by_ratio[i]);
    const B furthest(u.furthest[i]);
    return min<B>(max<B>(step_there, -furthest), furthest);
  };
  for (std::size_t i = 0; i < n; ++i) {
    const auto outwards =
        (!(B(u.low[i]) < x[i]) && !(g[i] < zero)) || (!(x[i] < B(u.high[i])) && !(zero < g[i]));
    const auto moves = !outwards && zero < h[entry(i, i)];
    free.put(i, as_number(moves));
    step.put(i, zero);
  }
  for (std::size_t round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < n; ++i) {
      const B fi = free[i];
      for (std::size_t j = u.first[i]; j < i; ++j)
        m.put(entry(i, j), h[entry(i, j)] * (fi * free[j]));
      const B damped = i < u.linear ? h[entry(i, i)] : h[entry(i, i)] * (one + damping);
      m.put(entry(i, i), fi * damped + (one - fi));
    }
    factorise(u, n, m, per_pivot);
    // What is held has moved already: −g − H step of the held.
    const Rows side = per_pivot.from(n);
    for (std::size_t i = 0; i < n; ++i) side.put(i, -g[i]);
    if (round > 0)
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = u.first[i]; j <= i; ++j) {
          const B hij = h[entry(i, j)];
          side.put(i, side[i] - hij * step[j] * (one - free[j]));
          if (j < i) side.put(j, side[j] - hij * step[i] * (one - free[i]));
        }
    for (std::size_t i = 0; i < n; ++i) side.put(i, side[i] * free[i]);
    solve(u, n, m, per_pivot, side);
    B met = zero;
    for (std::size_t i = 0; i < n; ++i) {
      const auto moves = zero < free[i];
      const B low = bound(i, u.low[i]), high = bound(i, u.high[i]), s = side[i];
      const B inside = min<B>(max<B>(s, low), high);
      const auto stays = inside < s || s < inside;
      step.put(i, select<B>(moves, inside, step[i]));
      const B left = select<B>(moves && stays, zero, free[i]);
      met = met + (free[i] - left);
      free.put(i, left);
    }
    if (!any(met)) break;
  }
  B promise = zero;
  for (std::size_t i = 0; i < n; ++i) {
    const B s = step[i];
    B along = h[entry(i, i)] * s / 2 + g[i];
    for (std::size_t j = u.first[i]; j < i; ++j) along = along + h[entry(i, j)] * step[j];
    promise = promise - s * along;
    const B there = moved(x[i], s, u.by_ratio[i]);
    to.put(i, min<B>(max<B>(there, B(u.low[i])), B(u.high[i])));
  }
  return promise;
}

/// Levenberg and Marquardt's steps: x is the lowest point seen.  So close to the optimum that rounding hides what a step does to the
/// cost, steps are taken for their gradient's sake, as long as each promises less than the last.
bool descend(const TexelUnknowns& u,
             const UnknownOf& of,
             const float* const* sums,
             TexelState& state) {
  const std::size_t n = u.count;
  const Rows x(state.x), tried(state.tried), h(state.h), g(state.g), scratch(state.scratch);
  const Rows new_h = scratch, new_g = scratch.from(entries(n)), lowest = new_g.from(n),
             room = lowest.from(n);
  const Rows cost(state.cost), damping(state.damping), promise(state.promise), done(state.done),
      gain(state.gain);
  const B zero(0), one(1), infinite = constant<B>(std::numeric_limits<float>::infinity());
  const B rounding = B(u.rounding) * Rows(state.signal)[0];

  // Points are compared by the cost where all in which f is linear is at its best: a step of the
  // others leads away from that.
  const B here = gather(u, n, of, sums, tried, new_h, new_g);
  for (std::size_t i = u.linear; i < n; ++i) lowest.put(i, tried[i]);
  const B new_gain = step_inside(u, u.linear, tried, new_h, new_g, zero, 3, lowest, room);
  const B now = here - new_gain;
  const auto moving = !(zero < done[0]), begins = !(cost[0] < infinite);
  const auto finite = now < infinite;  // false of NaN
  const B old = cost[0], promised = promise[0];
  // Rounding of the cost: residuals r are differences of values f, 2 r 6e-8 f summed.
  const B signal = Rows(state.signal)[0], finite_old = select<B>(begins, zero, old);
  const B gained = gain[0], of_gain = constant<B>(5e-7L) * gained;
  const B noise = constant<B>(5e-7L) * sqrt(finite_old * signal) + of_gain;
  const auto hidden = promised < constant<B>(1e-6L) * old + 16 * rounding + noise;
  const auto lower =
      now < old + of_gain || (hidden && now < old * constant<B>(1 + 1e-4L) + 64 * rounding);
  const auto takes = moving && finite && (begins || lower);
  for (std::size_t i = 0; i < n; ++i) {
    x.put(i, select<B>(takes, tried[i], x[i]));
    g.put(i, select<B>(takes, new_g[i], g[i]));
    for (std::size_t j = u.first[i]; j <= i; ++j)
      h.put(entry(i, j), select<B>(takes, new_h[entry(i, j)], h[entry(i, j)]));
  }
  cost.put(0, select<B>(takes, now, old));
  // Damping falls where a step keeps what it promised, from 1e-3 to none at once.  Where an
  // undamped step failed a second time the floor is a curved valley, which ends such jumps short of
  // its lowest point: from then on damping falls from 1e-4 by tenths.
  const B before = damping[0];
  const B kept = old - now;
  gain.put(0, select<B>(takes, new_gain, gained));
  const auto good = takes && !begins && !(kept < promised / 2);
  const B none_again = constant<B>(1e-12L);
  const auto undamped = before < constant<B>(1e-8L);
  const auto falls_to_none = before < constant<B>(1.5e-6L) ||
                             (constant<B>(5e-4L) < before && before < constant<B>(1.5e-3L));
  const B less = select<B>(zero < before, select<B>(falls_to_none, none_again, before / 10), zero);
  const B again = select<B>(zero < before, constant<B>(1e-4L), constant<B>(1e-2L));
  const B more = select<B>(undamped, again, before * 10);
  const B next = select<B>(takes, select<B>(good || hidden, less, before), more);
  damping.put(0, select<B>(moving, select<B>(begins, before, next), before));

  const Rows to = room, inner = room.from(n);
  const B all = step_inside(u, n, x, h, g, damping[0], 3, to, inner);
  const B will = max<B>(all - gain[0], zero);
  const B best = cost[0];
  // A step cut at the furthest leads elsewhere than its promise was made for: that it promises
  // little ends nothing.
  const Rows steps = inner.from(entries(n) + n);
  B cut = zero;
  for (std::size_t i = 0; i < n; ++i)
    cut = max<B>(cut, as_number(!(abs(steps[i]) < B(u.furthest[i]))));
  // Where steps shorten fast, the next one leaves of its promise what it is of the last; else that
  // is not all that is left.
  const auto fast = all < promised / 16 && undamped;
  const B after = select<B>(fast, all * (all / promised), all);
  const auto enough = !(constant<B>(1e-13L) * best + rounding < after);
  const auto again_hidden = hidden && !begins && !(all < (promised + gained) * constant<B>(0.95L));
  const auto lost = constant<B>(1e8L) < damping[0] || (begins && !finite);
  // Derivatives far from that best mislead: where a point is lower only there, it is looked at
  // there.
  const auto apart = takes && !begins && old + noise < here;
  const auto ends = takes && (enough || again_hidden) && !apart && !(zero < cut);
  for (std::size_t i = 0; i < n; ++i) {
    const B next_x = select<B>(apart, lowest[i], select<B>(lost && !ends, x[i], to[i]));
    tried.put(i, select<B>(moving, next_x, tried[i]));
  }
  promise.put(0, select<B>(moving && !apart, will, promised));
  // Where no step leads lower, none that is worth one may be left.
  const auto settled = will < constant<B>(1e-6L) * best + 64 * rounding + noise;
  const B how = select<B>(ends || (lost && !begins && settled), one, select<B>(lost, B(2), zero));
  done.put(0, select<B>(moving, how, done[0]));
  return any(select<B>(zero < done[0], zero, one));
}

void compare(const TexelUnknowns& u,
             const UnknownOf& of,
             const float* const* sums,
             TexelState& state) {
  const std::size_t n = u.linear > 0 ? u.linear : u.count;  // others stay
  const Rows x(state.x), tried(state.tried), scratch(state.scratch), cost(state.cost);
  const Rows h = scratch, g = scratch.from(entries(n)), to = g.from(n), inner = to.from(n);
  const B now = gather(u, n, of, sums, tried, h, g);
  const B least = now - step_inside(u, n, tried, h, g, B(0), 3, to, inner);
  const auto lower = least < cost[0];
  for (std::size_t i = 0; i < n; ++i) tried.put(i, to[i]);
  for (std::size_t i = 0; i < u.count; ++i) x.put(i, select<B>(lower, tried[i], x[i]));
  cost.put(0, select<B>(lower, least, cost[0]));
}

void invert(const TexelUnknowns& u, TexelState& state, bool judged, float* left, float* out) {
  const std::size_t n = u.count;
  const Rows x(state.tried), old_x(state.x), h(state.h), left_out(left), inverse(out),
      m(state.scratch);
  const Rows per_pivot = m.from(entries(n)), free = per_pivot.from(n), root = free.from(n);
  const B zero(0), one(1), tiny = constant<B>(1e-30L);
  B strongest = zero;
  const auto step_of = [&](std::size_t i) { return u.by_ratio[i] ? old_x[i] : one; };
  const auto effect = [&](std::size_t i) {
    const B range = (B(u.high[i]) - B(u.low[i])) / step_of(i);
    return h[entry(i, i)] * range * range;
  };
  const auto at_bound = [&](std::size_t i) {
    const B near = (B(u.high[i]) - B(u.low[i])) * constant<B>(1e-7L);
    return !(B(u.low[i]) + near < x[i]) || !(x[i] < B(u.high[i]) - near);
  };
  for (std::size_t i = 0; i < n; ++i)
    strongest = max<B>(strongest, select<B>(at_bound(i), zero, effect(i)));
  for (std::size_t i = 0; i < n; ++i) {
    const auto nothing = !(constant<B>(1e-18L) * strongest < effect(i));
    if (!judged) left_out.put(i, select<B>(at_bound(i), one, select<B>(nothing, B(2), zero)));
    free.put(i, as_number(!(zero < left_out[i])));
    root.put(i, one / sqrt(max<B>(h[entry(i, i)], tiny)));
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = u.first[i]; j < i; ++j)
      m.put(entry(i, j), h[entry(i, j)] * (free[i] * free[j]) * root[i] * root[j]);
    m.put(entry(i, i), one);
  }
  factorise(u, n, m, per_pivot);
  const B most =
      constant<B>(2e5L);  // of a unit matrix: the rest has 5e-6 of an unknown for its own
  for (std::size_t i = 0; i < n && !judged; ++i)
    left_out.put(i, select<B>(most < per_pivot[i] && zero < free[i], B(3), left_out[i]));
  for (std::size_t k = 0; k < n; ++k) {
    const Rows column = inverse.from(k * n);
    for (std::size_t i = 0; i < n; ++i) column.put(i, B(i == k ? 1.0F : 0.0F));
    solve(u, n, m, per_pivot, column);
  }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      const B by = (free[i] * free[j]) * (root[i] * step_of(i)) * (root[j] * step_of(j));
      inverse.put(i * n + j, inverse[i * n + j] * by);
    }
}

void variances(const TexelUnknowns& u,
               const UnknownOf& of,
               const float* const* sums,
               const float* inverse,
               float* variance,
               float* freedom) {
  const std::size_t n = u.count;
  const Rows out(variance), of_parts(freedom);
  const auto b = [&](std::size_t i, std::size_t j) {
    return load<B>(inverse + (i * n + j) * padding);
  };
  const B zero(0);
  for (std::size_t i = 0; i < n; ++i) {
    B sum = zero, alone = zero;
    std::array<B, 2> parts{zero, zero};
    for (std::size_t c = 0; c < of.size(); ++c) {
      const std::size_t k = of[c].size();
      const auto at = [&](std::size_t e) { return load<B>(sums[c] + e * padding); };
      std::size_t e = k + 1;
      for (std::size_t p = 0; p < k; ++p) {
        if (of[c][p] == i) {
          alone = alone + at(1 + p);
          for (std::size_t power = 0; power < 2; ++power)
            parts[power] = parts[power] + at((k + 1) * (k + 2) / 2 + power * k + p);
        }
        for (std::size_t q = p; q < k; ++q, ++e) {
          if (of[c][p] == n || of[c][q] == n) continue;
          const B part = b(i, of[c][p]) * at(e) * b(i, of[c][q]);
          sum = sum + (p == q ? part : part + part);
        }
      }
    }
    constexpr long double some =
        0.01L;  // of the variance from values that alone determine something
    const auto unknown = constant<B>(some) * b(i, i) < alone;
    out.put(i, select<B>(unknown, constant<B>(std::numeric_limits<float>::quiet_NaN()), sum));
    of_parts.put(i, B(3) * (parts[0] / parts[1] * parts[0]) - B(2));
  }
}

/// x and y turned, a texel a lane.
struct Turned {
  explicit Turned(const float* turn) {
    for (std::size_t k = 0; k < by.size(); ++k) by[k] = load<B>(turn + k * padding);
  }
  B x(const B& x, const B& y) const { return by[0] * x + by[1] * y; }
  B y(const B& x, const B& y) const { return by[2] * x + by[3] * y; }
  std::array<B, 4> by;
};

void angles(const TexelDirections& d) {
  const auto rows = [](const float* at) {
    return [at](std::size_t row) { return load<B>(at + row * padding); };
  };
  const auto frame = rows(d.frame);
  const Coordinates<B> x{frame(0), frame(1), frame(2)}, y{frame(3), frame(4), frame(5)},
      z{frame(6), frame(7), frame(8)};
  const auto in_frame = [&](const float* v, std::size_t i) {
    const auto part = [&](std::size_t k) {
      if (d.shared) return B(v[k * d.samples + i]);
      return load<B>(v + (k * d.samples + i) * lanes<B>);
    };
    const B vx = part(0), vy = part(1), vz = part(2);
    const auto with = [&](const Coordinates<B>& a) { return a.x * vx + a.y * vy + a.z * vz; };
    return Coordinates<B>{with(x), with(y), with(z)};
  };
  const Turned turned(d.turn);
  const B zero(0), one(1), harmless = constant<B>(0.5L);
  for (std::size_t i = 0; i < d.samples; ++i) {
    const auto a = angles_between(in_frame(d.light, i), in_frame(d.view, i));
    const auto above = zero < a.nol && zero < a.nov && zero <= a.noh;
    store<B>(d.above + i * lanes<B>, select<B>(above, one, zero));
    const std::array all{a.nol,
                         a.nov,
                         a.noh,
                         a.voh,
                         a.sin2_theta_h,
                         turned.x(a.xoh, a.yoh),
                         turned.y(a.xoh, a.yoh),
                         turned.x(a.xol, a.yol),
                         turned.y(a.xol, a.yol),
                         turned.x(a.xov, a.yov),
                         turned.y(a.xov, a.yov)};
    for (std::size_t k = 0; k < all.size(); ++k)
      store<B>(d.angles[k] + i * lanes<B>, select<B>(above, all[k], harmless));
  }
}

void turn(const TexelTurn& t) {
  const Turned turned(t.turn);
  for (std::size_t i = 0; i < t.samples * lanes<B>; i += lanes<B>)
    for (std::size_t k = 0; k < t.to.size(); k += 2) {
      const B x = load<B>(t.from[k] + i), y = load<B>(t.from[k + 1] + i);
      store<B>(t.to[k] + i, turned.x(x, y));
      store<B>(t.to[k + 1] + i, turned.y(x, y));
    }
}

/// n = m/|m|, m = (t, u, 1):  ∂(n·a)/∂t = (a_x − n·a n_x)/|m|
void tilt(const TexelTilt& t) {
  const B along_x = load<B>(t.tilt), along_y = load<B>(t.tilt + padding), least(t.least);
  const B z = B(1) / sqrt(along_x * along_x + along_y * along_y + B(1)), x = along_x * z,
          y = along_y * z;
  for (std::size_t i = 0; i < t.samples * lanes<B>; i += lanes<B>) {
    std::array<B, 3> cosine;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto of = [&](std::size_t axis) { return load<B>(t.from[3 * k + axis] + i); };
      cosine[k] = x * of(0) + y * of(1) + z * of(2);
      store<B>(t.to[4 + 2 * k] + i, (of(0) - cosine[k] * x) * z);
      store<B>(t.to[5 + 2 * k] + i, (of(1) - cosine[k] * y) * z);
    }
    const auto h = [&](std::size_t axis) { return load<B>(t.from[axis] + i); };
    const B a = y * h(2) - z * h(1), b = z * h(0) - x * h(2), c = x * h(1) - y * h(0);
    store<B>(t.to[0] + i, max<B>(cosine[1], least));
    store<B>(t.to[1] + i, max<B>(cosine[2], least));
    store<B>(t.to[2] + i, cosine[0]);
    store<B>(t.to[3] + i, a * a + b * b + c * c);
  }
}

void read(const TexelRows& t) {
  const B zero(0), far = constant<B>(1e18L),
                   none = constant<B>(std::numeric_limits<float>::quiet_NaN());
  std::array<B, TexelRows::registers> signal;
  signal.fill(zero);
  for (std::size_t r = 0; r < t.rows.size(); ++r) {
    const float* const from = t.values + t.rows[r] * t.texels + t.first;
    const B w(t.weight[r]);
    for (std::size_t k = 0; k < signal.size(); ++k) {
      float* const to = t.to + (k * t.rows.size() + r) * lanes<B>;
      std::memcpy(to, from + k * lanes<B>, sizeof(B));
      const B y = load<B>(to);
      const auto good = zero <= y && y <= far;
      signal[k] = signal[k] + select<B>(good, w * y * (w * y), none);
    }
  }
  for (std::size_t k = 0; k < signal.size(); ++k) store<B>(t.signal + k * padding, signal[k]);
}

template <std::size_t K>
void worth_of_columns(std::size_t n,
                      const float* r,
                      const float* slope,
                      const float* const* j,
                      const float* inverse,
                      float* sums) {
  WorthSums<float, K> worth(inverse, sums);
  for (std::size_t i = 0; i < n; i += lanes<B>) {
    std::array<B, K> column;
    column[0] = load<B>(r + i);
    const B w = load<B>(slope + i);
    for (std::size_t k = 1; k < K; ++k) column[k] = unmasked<B>(w, load<B>(j[k - 1] + i));
    worth.add(column);
  }
  worth.store_to(sums);
}

template <std::size_t... K>
constexpr std::array<WorthOfColumns, max_columns + 1> worth_table(std::index_sequence<K...>) {
  return {nullptr, worth_of_columns<K + 1>...};
}

}  // namespace

template <Role role>
std::array<std::span<const TexelTerms<float>::Derivatives>, 2> texel_terms_of();
std::span<const TexelTerms<float>::Derivatives> texel_terms_of_files();
std::array<std::span<const FusedTexels>, 2> fused_texels();

#define GONIO_TEXT_OF(name) #name
#define GONIO_TEXT(name) GONIO_TEXT_OF(name)

/// The terms of all roles in the catalogue's order; behind them functions of files, for given normals only.
/// \param tilt  1: those of tilted normals
static std::span<const TexelTerms<float>::Derivatives> all_terms(std::size_t tilt) {
  static const auto all = [] {
    std::array<std::vector<TexelTerms<float>::Derivatives>, 2> joined;
    for (const auto& of : {texel_terms_of<Role::ndf>(), texel_terms_of<Role::masking>(),
                           texel_terms_of<Role::fresnel>(), texel_terms_of<Role::diffuse>()})
      for (std::size_t t = 0; t < 2; ++t)
        joined[t].insert(joined[t].end(), of[t].begin(), of[t].end());
    const auto of_files = texel_terms_of_files();
    joined[0].insert(joined[0].end(), of_files.begin(), of_files.end());
    return joined;
  }();
  return all[tilt];
}

LaneKernels lane_table();
LaneKernels lane_table() {
  return {GONIO_TEXT(GONIO_ARCH),
          lanes<B>,
          all_terms(0),
          all_terms(1),
          fused_texels()[0],
          fused_texels()[1],
          worth_table(std::make_index_sequence<max_columns>{}),
          angles,
          turn,
          tilt,
          read,
          descend,
          compare,
          invert,
          variances};
}

}  // namespace gonio::inline GONIO_ARCH
