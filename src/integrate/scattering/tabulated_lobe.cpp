#include "integrate/scattering/tabulated_lobe.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/whole_loop.h"
#include "brdf/catalogue/foreign_terms.h"
#include "geometry/half_vector.h"
#include "geometry/sampling.h"
#include "integrate/scattering/walk.h"
#include "integrate/scattering/walkers.h"

namespace gonio {
namespace {

using namespace walking;
constexpr double half_turn = std::numbers::pi;

/// Azimuth from −v, in [−π, π], as the table has it: 0 where light goes on straight, evenly in asinh(ψ/width).
double graded(double psi, double width) {
  return std::asinh(psi / width) / std::asinh(half_turn / width);
}
double azimuth_at(double graded, double width) {
  return width * std::sinh(graded * std::asinh(half_turn / width));
}

/// Light along the horizon counts as this much above it.
constexpr double least_cosine = 1e-4;

/// F of a channel at even cosines, from 0 to 1, with straight lines between them: of Schlick's they are off by at most 6e-4.
constexpr std::size_t segments = 64;
using Curve = std::array<double, segments + 1>;

std::vector<Curve> reflectances(const BoundModel& m, std::size_t channels) {
  AngleBlock angles(true);
  const auto columns = angles.resize(segments + 1);
  for (std::size_t k = 0; k <= segments; ++k)
    columns[3][k] = static_cast<double>(k) / static_cast<double>(segments);
  double* const value = angles.extra(0);
  std::vector<Curve> all(channels);
  const TermUse& f = m.model.lobes[0].fresnel;
  for (std::size_t c = 0; c < channels; ++c) {
    term_values(term_of_channel(f.term, c), term_parameters(m, f, c), angles.block(), value);
    std::copy_n(value, segments + 1, all[c].begin());
  }
  return all;
}

/// Counts facets after the first.
struct CountLater {
  std::size_t facets = 0;
  void at_facets(const Walkers& w, Tally&) {
    for (std::size_t i = 0; i < w.size(); ++i) facets += w.bounces(i) > 0;
  }
  void at_end(const Walkers&, std::size_t, Tally&) const {}
};

/// Directions of light as columns, with Λ.
struct Lights {
  std::vector<double> x, y, z, lambda, area;  ///< σ(l)
  std::size_t size() const { return x.size(); }
  void add(const Direction& l) { x.push_back(l.x), y.push_back(l.y), z.push_back(l.z); }
};

/// Gathers what goes from each facet after the first along many directions, as Towards of walk.cpp does along one.
class TowardsMany {
 public:
  TowardsMany(const Surface& s,
              const Lights& light,
              std::size_t sharing,
              const std::vector<Curve>& f,
              std::span<const ColourOfChannel> colour)
      : surface_(s),
        light_(light),
        sharing_(sharing),
        f_(f),
        colour_(colour),
        angles_(true),
        sum_(3 * light.size()) {
    columns_ = angles_.resize(Walkers::most);
    for (auto* const c : columns_) std::fill_n(c, Walkers::most, 0.5);
  }
  void at_facets(Walkers& w, Tally&) {
    for (std::size_t i = 0; i < w.size(); ++i)
      if (w.bounces(i) > 0) gather(w, i);
  }
  void at_end(const Walkers&, std::size_t, Tally&) const {}
  /// [channel][direction]
  std::span<const double> sum() const { return sum_; }

 private:
  void gather(Walkers& w, std::size_t walker) {
    std::array<Curve, 3> reflected{};
    for (std::size_t c = 0; c < f_.size(); ++c)
      for (std::size_t rgb = 0; rgb < 3; ++rgb)
        if (const double weight = w.weight(c, walker) * colour_[c][rgb]; weight != 0)
          for (std::size_t k = 0; k <= segments; ++k) reflected[rgb][k] += weight * f_[c][k];
    const Direction d = w.flight(walker);
    const double depth = w.depth(walker), per_area = 0.25 / w.area(walker);
    for (std::size_t first = 0; first < light_.size(); first += Walkers::most) {
      const std::size_t n = std::min(Walkers::most, light_.size() - first);
      for (std::size_t i = 0; i < n; i += sharing_)
        std::fill_n(&share_[i], std::min(sharing_, n - i),
                    std::exp(-depth * light_.lambda[first + i]) * per_area);
      towards(d, first, n);
      surface_.ndf(angles_.block().part(0, padded(n)), w.scratch(), w.scratch().ones(),
                   density_.data());
      weigh(w.first(walker) / w.area_in(), first, n);
      for (std::size_t rgb = 0; rgb < 3; ++rgb)
        add(reflected[rgb], n, &sum_[rgb * light_.size() + first]);
    }
  }
  /// The half vectors' angles.
  void towards(const Direction& d, std::size_t first, std::size_t n) {
    const double *const lx = &light_.x[first], *const ly = &light_.y[first],
                        *const lz = &light_.z[first];
    double *const noh = columns_[2], *const voh = columns_[3], *const sin2 = columns_[4],
                  *const hx = columns_[5], *const hy = columns_[6], *const share = share_.data();
#pragma GCC ivdep
    for (std::size_t i = 0; i < n; ++i) {
      const double x = lx[i] - d.x, y = ly[i] - d.y, z = lz[i] - d.z;
      const double across = x * x + y * y, length2 = std::max(across + z * z, 1e-30);
      const double length = std::sqrt(length2), per_length = 1 / length;
      const bool up = z > 0;
      noh[i] = up ? z * per_length : 1;
      voh[i] = std::min(length * 0.5, 1.0);
      sin2[i] = up ? across * per_length * per_length : 0;
      hx[i] = x * per_length;
      hy[i] = y * per_length;
      share[i] = up ? share[i] : 0;
    }
  }
  /// Shares by D of the last facet, and by the part that walks from here have of all that go this way.
  void weigh(double from_here, std::size_t first, std::size_t n) {
    const double *const d = density_.data(), *const area = &light_.area[first];
    double* const share = share_.data();
#pragma GCC ivdep
    for (std::size_t i = 0; i < n; ++i)
      share[i] *= d[i] * from_here * area[i] / std::max(from_here * area[i] + d[i], 1e-300);
  }
  void add(const Curve& f, std::size_t n, double* sum) const {
    for (std::size_t i = 0; i < n; ++i) {
      const double at = columns_[3][i] * static_cast<double>(segments);
      const auto k = std::min(static_cast<std::size_t>(at), segments - 1);
      sum[i] += share_[i] * (f[k] + (at - static_cast<double>(k)) * (f[k + 1] - f[k]));
    }
  }

  const Surface& surface_;
  const Lights& light_;
  std::size_t sharing_;  ///< that many in a row have the same Λ
  const std::vector<Curve>& f_;
  std::span<const ColourOfChannel> colour_;
  AngleBlock angles_;
  std::span<double* const> columns_;
  Walkers::Weights share_{}, density_{};
  std::vector<double> sum_;
};

}  // namespace

TabulatedLobe::Taps TabulatedLobe::taps(double x, std::size_t nodes, Ends ends) {
  const double at = std::clamp(x, 0.0, 1.0) * static_cast<double>(nodes - 1);
  const auto k = std::min(static_cast<std::size_t>(at), nodes - 2);
  const double t = at - static_cast<double>(k);
  Taps p{{k - 1, k, k + 1, k + 2},
         {((-t + 2) * t - 1) * t / 2, ((3 * t - 5) * t * t + 2) / 2, ((-3 * t + 4) * t + 1) * t / 2,
          (t - 1) * t * t / 2},
         {0, 1 - t, t, 0},
         {}};
  // A node beyond an end: its mirror image, the node at the other end, or 3 f₀ − 3 f₁ + f₂ of a
  // parabola.
  const auto beyond = [&](std::size_t tap, std::size_t mirrored, std::size_t around) {
    p.at[tap] = ends == Ends::around ? around : mirrored;
    p.beyond[tap] = ends == Ends::mirrored;
    if (ends != Ends::open) return;
    const double share = std::exchange(p.share[tap], 0);
    p.share[tap == 0 ? 1 : 2] += 3 * share;
    p.share[tap == 0 ? 2 : 1] -= 3 * share;
    p.share[3 - tap] += share;
  };
  if (k == 0) beyond(0, 1, nodes - 2);
  if (k + 2 == nodes) beyond(3, nodes - 2, 1);
  return p;
}
double TabulatedLobe::zenith(double mu) const {
  return std::asinh(std::asin(mu) / layer_) / std::asinh(half_turn / 2 / layer_);
}
double TabulatedLobe::cosine(std::size_t node) const {
  const double t = static_cast<double>(node) / (zeniths - 1);
  return std::clamp(std::sin(layer_ * std::sinh(t * std::asinh(half_turn / 2 / layer_))),
                    least_cosine, 1.0);
}
double TabulatedLobe::width(double mu_l, double mu_v, double phi_v) const {
  const double across = std::hypot(alpha_x_ * std::sin(phi_v), alpha_y_ * std::cos(phi_v));
  const double sines = std::sqrt((1 - mu_l * mu_l) * (1 - mu_v * mu_v));
  return std::min(across * (mu_l + mu_v) / std::sqrt(std::max(sines, 1e-12)), 1e3);
}

double TabulatedLobe::shape(double x, double y, double z) const {
  if (views_ == 1) return 1;
  const double along = x / (alpha_x_ * z), across = y / (alpha_y_ * z);
  return 1 / (1 + (along * along + across * across) / 2);
}

TabulatedLobe::TabulatedLobe(const BoundModel& m,
                             std::span<const ColourOfChannel> colour,
                             const TabulationGoal& goal) {
  const Microsurface s = microsurfaces(m).at(0);
  alpha_x_ = s.alpha_x, alpha_y_ = s.alpha_y;
  layer_ = std::sqrt(alpha_x_ * alpha_y_);
  const bool round = alpha_x_ == alpha_y_;
  views_ = round ? 1 : 13;
  azimuths_ = round ? 16 : 25;
  fill(m, colour, goal);
  add_other_way();
}

void TabulatedLobe::fill(const BoundModel& m,
                         std::span<const ColourOfChannel> colours,
                         const TabulationGoal& goal) {
  constexpr std::size_t batches = 8, bounces = 1000;
  const Surface surface = surfaces_of(m)[0];
  std::vector<ColourOfChannel> colour(colours.begin(), colours.end());
  if (surface.fresnel.size() < colour.size())  // all channels reflect the same
    for (; colour.size() > 1; colour.pop_back())
      for (std::size_t rgb = 0; rgb < 3; ++rgb) colour[0][rgb] += colour.back()[rgb];
  const auto f = reflectances(m, surface.fresnel.size());
  const double facets = static_cast<double>(goal.facets) / (views_ > 1 ? 4 : 1);
  std::array<std::vector<float>, batches> tables;
  for (auto& t : tables) t.resize(node(zeniths, 0, 0, 0));
  for_each_whole(zeniths * views_, [&](std::size_t k) {
    const std::size_t iv = k / views_, view = k % views_;
    const Direction v = directions_of(iv, view, 0, 0).v;
    Lights light;
    for (std::size_t il = 0; il < zeniths; ++il)
      for (std::size_t is = 0; is < azimuths_; ++is) light.add(directions_of(iv, view, il, is).l);
    light.lambda.resize(light.size());
    {
      Walkers w(surface, v, Draws(0));
      std::vector<Direction> up;
      for (std::size_t at = 0; at < light.size(); at += up.size()) {
        up.clear();
        for (std::size_t i = at; i < light.size() && up.size() < Walkers::most; ++i)
          up.push_back({light.x[i], light.y[i], light.z[i]});
        w.lambdas(up, &light.lambda[at]);
      }
      for (std::size_t i = 0; i < light.size(); ++i)
        light.area.push_back(light.z[i] * (1 + light.lambda[i]));
    }
    // Walks by how many facets a few of them meet after the first.
    constexpr std::size_t few = 512;
    CountLater later;
    {
      Walkers w(surface, v, Draws(goal.seed, k, batches));
      walk_chunk(w, later, few, bounces);
    }
    const double per_walk = static_cast<double>(std::max<std::size_t>(later.facets, 1)) / few;
    const auto walks = std::clamp<std::size_t>(
        static_cast<std::size_t>(facets / per_walk) / batches, 32, goal.walks / batches);
    const std::size_t first = node(iv, view, 0, 0);
    for (std::size_t b = 0; b < batches; ++b) {
      Walkers w(surface, v, Draws(goal.seed, k, b));
      w.spread_evenly();
      TowardsMany count(surface, light, views_ > 1 ? 1 : azimuths_, f, colour);
      walk_chunk(w, count, walks, bounces);
      for (std::size_t i = 0; i < light.size(); ++i) {
        const double z = light.z[i];
        const double scale = (v.z + z) / (z * static_cast<double>(walks) *
                                          shape(light.x[i] + v.x, light.y[i] + v.y, v.z + z));
        for (std::size_t rgb = 0; rgb < 3; ++rgb)
          tables[b][first + 3 * i + rgb] =
              static_cast<float>(scale * count.sum()[rgb * light.size() + i]);
      }
    }
  });
  f_.resize(tables[0].size());
  error_.resize(f_.size());
  for (std::size_t i = 0; i < f_.size(); ++i) {
    double mean = 0, square = 0;
    for (const auto& t : tables) mean += double{t[i]} / batches;
    for (const auto& t : tables) square += (double{t[i]} - mean) * (double{t[i]} - mean);
    f_[i] = static_cast<float>(mean);
    error_[i] = static_cast<float>(std::sqrt(square / (batches * (batches - 1))));
  }
}

TabulatedLobe::Pair TabulatedLobe::directions_of(std::size_t v,
                                                 std::size_t view,
                                                 std::size_t l,
                                                 std::size_t azimuth) const {
  const double mu_v = cosine(v), sine_v = std::sqrt((1 - mu_v) * (1 + mu_v));
  const double mu_l = cosine(l), sine_l = std::sqrt((1 - mu_l) * (1 + mu_l));
  const double phi_v =
      views_ > 1 ? half_turn / 2 * static_cast<double>(view) / static_cast<double>(views_ - 1) : 0;
  const double at = static_cast<double>(azimuth) / static_cast<double>(azimuths_ - 1);
  const double phi =
      phi_v + half_turn + azimuth_at(views_ > 1 ? 2 * at - 1 : at, width(mu_l, mu_v, phi_v));
  return {{sine_l * std::cos(phi), sine_l * std::sin(phi), mu_l},
          {sine_v * std::cos(phi_v), sine_v * std::sin(phi_v), mu_v}};
}

/// Adds what walks that start at l have of the same ways: at the same nodes of a round lobe, between nodes of another.
void TabulatedLobe::add_other_way() {
  auto f = f_, error = error_;
  for_each_whole(zeniths * views_, [&](std::size_t k) {
    const std::size_t v = k / views_, view = k % views_;
    for (std::size_t l = 0; l < zeniths; ++l)
      for (std::size_t i = 0; i < azimuths_; ++i) {
        std::array<double, 3> other{}, other_error{};
        if (views_ == 1) {
          for (std::size_t c = 0; c < 3; ++c) {
            other[c] = double{f_[node(l, 0, v, i) + c]};
            other_error[c] = double{error_[node(l, 0, v, i) + c]};
          }
        } else {
          const auto d = directions_of(v, view, l, i);
          const auto back =
              at(angles_between<double>({d.v.x, d.v.y, d.v.z}, {d.l.x, d.l.y, d.l.z}));
          const double scale = (d.l.z + d.v.z) / shape(d.l.x + d.v.x, d.l.y + d.v.y, d.l.z + d.v.z);
          for (std::size_t c = 0; c < 3; ++c) {
            other[c] = scale * back.f[c];
            other_error[c] = scale * back.error[c];
          }
        }
        const std::size_t first = node(v, view, l, i);
        for (std::size_t c = 0; c < 3; ++c) {
          f[first + c] = static_cast<float>(double{f_[first + c]} + other[c]);
          error[first + c] =
              static_cast<float>(std::hypot(double{error_[first + c]}, other_error[c]));
        }
      }
  });
  f_ = std::move(f), error_ = std::move(error);
}

TabulatedLobe::Value TabulatedLobe::at(const FrameAngles<double>& a) const {
  const double nol = std::clamp(a.nol, least_cosine, 1.0),
               nov = std::clamp(a.nov, least_cosine, 1.0);
  const bool round = views_ == 1;
  double psi, phi_v = 0, factor = 1 / (nol + nov);
  if (round) {
    const double sl = std::sqrt(1 - nol * nol), sv = std::sqrt(1 - nov * nov);
    const double across = 2 * a.voh,
                 square = across * across * a.sin2_theta_h - (sl - sv) * (sl - sv);
    psi = 2 * std::asin(std::sqrt(std::clamp(square / (4 * std::max(sl * sv, 1e-12)), 0.0, 1.0)));
  } else {
    psi = std::atan2(a.yov * a.xol - a.xov * a.yol, -a.xov * a.xol - a.yov * a.yol);
    if ((a.xov < 0) != (a.yov < 0)) psi = -psi;
    phi_v = std::atan2(std::abs(a.yov), std::abs(a.xov));
    factor *= shape(a.xol + a.xov, a.yol + a.yov, nol + nov);
  }
  const double s = graded(psi, width(nol, nov, phi_v));
  const Taps tv = taps(zenith(nov), zeniths, Ends::open),
             tl = taps(zenith(nol), zeniths, Ends::open),
             ta = round ? taps(s, azimuths_, Ends::mirrored)
                        : taps((s + 1) / 2, azimuths_, Ends::around),
             tp = round ? Taps{} : taps(phi_v / (half_turn / 2), views_, Ends::mirrored);
  // Along v, the viewer's azimuth, l and the azimuth; in a straight line the inner two of four.
  std::array<double, 3> cubic{}, line{}, sigma{};
  const auto gather = [&](std::size_t first, std::size_t last, auto&& use) {
    for (std::size_t v = first; v < last; ++v)
      for (std::size_t view = round ? 1 : first; view < (round ? 2 : last); ++view)
        for (std::size_t l = first; l < last; ++l)
          for (std::size_t k = first; k < last; ++k) {
            const std::size_t azimuth = tp.beyond[view] ? azimuths_ - 1 - ta.at[k] : ta.at[k];
            use(node(tv.at[v], tp.at[view], tl.at[l], azimuth), v, view, l, k);
          }
  };
  gather(0, 4, [&](std::size_t n, std::size_t v, std::size_t view, std::size_t l, std::size_t k) {
    const double share = tv.share[v] * tp.share[view] * tl.share[l] * ta.share[k];
    for (std::size_t c = 0; c < 3; ++c) cubic[c] += share * double{f_[n + c]};
  });
  gather(1, 3, [&](std::size_t n, std::size_t v, std::size_t view, std::size_t l, std::size_t k) {
    const double share = tv.line[v] * tp.line[view] * tl.line[l] * ta.line[k];
    for (std::size_t c = 0; c < 3; ++c) {
      line[c] += share * double{f_[n + c]};
      sigma[c] += share * double{error_[n + c]};
    }
  });
  Value value;
  for (std::size_t c = 0; c < 3; ++c) {
    value.f[c] = factor * std::max(cubic[c], 0.0);
    value.error[c] = factor * std::hypot(sigma[c], cubic[c] - line[c], 0.01 * cubic[c]);
  }
  return value;
}

template <class F>
void TabulatedLobe::add(const Block<F>& x,
                        const std::array<F*, 3>& f,
                        double errors,
                        const std::array<F*, 3>& off) const {
  const auto in = [](const F* column, std::size_t i) { return static_cast<double>(column[i]); };
  for (std::size_t i = 0; i < x.n; ++i) {
    FrameAngles<double> a{};
    a.nol = in(x.nol, i), a.nov = in(x.nov, i), a.voh = in(x.voh, i);
    a.sin2_theta_h = in(x.sin2_theta_h, i);
    if (views_ > 1) {
      a.xol = in(x.frame[2], i), a.yol = in(x.frame[3], i);
      a.xov = in(x.frame[4], i), a.yov = in(x.frame[5], i);
    }
    const Value value = at(a);
    for (std::size_t c = 0; c < 3; ++c) {
      f[c][i] += static_cast<F>(value.f[c]);
      if (off[c]) off[c][i] += static_cast<F>(value.f[c] + errors * value.error[c]);
    }
  }
}
template void TabulatedLobe::add(const Block<float>&,
                                 const std::array<float*, 3>&,
                                 double,
                                 const std::array<float*, 3>&) const;
template void TabulatedLobe::add(const Block<double>&,
                                 const std::array<double*, 3>&,
                                 double,
                                 const std::array<double*, 3>&) const;

}  // namespace gonio
