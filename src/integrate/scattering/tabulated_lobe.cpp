#include "integrate/scattering/tabulated_lobe.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/whole_loop.h"
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

/// F of each channel at even cosines, from 0 to 1.
constexpr std::size_t cosines = 64;
using ReflectanceTable = std::array<std::array<double, 3>, cosines + 1>;

std::vector<std::array<double, cosines + 1>> reflectances(const BoundModel& m,
                                                          std::size_t channels) {
  AngleBlock angles(true);
  const auto columns = angles.resize(cosines + 1);
  for (std::size_t k = 0; k <= cosines; ++k)
    columns[3][k] = static_cast<double>(k) / static_cast<double>(cosines);
  double* const value = angles.extra(0);
  std::vector<std::array<double, cosines + 1>> all(channels);
  const TermUse& f = m.model.lobes[0].fresnel;
  for (std::size_t c = 0; c < channels; ++c) {
    term_values(f.term, term_parameters(m, f, c), angles.block(), value);
    std::copy_n(value, cosines + 1, all[c].begin());
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

/// Gathers what goes from each facet after the first along many directions, as Towards of walk.cpp does along one.
class TowardsMany {
 public:
  struct Light {
    std::vector<Direction> l;
    std::vector<double> lambda;
  };
  TowardsMany(const Surface& s,
              const Light& light,
              const std::vector<std::array<double, cosines + 1>>& f,
              std::span<const ColourOfChannel> colour)
      : surface_(s),
        light_(light),
        f_(f),
        colour_(colour),
        angles_(true),
        sum_(3 * light.l.size()) {
    columns_ = angles_.resize(Walkers::most);
    for (auto* const c : columns_) std::fill_n(c, Walkers::most, 0.5);
  }
  void at_facets(Walkers& w, Tally&) {
    for (std::size_t i = 0; i < w.size(); ++i)
      if (w.bounces(i) > 0) gather(w, i);
  }
  void at_end(const Walkers&, std::size_t, Tally&) const {}
  std::span<const double> sum() const { return sum_; }

 private:
  void gather(Walkers& w, std::size_t walker) {
    for (std::size_t k = 0; k <= cosines; ++k) {
      auto& of = reflected_[k] = {};
      for (std::size_t c = 0; c < f_.size(); ++c)
        for (std::size_t rgb = 0; rgb < 3; ++rgb)
          of[rgb] += w.weight(c, walker) * f_[c][k] * colour_[c][rgb];
    }
    const Direction d = w.flight(walker);
    const double depth = w.depth(walker), per_area = 0.25 / w.area(walker);
    double lambda = -1, leaves = 0;  // those of a zenith angle on a round surface share them
    for (std::size_t first = 0; first < light_.l.size(); first += Walkers::most) {
      const std::size_t n = std::min(Walkers::most, light_.l.size() - first);
      for (std::size_t i = 0; i < n; ++i) {
        const Direction& l = light_.l[first + i];
        const double x = l.x - d.x, y = l.y - d.y, z = l.z - d.z;
        const double length2 = std::max(x * x + y * y + z * z, 1e-30), length = std::sqrt(length2);
        const bool faces_up = z > 0;
        columns_[2][i] = faces_up ? z / length : 1;
        columns_[3][i] = std::min(length / 2, 1.0);
        columns_[4][i] = faces_up ? (x * x + y * y) / length2 : 0;
        columns_[5][i] = x / length;
        columns_[6][i] = y / length;
        if (light_.lambda[first + i] != lambda) {
          lambda = light_.lambda[first + i];
          leaves = std::exp(-depth * lambda) * per_area / l.z;
        }
        share_[i] = faces_up ? leaves : 0;
      }
      surface_.ndf(angles_.block().part(0, padded(n)), w.scratch(), share_.data(), share_.data());
      double* to = &sum_[3 * first];
      for (std::size_t i = 0; i < n; ++i, to += 3) {
        const double at = columns_[3][i] * cosines;
        const auto k = std::min(static_cast<std::size_t>(at), cosines - 1);
        const double rest = at - static_cast<double>(k);
        for (std::size_t rgb = 0; rgb < 3; ++rgb)
          to[rgb] += share_[i] *
                     (reflected_[k][rgb] + rest * (reflected_[k + 1][rgb] - reflected_[k][rgb]));
      }
    }
  }

  const Surface& surface_;
  const Light& light_;
  const std::vector<std::array<double, cosines + 1>>& f_;
  std::span<const ColourOfChannel> colour_;
  AngleBlock angles_;
  std::span<double* const> columns_;
  Walkers::Weights share_{};
  ReflectanceTable reflected_{};
  std::vector<double> sum_;
};

}  // namespace

TabulatedLobe::Place TabulatedLobe::place(double x, std::size_t nodes) {
  const double at = std::clamp(x, 0.0, 1.0) * static_cast<double>(nodes - 1);
  const auto k = std::min(static_cast<std::size_t>(at), nodes - 2);
  return {k, at - static_cast<double>(k)};
}
double TabulatedLobe::zenith(double mu) const {
  return std::asinh(mu / layer_) / std::asinh(1 / layer_);
}
double TabulatedLobe::cosine(std::size_t node) const {
  const double t = static_cast<double>(node) / (zeniths - 1);
  return std::clamp(layer_ * std::sinh(t * std::asinh(1 / layer_)), least_cosine, 1.0);
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
  azimuths_ = round ? 16 : 31;
  fill(m, colour, goal);
  if (round) {
    swap_directions();
  } else {
    const std::size_t azimuth = 3, l = azimuth * azimuths_, view = l * zeniths, v = view * views_;
    smooth(azimuth, azimuths_);
    smooth(l, zeniths);
    smooth(view, views_);
    smooth(v, zeniths);
  }
  const bool known = round && s.slopes == Microsurface::Slopes::ggx;
  const double between = known ? std::min(0.01 + 0.0015 / (layer_ * layer_), 0.4)
                               : error_between_nodes(m, colour, goal);
  for (std::size_t i = 0; i < f_.size(); ++i)
    error_[i] = static_cast<float>(std::hypot(double{error_[i]}, between * double{f_[i]}));
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
  // What smoothing does for a lobe that is not round.
  const double facets = static_cast<double>(goal.facets) / (views_ > 1 ? 16 : 1);
  f_.resize(node(zeniths, 0, 0, 0));
  error_.resize(f_.size());
  for_each_whole(zeniths * views_, [&](std::size_t k) {
    const std::size_t iv = k / views_, view = k % views_;
    const double mu = cosine(iv), sine = std::sqrt((1 - mu) * (1 + mu));
    const double phi_v =
        views_ > 1 ? half_turn / 2 * static_cast<double>(view) / static_cast<double>(views_ - 1)
                   : 0;
    const Direction v{sine * std::cos(phi_v), sine * std::sin(phi_v), mu};
    TowardsMany::Light light;
    for (std::size_t il = 0; il < zeniths; ++il) {
      const double mu_l = cosine(il), sine_l = std::sqrt((1 - mu_l) * (1 + mu_l));
      const double w = width(mu_l, mu, phi_v);
      for (std::size_t is = 0; is < azimuths_; ++is) {
        const double at = static_cast<double>(is) / static_cast<double>(azimuths_ - 1);
        const double phi = phi_v + half_turn + azimuth_at(views_ > 1 ? 2 * at - 1 : at, w);
        light.l.push_back({sine_l * std::cos(phi), sine_l * std::sin(phi), mu_l});
      }
    }
    light.lambda.resize(light.l.size());
    const auto sized = [&](std::size_t from) {
      return std::min(Walkers::most, light.l.size() - from);
    };
    {
      Walkers w(surface, v, Draws(0));
      for (std::size_t at = 0; at < light.l.size(); at += Walkers::most)
        w.lambdas({&light.l[at], sized(at)}, &light.lambda[at]);
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
    std::vector<double> mean(3 * light.l.size()), square(mean.size());
    for (std::size_t b = 0; b < batches; ++b) {
      Walkers w(surface, v, Draws(goal.seed, k, b));
      TowardsMany count(surface, light, f, colour);
      walk_chunk(w, count, walks, bounces);
      for (std::size_t i = 0; i < mean.size(); ++i) {
        const double x = count.sum()[i] / static_cast<double>(walks);
        mean[i] += x / batches;
        square[i] += x * x / batches;
      }
    }
    const std::size_t first = node(iv, view, 0, 0);
    for (std::size_t i = 0; i < mean.size(); ++i) {
      const Direction& l = light.l[i / 3];
      const double scale = (mu + l.z) / shape(l.x + v.x, l.y + v.y, l.z + v.z);
      f_[first + i] = static_cast<float>(scale * mean[i]);
      error_[first + i] = static_cast<float>(
          scale * std::sqrt(std::max(0.0, square[i] - mean[i] * mean[i]) / (batches - 1)));
    }
  });
}

double TabulatedLobe::error_between_nodes(const BoundModel& m,
                                          std::span<const ColourOfChannel> colour,
                                          const TabulationGoal& goal) const {
  std::array<double, 64> off, noise;  // over the lobe
  for_each_whole(off.size(), [&](std::size_t i) {
    Draws draw(goal.seed, i);
    const auto any = [&] {
      const auto d = cosine_direction({draw.uniform(), 1 - draw.uniform()});
      return Direction{d.x, d.y, d.z};
    };
    const Direction v = any(), other = any();
    Direction l = other;
    if (i % 2 == 0) {  // near where v is mirrored
      constexpr double near = 0.3;
      const double x = -v.x + near * (draw.uniform() - 0.5),
                   y = -v.y + near * (draw.uniform() - 0.5);
      if (x * x + y * y < 1) l = {x, y, std::sqrt(1 - x * x - y * y)};
    }
    const auto walked = walk_value(m, l, v, {goal.seed + 1, std::size_t{1} << 15});
    double lobe = 0, error = 0;
    for (std::size_t c = 0; c < colour.size(); ++c) {
      const double share = (colour[c][0] + colour[c][1] + colour[c][2]) / 3;
      double square = 0;
      for (std::size_t n = 1; n < walked.order[c].size(); ++n)
        square += walked.order_error[c][n] * walked.order_error[c][n];
      lobe += share * (walked.value[c] - walked.order[c][0]);
      error += share * std::sqrt(square);
    }
    const auto [f, own] = at(angles_between<double>({l.x, l.y, l.z}, {v.x, v.y, v.z}));
    off[i] = std::abs((f[0] + f[1] + f[2]) / 3 - lobe) / lobe;
    noise[i] = std::hypot(error, (own[0] + own[1] + own[2]) / 3) / lobe;
  });
  const auto median = [](std::array<double, 64>& x) {
    std::ranges::nth_element(x, x.begin() + x.size() / 2);
    return x[x.size() / 2];
  };
  // The median of a normal distribution's sizes is 0.674 of its width; a quarter of the square is
  // its own standard error of 64.
  const double width = median(off) / 0.674, known = median(noise), square = width * width;
  return std::sqrt(std::max(0.0, square - known * known) + 0.25 * square);
}

/// f is the same with l and v in each other's place: two walks for one.
void TabulatedLobe::swap_directions() {
  for (std::size_t v = 0; v < zeniths; ++v)
    for (std::size_t l = 0; l < v; ++l)
      for (std::size_t i = 0; i < 3 * azimuths_; ++i) {
        float &a = f_[node(v, 0, l, 0) + i], &b = f_[node(l, 0, v, 0) + i];
        a = b = (a + b) / 2;
        float &e = error_[node(v, 0, l, 0) + i], &g = error_[node(l, 0, v, 0) + i];
        e = g = std::hypot(e, g) / 2;
      }
}

/// Means of each node with its neighbours before and after it along one direction of the table, by 1 : 2 : 1.
void TabulatedLobe::smooth(std::size_t step, std::size_t nodes) {
  for (std::size_t first = 0; first < f_.size(); first += step * nodes)
    for (std::size_t i = 0; i < step; ++i) {
      float before = f_[first + i], error_before = error_[first + i];
      for (std::size_t k = 1; k + 1 < nodes; ++k) {
        float *const f = &f_[first + k * step + i], *const e = &error_[first + k * step + i];
        const float mean = (before + 2 * f[0] + f[step]) / 4,
                    error = std::hypot(error_before, 2 * e[0], e[step]) / 4;
        before = std::exchange(f[0], mean);
        error_before = std::exchange(e[0], error);
      }
    }
}

TabulatedLobe::Value TabulatedLobe::at(const FrameAngles<double>& a) const {
  const double nol = std::clamp(a.nol, least_cosine, 1.0),
               nov = std::clamp(a.nov, least_cosine, 1.0);
  double psi, phi_v = 0, factor = 1 / (nol + nov);
  if (views_ > 1) {
    psi = std::atan2(a.yov * a.xol - a.xov * a.yol, -a.xov * a.xol - a.yov * a.yol);
    if ((a.xov < 0) != (a.yov < 0)) psi = -psi;
    phi_v = std::atan2(std::abs(a.yov), std::abs(a.xov));
    factor *= shape(a.xol + a.xov, a.yol + a.yov, nol + nov);
  } else {
    const double sl = std::sqrt(1 - nol * nol), sv = std::sqrt(1 - nov * nov);
    const double across = 2 * a.voh,
                 square = across * across * a.sin2_theta_h - (sl - sv) * (sl - sv);
    psi = 2 * std::asin(std::sqrt(std::clamp(square / (4 * std::max(sl * sv, 1e-12)), 0.0, 1.0)));
  }
  const double s = graded(psi, width(nol, nov, phi_v));
  const Place pv = place(zenith(nov), zeniths), pl = place(zenith(nol), zeniths),
              pa = place(views_ > 1 ? (s + 1) / 2 : s, azimuths_),
              pp = views_ > 1 ? place(phi_v / (half_turn / 2), views_) : Place{0, 0};
  Value sum{};
  for (const std::size_t v : {0U, 1U})
    for (std::size_t view = 0; view < (views_ > 1 ? 2U : 1U); ++view)
      for (const std::size_t l : {0U, 1U}) {
        const double share = factor * (v ? pv.share : 1 - pv.share) *
                             (view ? pp.share : 1 - pp.share) * (l ? pl.share : 1 - pl.share);
        const std::size_t first = node(pv.at + v, pp.at + view, pl.at + l, pa.at);
        for (std::size_t c = 0; c < 3; ++c) {
          const auto between = [&](const std::vector<float>& of) {
            return share * std::lerp(double{of[first + c]}, double{of[first + 3 + c]}, pa.share);
          };
          sum.f[c] += between(f_);
          sum.error[c] += between(error_);
        }
      }
  return sum;
}

template <class F>
void TabulatedLobe::add(const Block<F>& x, double errors, const std::array<F*, 3>& f) const {
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
    for (std::size_t c = 0; c < 3; ++c)
      f[c][i] += static_cast<F>(value.f[c] + errors * value.error[c]);
  }
}
template void TabulatedLobe::add(const Block<float>&, double, const std::array<float*, 3>&) const;
template void TabulatedLobe::add(const Block<double>&, double, const std::array<double*, 3>&) const;

}  // namespace gonio
