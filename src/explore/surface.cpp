#include "explore/surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.h"
#include "base/text.h"
#include "image/display.h"
#include "integrate/albedo/directional_albedo.h"

#include <fmt/format.h>

namespace gonio::explore {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// The same width under the names that an isotropic and an anisotropic model have for it.
std::string other_width(std::string_view name) {
  for (const auto& [from, to] :
       {std::pair("alpha_x", "alpha"), {"alpha_y", "alpha"}, {"alpha", "alpha_x"}})
    if (name == from) return to;
  return "";
}

const ModelParameter* source_of(const Model& before, const std::string& name) {
  if (const auto* same = before.find(name)) return same;
  return before.find(other_width(name));
}

/// Bytes of numbers in [0, 1] by a table of 4096: a power for each pixel would take longer than the model.
unsigned char quick_byte(double linear) {
  static const auto bytes = [] {
    std::array<unsigned char, 4097> b{};
    for (std::size_t i = 0; i < b.size(); ++i) b[i] = srgb_byte(static_cast<double>(i) / 4096);
    return b;
  }();
  return bytes[static_cast<std::size_t>(std::clamp(linear, 0.0, 1.0) * 4096 + 0.5)];
}

/// The table that a model is compared with.
const Table* compared(const Surface& model, const Surface& table) {
  const Table* const t = table.table();
  if (!model.model() || !t || model.channels() != t->values.size())
    throw wrong_usage("a model is compared with a table of as many channels");
  return t;
}
std::vector<DirectionPair> sample_directions(const Table& t) {
  const SampleAngles where(t);
  std::vector<DirectionPair> at(t.size());
  for (std::size_t i = 0; i < at.size(); ++i) at[i] = where.directions(i);
  return at;
}

}  // namespace

Grid page_grid(const std::array<std::size_t, 3>& sizes) {
  using std::numbers::pi;
  return {Grid::Kind::half_difference,
          {Axis{"theta_h", Axis::Spacing::quadratic, sizes[0], pi / 2},
           Axis{"theta_d", Axis::Spacing::uniform, sizes[1], pi / 2},
           Axis{"phi_d", Axis::Spacing::uniform, sizes[2], pi}},
          Bins::centre};
}

Surface::Surface(std::string_view spec,
                 std::string_view settings,
                 std::optional<std::size_t> channels)
    : what_(bind_model(
          spec,
          parse_settings(settings.empty() ? std::vector<std::string>{} : split(settings, ' ')),
          channels)) {}
Surface::Surface(Table t) : what_(std::move(t)) {}

std::size_t Surface::channels() const {
  const auto* m = model();
  return m ? m->model.channels : table()->values.size();
}

Channels Surface::operator()(std::span<const DirectionPair> at) const {
  if (const auto* m = model()) {
    std::vector<FrameAngles<double>> angles;
    angles.reserve(at.size());
    for (const auto& p : at) angles.push_back(frame_angles(p));
    return evaluate(*m, angles);
  }
  const Table& t = *table();
  const Interpolator between(t);
  Channels f(t.values.size(), std::vector<double>(at.size()));
  for (std::size_t i = 0; i < at.size(); ++i)
    for (std::size_t c = 0; c < f.size(); ++c)
      f[c][i] = at[i].wi.z > horizon_cosine && at[i].wo.z > horizon_cosine ? between(at[i], c) : 0;
  return f;
}

void Surface::swap_model(std::string_view spec) {
  auto* m = model();
  if (!m) throw wrong_usage("a table has no terms to swap");
  BoundModel next = bind_model(spec, {}, m->model.channels);
  for (const auto& p : next.model.parameters) {
    const auto* old = source_of(m->model, p.name);
    if (!old || old->count != p.count) continue;
    for (std::size_t i = 0; i < p.count; ++i)
      if (const double v = m->values[old->first + i]; p.about->legal.holds(v))
        next.values[p.first + i] = v;
  }
  *m = std::move(next);
}

Channels cut(const Surface& s,
             double theta_i_deg,
             double phi_i_deg,
             std::span<const double> theta_o_deg) {
  std::vector<DirectionPair> at;
  at.reserve(theta_o_deg.size());
  const Direction wi = direction(theta_i_deg * degree, phi_i_deg * degree);
  for (const double t : theta_o_deg)
    at.push_back(
        {wi, direction(std::abs(t) * degree, (t < 0 ? phi_i_deg : phi_i_deg + 180) * degree)});
  return s(at);
}

Channels lobe(const Surface& s,
              double theta_i_deg,
              double phi_i_deg,
              std::span<const double> theta_o_deg,
              std::span<const double> phi_deg) {
  std::vector<DirectionPair> at;
  at.reserve(theta_o_deg.size() * phi_deg.size());
  const Direction wi = direction(theta_i_deg * degree, phi_i_deg * degree);
  for (const double t : theta_o_deg)
    for (const double p : phi_deg)
      at.push_back({wi, direction(t * degree, (phi_i_deg + 180 + p) * degree)});
  return s(at);
}

DirectionPair slice_directions(std::size_t size, std::size_t cell, double phi_d_deg) {
  const auto middle = [&](std::size_t k) {
    return (static_cast<double>(k) + 0.5) / static_cast<double>(size) * 90 * degree;
  };
  return directions({middle(cell % size), 0, middle(size - 1 - cell / size), phi_d_deg * degree});
}

Channels slice(const Surface& s, std::size_t size, double phi_d_deg) {
  std::vector<DirectionPair> at;
  at.reserve(size * size);
  for (std::size_t i = 0; i < size * size; ++i) at.push_back(slice_directions(size, i, phi_d_deg));
  Channels f = s(at);
  for (std::size_t i = 0; i < at.size(); ++i)
    if (!(at[i].wi.z > horizon_cosine && at[i].wo.z > horizon_cosine))
      for (auto& channel : f) channel[i] = none;
  return f;
}

void paint(const Channels& f, double exposure, bool logarithmic, std::span<unsigned char> rgba) {
  constexpr double decades = 4;
  for (std::size_t i = 0; 4 * i < rgba.size(); ++i) {
    bool known = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const double v = f[f.size() == 3 ? k : 0][i] * exposure;
      known &= !std::isnan(v);
      // Steps of the logarithm are to look alike: they are shares of the byte, not of the light.
      rgba[4 * i + k] =
          !known        ? 0
          : logarithmic ? static_cast<unsigned char>(
                              std::lround(255 * std::clamp(1 + std::log10(v) / decades, 0.0, 1.0)))
                        : quick_byte(v);
    }
    rgba[4 * i + 3] = known ? 255 : 0;
  }
}

Difference difference(const Surface& model, const Surface& table) {
  const Table* const t = compared(model, table);
  const auto at = sample_directions(*t);
  const Channels f = model(at);
  Difference d{0, 1, 1, none, none, {}};
  std::array<std::size_t, Difference::cells * Difference::cells> known{};
  double squares = 0;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const auto hd = half_difference(at[i]);
    const auto place = [](double angle) {
      return std::min(static_cast<std::size_t>(angle / degree / 90 * Difference::cells),
                      Difference::cells - 1);
    };
    const std::size_t cell =
        (Difference::cells - 1 - place(hd.theta_d)) * Difference::cells + place(hd.theta_h);
    for (std::size_t c = 0; c < f.size(); ++c)
      if (const double y = t->values[c][i];
          mask(angles(at[i]), y) == Mask::valid && y > 0 && f[c][i] > 0) {
        const double off = std::log(f[c][i] / y);
        squares += off * off, ++d.values;
        d.log_ratio[cell] += off, ++known[cell];
      }
  }
  double worst = 0;
  for (std::size_t k = 0; k < known.size(); ++k) {
    d.log_ratio[k] = known[k] ? d.log_ratio[k] / static_cast<double>(known[k]) : none;
    if (!(std::abs(d.log_ratio[k]) >= std::abs(worst))) continue;
    worst = d.log_ratio[k];
    const auto middle = [](std::size_t i) {
      return (static_cast<double>(i) + 0.5) * 90 / Difference::cells;
    };
    d.worst_theta_h_deg = middle(k % Difference::cells);
    d.worst_theta_d_deg = middle(Difference::cells - 1 - k / Difference::cells);
  }
  if (d.values) d.typical_factor = std::exp(std::sqrt(squares / static_cast<double>(d.values)));
  d.worst_factor = std::exp(worst);
  return d;
}

std::array<std::vector<double>, 2> measured_and_modelled(const Surface& model,
                                                         const Surface& table,
                                                         std::size_t channel) {
  const Table* const t = compared(model, table);
  const auto at = sample_directions(*t);
  std::array<std::vector<double>, 2> both{std::vector<double>(at.size(), none),
                                          model(at).at(channel)};
  for (std::size_t i = 0; i < at.size(); ++i)
    if (const double y = t->values[channel][i]; mask(angles(at[i]), y) == Mask::valid)
      both[0][i] = y;
  return both;
}

void paint_ratio(const Difference& d, std::span<unsigned char> rgba) {
  constexpr std::array dark{27.0, 95.0, 168.0}, bright{194.0, 77.0, 10.0},
      even{245.0, 244.0, 240.0};
  for (std::size_t i = 0; i < d.log_ratio.size(); ++i) {
    const bool known = std::isfinite(d.log_ratio[i]);
    const double off = known ? std::clamp(d.log_ratio[i] / std::numbers::ln2, -1.0, 1.0) : 0;
    const auto& end = off < 0 ? dark : bright;
    for (std::size_t k = 0; k < 3; ++k)
      rgba[4 * i + k] =
          static_cast<unsigned char>(std::lround(even[k] + std::abs(off) * (end[k] - even[k])));
    rgba[4 * i + 3] = known ? 255 : 0;
  }
}

Channels albedo(const Surface& s, std::span<const double> theta_deg, bool with_furnace) {
  const auto* m = s.model();
  if (!m) throw wrong_usage("the albedo of a table is that of its samples");
  std::vector<double> mu;
  for (const double t : theta_deg) mu.push_back(std::cos(t * degree));
  Channels e(m->model.channels, std::vector<double>(mu.size(), none));
  BoundModel asked = *m;
  if (with_furnace) {
    if (m->model.lobes.empty()) return e;
    asked = furnace(asked);
    asked.model.diffuse.clear();
    asked.model.lobes.resize(1);
  }
  const auto all = directional_albedo(asked, mu, 0, {1e-3, 20'000});
  for (std::size_t i = 0; i < mu.size(); ++i)
    for (std::size_t c = 0; c < e.size(); ++c)
      e[c][i] = std::isfinite(all[i].value[c]) ? all[i].value[c] : none;
  return e;
}

}  // namespace gonio::explore
