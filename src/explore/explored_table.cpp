#include "explore/explored_table.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>

#include "base/base64.h"
#include "base/error.h"
#include "explore/surface.h"
#include "table/format/in_memory.h"
#include "table/health/directional_albedo.h"
#include "table/lookup.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <tbb/parallel_for.h>

namespace gonio {
namespace {

constexpr std::array<std::size_t, 3> explored_sizes{45, 30, 18};
constexpr double explored_reach = 10 * degree;
constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

/// Numbers as a page reads them: 32-bit floats, low byte first.
template <class Column>
std::string float_bytes(const std::vector<Column>& channels) {
  std::string bytes;
  bytes.reserve(4 * channels.size() * (channels.empty() ? 0 : channels[0].size()));
  for (const auto& channel : channels)
    for (const double v : channel) {
      const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(v));
      for (int k = 0; k < 32; k += 8) bytes += static_cast<char>(bits >> k & 0xFF);
    }
  return bytes;
}

/// One channel or three: the page's pictures have no others.
void keep_shown_channels(Table& t) {
  const std::size_t all = t.channels.size();
  if (all == 1 || all == 3) return;
  const std::vector<std::size_t> kept =
      all == 2 ? std::vector<std::size_t>{0} : std::vector<std::size_t>{0, all / 2, all - 1};
  const auto pick = [&](auto& list) {
    std::remove_reference_t<decltype(list)> some;
    for (const std::size_t k : kept) some.push_back(std::move(list[k]));
    list = std::move(some);
  };
  pick(t.channels), pick(t.values);
  if (t.between)
    t.between = [kept, of = std::move(t.between)](const DirectionPair& p, std::size_t c) {
      return of(p, kept[c]);
    };
}

/// A stride through a table that leaves about so many samples, and along no axis of a grid the same ones.
std::size_t stride(std::size_t samples, std::size_t most) {
  std::size_t step = 1 + (samples - 1) / most;
  while (std::gcd(step, samples) != 1) ++step;
  return step;
}

/// Mean of a table's own values in each cell of a grid over half and difference angles, for where it has none in between: it may
/// have many samples in a cell and yet none on either side of the cell's middle.
class MeansOfCells {
 public:
  MeansOfCells(const Table& t, const Grid& grid)
      : phis_(grid.axes[2].size), sums_(t.values.size()), counts_(grid.size()) {
    for (auto& s : sums_) s.assign(grid.size(), 0);
    const SampleAngles at(t);
    for (std::size_t i = 0; i < t.size(); ++i) {
      if (!std::ranges::all_of(t.values,
                               [&](const Values& v) { return mask(at(i), v[i]) == Mask::valid; }))
        continue;
      const auto hd = at.half_difference(i);
      // Reciprocal and isotropic: phi_d, −phi_d and π − phi_d are the same.
      const double phi = std::abs(std::remainder(hd.phi_d, std::numbers::pi));
      std::size_t cell = 0;
      for (const auto& [axis, angle] : {std::pair(0, hd.theta_h), {1, hd.theta_d}, {2, phi}}) {
        const Axis& a = grid.axes[static_cast<std::size_t>(axis)];
        cell = cell * a.size +
               static_cast<std::size_t>(std::clamp(std::round(a.index(angle, grid.bins)), 0.0,
                                                   static_cast<double>(a.size - 1)));
      }
      ++counts_[cell];
      for (std::size_t c = 0; c < sums_.size(); ++c) sums_[c][cell] += t.values[c][i];
    }
  }
  double operator()(std::size_t cell, std::size_t channel) const {
    const std::size_t phi = cell % phis_;
    cell = cell - phi + std::min(phi, phis_ - 1 - phi);
    return counts_[cell] ? sums_[channel][cell] / static_cast<double>(counts_[cell]) : no_value;
  }

 private:
  std::size_t phis_;
  std::vector<std::vector<double>> sums_;
  std::vector<std::size_t> counts_;
};

/// The table's values on the page's grid.
Table resampled_table(const Table& t) {
  Table grid;
  grid.path = t.path, grid.format = t.format, grid.channels = t.channels;
  grid.where = explore::page_grid(explored_sizes);
  grid.values.assign(t.values.size(), Values(grid.grid()->size(), no_value));
  const SampleAngles at(grid);
  const MeansOfCells means(t, *grid.grid());
  std::optional<Lookup> lookup;
  if (!t.between) lookup.emplace(t, explored_reach);
  tbb::parallel_for(std::size_t{0}, grid.size(), [&](std::size_t i) {
    const DirectionPair p = at.directions(i);
    if (!(p.wi.z > horizon_cosine && p.wo.z > horizon_cosine)) return;
    const GridCell cell = lookup ? (*lookup)(p) : GridCell{};
    for (std::size_t c = 0; c < grid.values.size(); ++c) {
      double v = lookup ? cell.mean_of(t.values[c]) : t.between(p, c);
      if (!(v >= 0)) v = means(i, c);
      if (v >= 0) grid.values[c][i] = v;
    }
  });
  return grid;
}

/// What resampling lost: fills in values, loss and covered.
void measure_loss(const Table& t, ExploredTable& e) {
  const SampleAngles at(t);
  const Interpolator between(e.grid);
  double squares = 0;
  std::size_t pairs = 0, found = 0;
  for (std::size_t i = 0; i < t.size(); ++i)
    for (const auto& channel : t.values) e.values += mask(at(i), channel[i]) == Mask::valid;
  if (e.values == 0)
    throw bad_input(t.path, "values", "none that is valid above the horizon", "at least one");
  std::size_t looked_at = 0;
  const std::size_t step = stride(t.size(), 200'000);  // enough for two digits
  for (std::size_t i = 0; i < t.size(); i += step) {
    const DirectionPair p = at.directions(i);
    for (std::size_t c = 0; c < t.values.size(); ++c) {
      const double y = t.values[c][i];
      if (mask(angles(p), y) != Mask::valid) continue;
      ++looked_at;
      const double v = between(p, c);
      if (!std::isfinite(v)) continue;
      ++found;
      if (!(v > 0 && y > 0)) continue;
      const double off = std::log(v / y);
      squares += off * off, ++pairs;
    }
  }
  e.covered = looked_at ? static_cast<double>(found) / static_cast<double>(looked_at) : 0;
  if (pairs) e.loss = std::exp(std::sqrt(squares / static_cast<double>(pairs)));
}

/// Valid samples, spread evenly over the table.
std::vector<std::vector<double>> some_samples(const Table& t) {
  const SampleAngles at(t);
  std::vector<std::vector<double>> columns(4 + t.values.size());
  const std::size_t step = stride(t.size(), most_explored_samples);
  for (std::size_t i = 0; i < t.size(); i += step) {
    const bool valid = std::ranges::all_of(
        t.values, [&](const Values& v) { return mask(at(i), v[i]) == Mask::valid; });
    if (!valid) continue;
    const auto deg = angles_deg(t, at, i);
    for (std::size_t k = 0; k < 4; ++k) columns[k].push_back(deg[k]);
    for (std::size_t c = 0; c < t.values.size(); ++c) columns[4 + c].push_back(t.values[c][i]);
  }
  return columns;
}

}  // namespace

ExploredTable explore_table(const std::string& name, Table t) {
  ExploredTable e;
  e.name = name;
  e.channels_in_file = t.channels.size();
  if (t.size() == 0) throw bad_input(t.path, "values", "none", "at least one");
  keep_shown_channels(t);
  e.channels = t.channels;
  e.grid = resampled_table(t);
  measure_loss(t, e);
  e.samples = some_samples(t);
  e.cuts = make_cuts(t);
  e.albedo = albedo_curve(t, 15);
  return e;
}

Json page_json(const ExploredTable& t) {
  Json cuts = Json::array(), albedo = Json::array();
  for (const auto& c : t.cuts)
    if (c.at == "theta_i")
      cuts.push_back({{"theta_i", c.at_deg}, {"theta_o", c.deg}, {"f", c.data}});
  // The page takes tables as isotropic: one azimuth for each zenith angle, whichever the light came
  // from.
  for (const auto& a : t.albedo)
    if (albedo.empty() || albedo.back()["theta_i"] != a.theta_i_deg)
      albedo.push_back({{"theta_i", a.theta_i_deg},
                        {"value", a.albedo},
                        {"error", a.error},
                        {"coverage", a.coverage}});
  std::string said = fmt::format(
      "{} values. The page holds them on a grid of {} × {} × {} half and difference angles: "
      "typically off by ×/÷ {:.3f}, and "
      "{:.0f} % of the values have a place on it. Points and albedos are the file's own.",
      t.values, explored_sizes[0], explored_sizes[1], explored_sizes[2], t.loss, 100 * t.covered);
  if (t.channels_in_file > t.channels.size())
    said += fmt::format(" Of {} channels it shows {}.", t.channels_in_file,
                        fmt::join(t.channels, ", "));
  return {{"kind", "table"},
          {"name", t.name},
          {"channels", t.channels},
          {"channels_in_file", t.channels_in_file},
          {"sizes", explored_sizes},
          {"said", said},
          {"cuts", cuts},
          {"albedo", albedo},
          {"values", base64(float_bytes(t.grid.values))},
          {"samples", base64(float_bytes(t.samples))},
          {"sha256", t.sha256},
          {"file", base64(t.file)},
          {"side", t.side}};
}

}  // namespace gonio
