#include "table/format/rgl/material.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>
#include <utility>

namespace gonio::rgl {
namespace {

using std::numbers::pi;

/// Cosine of θ_o = 70°, under which values between samples are held within the samples' span.
constexpr double guarded_cosine = 0.3420201433256687;

struct Between {
  std::shared_ptr<const Material> material;
  double operator()(const DirectionPair& p, std::size_t channel) const {
    return material->at(p, channel, true);
  }
};

}  // namespace

Direction direction_at(const Point& u) {
  return direction(u.x * u.x * pi / 2, (2 * u.y - 1) * pi);
}
Direction reflected(const Direction& wi, const Direction& m) {
  const double twice = 2 * dot(wi, m);
  return {twice * m.x - wi.x, twice * m.y - wi.y, twice * m.z - wi.z};
}

Material::Material(Fields f, int parts)
    : theta_i(std::move(f.theta_i)),
      phi_i(std::move(f.phi_i)),
      symmetry(parts),
      channels(std::move(f.channels)),
      spectral(f.spectral),
      has_jacobian(f.jacobian),
      ndf(std::move(f.ndf)),
      sigma(std::move(f.sigma)),
      data(std::move(f.data)),
      invented(std::move(f.invented)),
      warp_(std::move(f.vndf), phi_i.size() * theta_i.size()) {
  scale_ = {width(), height(), {}};
  scale_.nodes.reserve(phi_i.size() * theta_i.size() * width() * height());
  for (std::size_t p = 0; p < phi_i.size(); ++p)
    for (std::size_t t = 0; t < theta_i.size(); ++t)
      for (std::size_t y = 0; y < height(); ++y)
        for (std::size_t x = 0; x < width(); ++x)
          scale_.nodes.push_back(
              static_cast<float>(scale_at(sample(p, t, x, y), theta_i[t], scale_.nodes.size())));
}

Material::Sample Material::sample(std::size_t p,
                                  std::size_t t,
                                  std::size_t x,
                                  std::size_t y) const {
  const Point s{static_cast<double>(x) / static_cast<double>(width() - 1),
                static_cast<double>(y) / static_cast<double>(height() - 1)};
  const Point u = warp_.sample(p * theta_i.size() + t, s);
  const Direction wi = direction(theta_i[t], isotropic() ? 0 : phi_i[p]);
  return {{wi, reflected(wi, direction_at(u))}, u};
}

void Material::values(std::size_t p,
                      std::size_t t,
                      std::size_t x,
                      std::size_t y,
                      const Sample& s,
                      std::vector<Values>& to) const {
  const std::size_t slice = p * theta_i.size() + t;
  const double scale = scale_at(s, theta_i[t], (slice * height() + y) * width() + x);
  // The pole of the facets is a grid point in every row: the sample is their mean.
  const std::size_t rows = x == 0 ? height() - 1 : 1;
  for (std::size_t c = 0; c < to.size(); ++c) {
    const float* const nodes = data.slice(slice * to.size() + c);
    double sum = 0;
    for (std::size_t k = y; k < y + rows; ++k) sum += static_cast<double>(nodes[k * width() + x]);
    to[c].push_back(sum / static_cast<double>(rows) * scale);
  }
}

double Material::at(DirectionPair p, std::size_t channel, bool guard) const {
  if (!(p.wi.z > 0 && p.wo.z > 0)) return std::nan("");
  if (guard && (p.wo.z < least_cosine || theta_of(p.wi) > theta_i.back() + 1e-6))
    return std::nan("");
  fold(p);
  const double azimuth = isotropic() ? phi_i[0] : phi_of(p.wi);
  const Direction h{p.wi.x + p.wo.x, p.wi.y + p.wo.y, p.wi.z + p.wo.z};
  const double turns = (phi_of(h) - (isotropic() ? phi_of(p.wi) : 0)) / (2 * pi) + 0.5;
  const Point u{std::sqrt(2 / pi * theta_of(h)), turns - std::floor(turns)};
  const Mix mix = mixed(azimuth, theta_of(p.wi));
  const Point s = warp_.invert(mix, u);
  double value = 0;
  for (std::size_t k = 0; k < mix.slice.size(); ++k)
    if (mix.weight[k] != 0)
      value += mix.weight[k] * data(s, mix.slice[k] * channels.size() + channel);
  const double f = value * jacobian(u, theta_of(p.wi), phi_of(p.wi)) / p.wo.z;
  return guard ? guarded(f, mix, s, p.wo.z, channel) : f;
}

double Material::jacobian(const Point& u, double theta, double phi) const {
  if (!has_jacobian) return 1;
  return ndf(u) / (4 * sigma({std::sqrt(2 / pi * theta), phi / (2 * pi) + 0.5}));
}

/// f_r over the value stored, at a grid point; NaN where that says nothing, or was made up.
double Material::scale_at(const Sample& s, double theta, std::size_t node) const {
  if (!invented.empty() && invented[node] != 0) return std::nan("");
  return s.pair.wi.z > horizon_cosine && s.pair.wo.z >= least_cosine
             ? jacobian(s.u, theta, phi_of(s.pair.wi)) / s.pair.wo.z
             : std::nan("");
}
/// The value f at s, held within the span of the valid grid points around: near the horizon the
/// cosine divided out is not that of what is interpolated.  Away from it f stays as it is, unless a
/// grid point has none.
double Material::guarded(
    double f, const Mix& mix, const Point& s, double cos_o, std::size_t channel) const {
  const Cell cell(s, width(), height());
  double valid = 0, low = std::numeric_limits<double>::infinity(), high = -low;
  bool near_horizon = cos_o < guarded_cosine;
  for (std::size_t k = 0; k < mix.slice.size(); ++k)
    for (const auto& [x, y, part] : cell.corners()) {
      const std::size_t node = y * width() + x;
      const double scale = static_cast<double>(scale_.slice(mix.slice[k])[node]);
      const double weight = mix.weight[k] * part;
      if (weight == 0) continue;
      if (std::isnan(scale)) {
        near_horizon = true;
        continue;
      }
      const float* const nodes = data.slice(mix.slice[k] * channels.size() + channel);
      low = std::min(low, static_cast<double>(nodes[node]) * scale);
      high = std::max(high, static_cast<double>(nodes[node]) * scale);
      valid += weight;
    }
  if (!near_horizon) return f;
  return valid > 0.5 ? std::clamp(f, low, high) : std::nan("");
}
/// Into the part of the turn that the file holds.
void Material::fold(DirectionPair& p) const {
  if (symmetry == 1) return;
  const auto outside = [&](const Direction& d) {
    const double phi = phi_of(d);
    double distance = 2 * pi;
    for (const double turned : {phi - 2 * pi, phi, phi + 2 * pi})
      distance = std::min(distance, std::max({phi_i.front() - turned, turned - phi_i.back(), 0.0}));
    return distance;
  };
  const auto mirrored = [](const Direction& d, double x, double y) {
    return Direction{x * d.x, y * d.y, d.z};
  };
  std::array<double, 2> best{1, 1};
  for (const auto& [x, y] : {std::array{-1.0, -1.0}, std::array{-1.0, 1.0}, std::array{1.0, -1.0}})
    if ((symmetry == 4 || x == y) &&
        outside(mirrored(p.wi, x, y)) < outside(mirrored(p.wi, best[0], best[1])))
      best = {x, y};
  p = {mirrored(p.wi, best[0], best[1]), mirrored(p.wo, best[0], best[1])};
}

Mix Material::mixed(double phi, double theta) const {
  const auto place = [](const std::vector<double>& axis, double at) {
    if (axis.size() < 2) return std::pair{std::size_t{0}, 0.0};
    const auto above = std::ranges::upper_bound(axis, at) - axis.begin();
    const std::size_t i =
        std::clamp<std::size_t>(static_cast<std::size_t>(above), 1, axis.size() - 1) - 1;
    return std::pair{i, std::clamp((at - axis[i]) / (axis[i + 1] - axis[i]), 0.0, 1.0)};
  };
  while (phi < phi_i.front() - 1e-9) phi += 2 * pi;
  while (phi > phi_i.back() + 1e-9 && phi - 2 * pi >= phi_i.front()) phi -= 2 * pi;
  const auto [p, part_p] = isotropic() ? std::pair{std::size_t{0}, 0.0} : place(phi_i, phi);
  const auto [t, part_t] = place(theta_i, theta);
  const std::size_t p1 = part_p > 0 ? p + 1 : p, t1 = part_t > 0 ? t + 1 : t, n = theta_i.size();
  return {
      {p * n + t, p * n + t1, p1 * n + t, p1 * n + t1},
      {(1 - part_p) * (1 - part_t), (1 - part_p) * part_t, part_p * (1 - part_t), part_p * part_t}};
}

Table table_of(std::shared_ptr<const Material> material) {
  const Material& m = *material;
  Table t;
  t.format = "rgl";
  t.channels = m.channels;
  t.values.resize(m.channels.size());
  const std::size_t phis = m.isotropic() ? 1 : m.phi_i.size();
  const bool closed = !m.isotropic() && m.symmetry == 1;
  DirectionList l;
  for (std::size_t p = 0; p < phis; ++p)
    for (std::size_t k = 0; k < m.theta_i.size(); ++k) {
      // One direction under several names: the pole under every φ_i, and the two ends of a full
      // turn.
      if (p > 0 && (m.theta_i[k] == 0 || (closed && p + 1 == phis))) continue;
      for (std::size_t y = 0; y + 1 < m.height(); ++y)
        for (std::size_t x = y == 0 ? 0 : 1; x < m.width(); ++x) {
          const Material::Sample s = m.sample(p, k, x, y);
          const auto& [wi, wo] = s.pair;
          l.theta_i_deg.push_back(theta_of(wi) / degree);
          l.phi_i_deg.push_back(phi_of(wi) / degree);
          l.theta_o_deg.push_back(theta_of(wo) / degree);
          l.phi_o_deg.push_back(phi_of(wo) / degree);
          m.values(p, k, x, y, s, t.values);
        }
    }
  t.where = std::move(l);
  t.between = Between{std::move(material)};
  return t;
}

std::shared_ptr<const Material> material_of(const Table& t) {
  const auto* const between = t.between.target<Between>();
  return between ? between->material : nullptr;
}

}  // namespace gonio::rgl
