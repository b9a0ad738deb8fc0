#include "integrate/albedo/directional_albedo.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <numbers>
#include <optional>

#include "base/error.h"
#include "base/whole_loop.h"
#include "brdf/catalogue/foreign_terms.h"
#include "brdf/catalogue/registry.h"
#include "integrate/rule/slopes.h"

#include <fmt/format.h>

namespace gonio {
namespace {

constexpr double pi = std::numbers::pi;

/// A part of a model that is integrated by itself: a lobe with its widths, or all diffuse terms.
struct Part {
  BoundModel model;
  std::array<double, 2> widths{};  ///< of a lobe
  bool diffuse = false;
  bool may_be_lobe = false;  ///< a function of a file, whose highlight may be narrow
};

/// One channel is enough where all are equal, also what a file computes of them.
BoundModel without_equal_channels(BoundModel b) {
  const auto differs = [](const TermUse& t) { return term_of_channel(t.term, 1) != t.term; };
  if (std::ranges::any_of(b.model.diffuse, differs) ||
      std::ranges::any_of(b.model.lobes, [&](const auto& l) { return differs(l.fresnel); }))
    return b;
  for (const auto& p : b.model.parameters)
    for (std::size_t c = 1; c < p.count; ++c)
      if (b.values[p.first + c] != b.values[p.first]) return b;
  b.model.channels = 1;
  return b;
}

bool reads_frame(const std::vector<TermUse>& terms) {
  return std::ranges::any_of(terms,
                             [](const TermUse& t) { return catalogue()[t.term].anisotropic; });
}

std::vector<Part> parts_of(const BoundModel& whole) {
  std::vector<Part> parts;
  for (const auto& lobe : whole.model.lobes) {
    Part p{whole};
    p.model.model.diffuse.clear();
    p.model.model.lobes = {lobe};
    p.widths = slope_widths(lobe.ndf.term, term_parameters(whole, lobe.ndf, 0));
    p.model.model.anisotropic = reads_frame({lobe.ndf, lobe.masking, lobe.fresnel});
    parts.push_back(std::move(p));
  }
  if (!whole.model.diffuse.empty()) {
    Part p{whole};
    p.diffuse = true;
    const auto& terms = whole.model.diffuse;
    p.may_be_lobe = terms.size() == 1 && foreign_term(terms[0].term);
    if (p.may_be_lobe) p.model.model.lobes.clear();  // it is coupled to none
    p.model.model.anisotropic =
        reads_frame(whole.model.diffuse) ||
        (!whole.model.lobes.empty() && reads_frame({whole.model.lobes.front().fresnel}));
    parts.push_back(std::move(p));
  }
  return parts;
}

/// v: its cosine and sine, and its azimuth.
struct View {
  double mu, sine, cos_phi, sin_phi;
  View(double cosine, double phi)
      : mu(cosine),
        sine(std::sqrt((1 - cosine) * (1 + cosine))),
        cos_phi(std::cos(phi)),
        sin_phi(std::sin(phi)) {}
};

void put_frame(
    std::span<double* const> c, std::size_t i, double xoh, double yoh, double voh, const View& v) {
  const double xov = v.sine * v.cos_phi, yov = v.sine * v.sin_phi;
  const double values[] = {xoh, yoh, 2 * voh * xoh - xov, 2 * voh * yoh - yov, xov, yov};
  for (std::size_t k = 0; k < 6; ++k) c[5 + k][i] = values[k];
}

/// The rays ψ of one v in sectors: y in [i, i + 1] is sector i, that many radians from a line towards the
/// middle between it and the next.  Across v's plane, at ψ = ψ₀ ± π/2, the horizon is reached at once on
/// one side and late on the other; along the smaller width of an anisotropic lobe, late as well.  Rays are
/// graded towards these lines.  An isotropic lobe needs the sectors of one side.
class Rays {
 public:
  Rays(const View& v, const std::array<double, 2>& widths, bool anisotropic)
      : v_(v),
        widths_(widths),
        reach_(std::hypot(widths[0] * v.cos_phi, widths[1] * v.sin_phi)),
        psi0_(std::atan2(widths[1] * v.sin_phi, widths[0] * v.cos_phi)) {
    struct Line {
      double psi, layer;  ///< the angle within which things change there
    };
    const double across = std::hypot(widths[0] * std::sin(psi0_), widths[1] * std::cos(psi0_));
    const double layer = across * v.mu / std::max(v.sine * reach_, 1e-300);
    if (!anisotropic) {
      for (const double sign : {-1.0, 1.0}) add(psi0_ + pi / 2, sign * pi / 2, layer);
      return;
    }
    std::vector<Line> lines{{psi0_ - pi / 2, layer}, {psi0_ + pi / 2, layer}};
    const double ratio = std::min(widths[0], widths[1]) / std::max(widths[0], widths[1]);
    if (ratio < 0.5) {
      const double axis = widths[0] < widths[1] ? 0 : pi / 2;
      // within [ψ₀ − π/2, ψ₀ + 3π/2)
      double first = axis;
      while (first < lines[0].psi) first += pi;
      while (first >= lines[1].psi) first -= pi;
      lines = {lines[0], {first, ratio}, lines[1], {first + pi, ratio}};
    }
    lines.push_back({lines[0].psi + 2 * pi, lines[0].layer});
    for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
      const double half = (lines[i + 1].psi - lines[i].psi) / 2;
      if (half < 1e-9) continue;  // two that are one
      add(lines[i].psi, half, lines[i].layer);
      add(lines[i + 1].psi, -half, lines[i + 1].layer);
    }
  }
  std::size_t sectors() const { return sectors_.size(); }

  struct Ray {
    double c;           ///< of p = ρ d: p·e_v = ρ A cos(ψ − ψ₀) = ρ c
    double dx, dy, d2;  ///< d and |d|²
    double horizon;     ///< largest ρ
    double behind;      ///< 1/(d² ρ_max): the ray backwards
    double dpsi_dy;
  };
  Ray operator()(double y) const {
    const auto i = static_cast<std::size_t>(y);
    const auto& sector = sectors_[i];
    const double u = y - static_cast<double>(i);
    const double psi = sector.psi + sector.scale * std::sinh(sector.grading * u);
    Ray r;
    r.c = reach_ * std::cos(psi - psi0_);
    r.dx = widths_[0] * std::cos(psi);
    r.dy = widths_[1] * std::sin(psi);
    r.d2 = r.dx * r.dx + r.dy * r.dy;
    // d² ρ² − 2 k ρ − 1 = 0
    const double k = v_.sine / v_.mu * r.c, root = std::hypot(k, std::sqrt(r.d2));
    r.horizon = k > 0 ? (k + root) / r.d2 : 1 / (root - k);
    r.behind = 1 / (r.d2 * r.horizon);
    r.dpsi_dy = std::abs(sector.scale) * sector.grading * std::cosh(sector.grading * u);
    return r;
  }

 private:
  struct Sector {
    double psi, scale, grading;
  };
  void add(double psi, double length, double layer) {
    const double grading = std::max(std::asinh(std::abs(length) / std::max(layer, 1e-300)), 0.01);
    sectors_.push_back({psi, length / std::sinh(grading), grading});
  }

  View v_;
  std::array<double, 2> widths_;
  double reach_, psi0_;
  std::vector<Sector> sectors_;
};

/// x in [0, 1] is the lobe's core, s from 0 to about core_end; x in [1, 2] its tail up to the horizon S, s =
/// S − (S − s₁)(2 − x)³.
constexpr double core_end = 2.5;
constexpr double radial[] = {0, 1, 1.5, 2};

/// Light's direction at a place of the integral: cosines, the half vector in the tangent frame, and what the integrand is
/// times there.
struct Light {
  double nol, noh, voh, sin2_theta_h;
  double xoh, yoh;
  double weight;
};

/// Integral over rectangles of a chart of the hemisphere.
/// \param chart   chart(y)(x) is the Light there
/// \param values  values(block, weight, out) writes those of each channel, times the weight
template <class Chart, class Values>
Integral integrate_over(const Model& m,
                        const View& v,
                        const std::vector<Rectangle>& rectangles,
                        const Goal& goal,
                        Chart chart,
                        Values values) {
  AngleBlock block(m.anisotropic);
  std::vector<double> weight;
  const auto f = [&](std::span<const double> x, std::span<const double> y,
                     std::span<double* const> out) {
    const auto c = block.resize(x.size());
    weight.resize(x.size());
    for (std::size_t line = 0; line < y.size(); ++line) {
      const auto along = chart(y[line]);
      for (std::size_t k = 0; k < line_nodes; ++k) {
        const std::size_t i = line * line_nodes + k;
        const Light l = along(x[i]);
        c[0][i] = std::min(l.nol, 1.0);
        c[1][i] = v.mu;
        c[2][i] = l.noh;
        c[3][i] = std::min(l.voh, 1.0);
        c[4][i] = l.sin2_theta_h;
        if (m.anisotropic) put_frame(c, i, l.xoh, l.yoh, l.voh, v);
        weight[i] = l.weight;
      }
    }
    values(block, weight, out);
  };
  return integrate(f, m.channels, rectangles, goal);
}

Integral lobe_part(const Part& part, const View& v, const Goal& goal) {
  const Model& m = part.model.model;
  const Rays rays(v, part.widths, m.anisotropic);
  const double sides = m.anisotropic ? 1 : 2;
  const auto chart = [&](double y) {
    const auto r = rays(y);
    const double end = std::asinh(r.horizon);
    const double core = end * core_end / (end + core_end);
    const double scale = 4 * sides * part.widths[0] * part.widths[1] * r.dpsi_dy;
    return [=, &v](double x) -> Light {
      const double left = 2 - x;
      const bool tail = x > 1;
      const double at = tail ? end - (end - core) * left * left * left : core * x;
      const double ds_dx = tail ? 3 * (end - core) * left * left : core;
      const double e = std::exp(at), rho = (e - 1 / e) / 2, cosh = (e + 1 / e) / 2;
      const double t2 = rho * rho * r.d2, noh2 = 1 / (1 + t2), noh = std::sqrt(noh2);
      const double voh = noh * (v.mu + v.sine * r.c * rho);
      const double nol =
          std::max(v.mu * r.d2 * (r.horizon - rho) * (rho + r.behind) * noh2, 1e-300);
      return {nol,
              noh,
              voh,
              t2 * noh2,
              rho * r.dx * noh,
              rho * r.dy * noh,
              scale * ds_dx * voh * nol * noh2 * noh * rho * cosh};
    };
  };
  std::vector<double*> columns(m.channels);
  const auto values = [&](AngleBlock& block, const std::vector<double>& weight,
                          std::span<double* const> out) {
    for (std::size_t k = 0; k < m.channels; ++k) columns[k] = block.extra(k);
    evaluate<double>(m, part.model.values, block.block(), columns);
    for (std::size_t k = 0; k < m.channels; ++k)
      for (std::size_t i = 0; i < weight.size(); ++i) out[k][i] = columns[k][i] * weight[i];
  };
  std::vector<Rectangle> rectangles;
  for (std::size_t q = 0; q < rays.sectors(); ++q)
    for (std::size_t k = 0; k < 3; ++k)
      rectangles.push_back(
          {{radial[k], static_cast<double>(q)}, {radial[k + 1], static_cast<double>(q + 1)}});
  return integrate_over(m, v, rectangles, goal, chart, values);
}

/// x is θ_l, y its azimuth from v's.  Apart at θ_l = θ_v and a quarter turn from v, where Oren and Nayar's have kinks.
Integral diffuse_part(const Part& part, const View& v, const Goal& goal) {
  const Model& m = part.model.model;
  const double sides = m.anisotropic ? 1 : 2;
  const auto chart = [&](double y) {
    return [&v, sides, cos_y = std::cos(y), sin_y = std::sin(y)](double x) -> Light {
      const double nol = std::cos(x), sine = std::sin(x);
      // |l + v|² = 2 + 2 l·v, by its components: l·v may be −1
      const double along = sine * cos_y + v.sine, across = sine * sin_y, up = nol + v.mu;
      const double in_plane2 = along * along + across * across, length2 = in_plane2 + up * up;
      const double length = std::sqrt(length2);
      return {nol,
              up / length,
              length / 2,
              in_plane2 / length2,
              (along * v.cos_phi - across * v.sin_phi) / length,
              (along * v.sin_phi + across * v.cos_phi) / length,
              sides * nol * sine};
    };
  };
  const auto values = [&](AngleBlock& block, const std::vector<double>& weight,
                          std::span<double* const> out) {
    const auto b = block.block();
    double *const value = block.extra(0), *const fresnel = block.extra(1);
    for (std::size_t channel = 0; channel < m.channels; ++channel) {
      std::fill_n(out[channel], weight.size(), 0.0);
      const bool coupled = std::ranges::any_of(
          m.diffuse, [](const TermUse& t) { return catalogue()[t.term].coupled; });
      if (coupled) {
        const auto& t = m.lobes.front().fresnel;
        term_values(term_of_channel(t.term, channel), term_parameters(part.model, t, channel), b,
                    fresnel);
      }
      for (const auto& t : m.diffuse) {
        term_values(term_of_channel(t.term, channel), term_parameters(part.model, t, channel), b,
                    value);
        for (std::size_t i = 0; i < weight.size(); ++i)
          out[channel][i] +=
              weight[i] * value[i] * (catalogue()[t.term].coupled ? 1 - fresnel[i] : 1);
      }
    }
  };
  const int quarters = m.anisotropic ? 4 : 2;
  std::vector<Rectangle> rectangles;
  rectangles.reserve(2 * static_cast<std::size_t>(quarters));
  const double theta_v = std::atan2(v.sine, v.mu);
  for (int q = 0; q < quarters; ++q)
    for (const auto& [from, to] : {std::pair{0.0, theta_v}, {theta_v, pi / 2}})
      if (from < to) rectangles.push_back({{from, q * pi / 2}, {to, (q + 1) * pi / 2}});
  return integrate_over(m, v, rectangles, goal, chart, values);
}

/// The widths of a highlight about the mirror direction of v: 1.5 times the slope of the half vector at which the value has fallen half
/// way to its least.  None where the value has no peak there, or a wide one.
std::optional<std::array<double, 2>> highlight_widths(const Part& part, const View& v) {
  constexpr std::size_t steps = 57;  // 8 a decade, from 1e-7
  constexpr double widest = 0.3;
  const Model& m = part.model.model;
  std::array<double, 2> widths{1, 1};
  AngleBlock x(m.anisotropic);
  std::vector<double*> columns(m.channels);
  for (std::size_t axis = 0; axis < 2; ++axis) {
    // Across v's plane where the surface may be turned; otherwise along each of its axes.
    const std::array along = !m.anisotropic ? std::array{-v.sin_phi, v.cos_phi}
                             : axis == 0    ? std::array{1.0, 0.0}
                                            : std::array{0.0, 1.0};
    const auto c = x.resize(steps);
    std::vector<double> slopes;
    for (std::size_t k = 0; k < steps; ++k) {
      const double t = std::pow(10, static_cast<double>(k) / 8 - 7);
      const double noh = 1 / std::sqrt(1 + t * t);
      const double xoh = t * noh * along[0], yoh = t * noh * along[1];
      const double voh = v.mu * noh + v.sine * (v.cos_phi * xoh + v.sin_phi * yoh);
      const double nol = 2 * voh * noh - v.mu;
      if (nol > 0 && voh > 0) slopes.push_back(t);
      c[0][k] = nol > 0 ? std::min(nol, 1.0) : 0.5;
      c[1][k] = v.mu;
      c[2][k] = noh;
      c[3][k] = std::clamp(voh, 0.0, 1.0);
      c[4][k] = t * t * noh * noh;
      if (m.anisotropic) put_frame(c, k, xoh, yoh, voh, v);
    }
    for (std::size_t k = 0; k < m.channels; ++k) columns[k] = x.extra(k);
    evaluate<double>(m, part.model.values, x.block(), columns);
    // Those above the horizon stand first.
    std::vector<double> f(slopes.size());
    for (std::size_t k = 0; k < f.size(); ++k)
      for (const double* const of : columns) f[k] += of[k];
    if (f.empty()) continue;
    const double least = *std::ranges::min_element(f);
    const auto half = std::ranges::find_if(f, [&](double y) { return y < (f[0] + least) / 2; });
    if (f[0] > 1.5 * std::max(least, 0.0) && half != f.end())
      widths[axis] =
          std::clamp(1.5 * slopes[static_cast<std::size_t>(half - f.begin())], 1e-6, 1.0);
    if (!m.anisotropic) {
      widths[1] = widths[0];
      break;
    }
  }
  if (std::min(widths[0], widths[1]) > widest) return {};
  return widths;
}

Integral part_of_albedo(const Part& part, const View& v, const Goal& goal) {
  if (!part.diffuse) return lobe_part(part, v, goal);
  if (part.may_be_lobe)
    if (const auto widths = highlight_widths(part, v)) {
      Part lobe = part;
      lobe.widths = *widths;
      return lobe_part(lobe, v, goal);
    }
  return diffuse_part(part, v, goal);
}

Albedo albedo_of(
    const std::vector<Part>& parts, std::size_t channels, double mu, double phi, const Goal& goal) {
  Albedo a{std::vector<double>(channels), 0, 0};
  const View v(mu, phi);
  const std::size_t n = std::max<std::size_t>(parts.size(), 1);
  const Goal each{goal.error / static_cast<double>(n), goal.evaluations / n};
  for (const auto& p : parts) {
    const auto i = part_of_albedo(p, v, each);
    for (std::size_t c = 0; c < channels; ++c) a.value[c] += i.value[c < i.value.size() ? c : 0];
    a.error += i.error;
    a.evaluations += i.evaluations;
  }
  return a;
}

std::vector<Albedo> albedos_of(const std::vector<Part>& parts,
                               std::size_t channels,
                               std::span<const double> mu,
                               double phi,
                               const Goal& goal) {
  check_cosines(mu);
  check_azimuth(phi);
  std::vector<Albedo> all(mu.size());
  for_each_whole(mu.size(),
                 [&](std::size_t i) { all[i] = albedo_of(parts, channels, mu[i], phi, goal); });
  return all;
}

}  // namespace

void check_cosines(std::span<const double> mu) {
  for (const double m : mu)
    if (!(0 < m && m <= 1))
      throw wrong_usage(fmt::format("mu = {} is outside (0, 1]: the cosine of a zenith angle", m));
}

void check_azimuth(double phi) {
  if (!std::isfinite(phi)) throw wrong_usage(fmt::format("phi = {} is no azimuth", phi));
}

std::vector<Albedo> directional_albedo(const BoundModel& model,
                                       std::span<const double> mu,
                                       double phi,
                                       const Goal& goal) {
  return albedos_of(parts_of(without_equal_channels(model)), model.model.channels, mu, phi, goal);
}

std::vector<Albedo> diffuse_albedo(const BoundModel& model,
                                   std::span<const double> mu,
                                   double phi,
                                   const Goal& goal) {
  auto parts = parts_of(without_equal_channels(model));
  std::erase_if(parts, [](const Part& p) { return !p.diffuse; });
  return albedos_of(parts, model.model.channels, mu, phi, goal);
}

Albedo hemispherical_albedo(const BoundModel& model, const Goal& goal) {
  const auto parts = parts_of(without_equal_channels(model));
  const std::size_t channels = model.model.channels;
  return hemispherical_average(
      [&](double mu, double phi, const Goal& each) {
        return albedo_of(parts, channels, mu, phi, each);
      },
      channels, model.model.anisotropic, goal);
}

Albedo hemispherical_average(const AlbedoAt& albedo,
                             std::size_t channels,
                             bool anisotropic,
                             const Goal& goal) {
  // μ = q²: E may rise from the horizon as μ ln μ.
  const std::size_t most = 20 * goal.evaluations;
  double inner = 0;
  std::size_t evaluations = 0;
  const auto f = [&](std::span<const double> x, std::span<const double> y,
                     std::span<double* const> out) {
    std::vector<Albedo> at(x.size());
    // Where albedos cannot be had to that error, as of models that diverge, there is an end to it.
    const std::size_t left = most > evaluations ? most - evaluations : 0;
    const Goal each{goal.error / 4, std::min(goal.evaluations, left / x.size())};
    for_each_whole(x.size(),
                   [&](std::size_t i) { at[i] = albedo(x[i] * x[i], y[i / line_nodes], each); });
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double weight = 4 * x[i] * x[i] * x[i] / (anisotropic ? std::numbers::pi / 2 : 1);
      for (std::size_t c = 0; c < channels; ++c) out[c][i] = at[i].value[c] * weight;
      inner = std::max(inner, at[i].error);
      evaluations += at[i].evaluations;
    }
  };
  const Rectangle all{{0, 0}, {1, anisotropic ? std::numbers::pi / 2 : 0}};
  const auto i = integrate(f, channels, {all}, {goal.error / 2, 4000});
  Albedo average{i.value, i.error + inner, evaluations};
  const double infinity = std::numeric_limits<double>::infinity();
  if (average.error > std::max(1.0, *std::ranges::max_element(average.value)))
    average = {std::vector<double>(channels, infinity), infinity, evaluations};
  return average;
}

BoundModel furnace(const BoundModel& model) {
  BoundModel white = model;
  const std::size_t schlick = find_term("fresnel.schlick");
  TermUse one{schlick, {}};
  for (const auto& p : catalogue()[schlick].parameters) {
    one.parameters.push_back(white.model.parameters.size());
    white.model.parameters.push_back({"white_" + std::string(p.name), &p, white.values.size(), 1});
    white.values.push_back(1);
  }
  white.model.value_count = white.values.size();
  for (auto& lobe : white.model.lobes) lobe.fresnel = one;
  return white;
}

}  // namespace gonio
