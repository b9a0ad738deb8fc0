#include "reports/explore/page.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>

#include "base/base64.h"
#include "base/error.h"
#include "base/json/reader.h"
#include "base/text.h"
#include "explore/surface.h"
#include "reports/explore/assets.h"
#include "reports/page/page.h"
#include "reports/pages/model_names.h"
#include "table/format/in_memory.h"
#include "table/health/directional_albedo.h"
#include "table/lookup.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tbb/parallel_for.h>

namespace gonio {
namespace {

constexpr std::array<std::size_t, 3> explored_sizes{45, 30, 18};
constexpr double explored_reach = 10 * degree;
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/// Intervals of a parameter in a fit's document: [low, high], or one for each channel.
std::vector<std::array<double, 2>> intervals_in(const JsonReader& parameter) {
  std::vector<std::array<double, 2>> all;
  if (!parameter.has("ci95") || parameter.at("ci95").is_null()) return all;
  const auto ci = parameter.at("ci95").elements();
  const auto one = [&](const JsonReader& j) {
    if (j.is_array() && j.size() == 2)
      all.push_back({j.at(0).number(), j.at(1).number()});
    else
      all.push_back({no_number, no_number});
  };
  if (ci.size() == 2 && !ci[0].is_array() && !ci[1].is_array())
    all.push_back({ci[0].number(), ci[1].number()});
  else
    for (const auto& c : ci) one(c);
  return all;
}

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
    return counts_[cell] ? sums_[channel][cell] / static_cast<double>(counts_[cell]) : no_number;
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
  grid.values.assign(t.values.size(), Values(grid.grid()->size(), no_number));
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

Json page_json(const ExploredModel& m) {
  Json values = Json::object(), intervals = Json::object();
  for (const auto& [name, v] : named_values(m.model.model)) values[name] = v;
  for (const auto& [name, all] : m.intervals) {
    auto& list = intervals[name] = Json::array();
    for (const auto& [low, high] : all) list.push_back({low, high});
  }
  return {{"kind", "model"},
          {"name", m.name},
          {"spec", m.model.model.model.spec},
          {"channels", m.model.channels},
          {"values", values},
          {"said", m.undetermined.empty()
                       ? ""
                       : fmt::format("The fit has no value for {}: it begins with another.",
                                     fmt::join(m.undetermined, ", "))},
          {"intervals", intervals}};
}

Json page_json(const ExploredTable& t) {
  Json cuts = Json::array(), albedo = Json::array();
  for (const auto& c : t.cuts)
    if (c.at == "theta_i")
      cuts.push_back({{"theta_i", c.at_deg}, {"theta_o", c.deg}, {"f", c.data}});
  for (const auto& a : t.albedo)
    if (a.phi_i_deg == 0) albedo.push_back({{"theta_i", a.theta_i_deg}, {"value", a.albedo}});
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
          {"sizes", explored_sizes},
          {"said", said},
          {"cuts", cuts},
          {"albedo", albedo},
          {"values", base64(float_bytes(t.grid.values))},
          {"samples", base64(float_bytes(t.samples))}};
}

/// Gives values that a fit could not determine one to begin with; answers which.
std::vector<std::string> fill_undetermined(FittedModel& fit) {
  std::vector<std::string> names;
  std::optional<Model> model;
  for (auto& [name, values] : fit.parameters) {
    double sum = 0, known = 0;
    for (const double v : values)
      if (!std::isnan(v)) sum += v, ++known;
    if (known == static_cast<double>(values.size())) continue;
    if (!model) model = compose(fit.model, std::max<std::size_t>(fit.channels.size(), 1));
    const ModelParameter* const p = model->find(name);
    if (!p) continue;  // roughness beside alpha
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (!std::isnan(values[k])) continue;
      values[k] = known > 0 ? sum / known : p->about->start;
      names.push_back(values.size() == 1        ? name
                      : fit.channels.size() > k ? name + "." + fit.channels[k]
                                                : name + "." + std::to_string(k));
    }
  }
  return names;
}

/// Names as a page shows them: of a file without its folder, of a spec in words; numbered where two would be the same.
std::vector<std::string> short_names(const std::vector<Explored>& all) {
  std::vector<std::string> names;
  for (const auto& e : all) {
    const auto* m = std::get_if<ExploredModel>(&e);
    const std::string& given =
        std::visit([](const auto& one) -> const std::string& { return one.name; }, e);
    std::string name = m && file_in(given).empty()
                           ? model_names(std::span(&given, 1)).front()
                           : std::filesystem::path(given).filename().string();
    const auto before = std::ranges::count_if(
        names, [&](const std::string& n) { return n == name || n.starts_with(name + ", "); });
    if (before > 0) name += ", " + std::to_string(before + 1);
    names.push_back(std::move(name));
  }
  return names;
}

}  // namespace

ExploredModel explore_model(const std::string& name,
                            const std::vector<Setting>& set,
                            std::optional<std::size_t> channels) {
  const bool is_file = !file_in(name).empty();
  ExploredModel m{name, {}, {}};
  if (is_file && std::filesystem::exists(name)) {
    FittedModel fit = read_fitted_model(name);
    m.undetermined = fill_undetermined(fit);
    m.model = model_argument(name, fit, set);
  } else {
    m.model = model_argument(name, set, channels);
  }
  if (m.model.model.model.channels != 1 && m.model.model.model.channels != 3)
    throw bad_input(name, "channels", std::to_string(m.model.model.model.channels),
                    "1 or 3: more are not drawn");
  if (!is_file || !name.ends_with(".json")) return m;
  const JsonDocument document(name);
  const JsonReader& root = document.root();
  if (!root.has("parameters")) return m;
  for (const auto& [of, parameter] : root.at("parameters").members()) {
    auto all = intervals_in(parameter);
    if (!all.empty() && m.model.model.model.find(of)) m.intervals.emplace_back(of, std::move(all));
  }
  return m;
}

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

std::string explore_page_html(const std::vector<Explored>& all) {
  Json items = Json::array();
  const auto names = short_names(all);
  for (std::size_t i = 0; i < all.size(); ++i) {
    items.push_back(std::visit([](const auto& one) { return page_json(one); }, all[i]));
    items.back()["name"] = names[i];
  }
  // No text of a name ends the element that it stands in.
  std::string data = line_of(Json{{"items", items}});
  for (std::size_t at = 0; (at = data.find('<', at)) != data.npos;) data.replace(at, 1, "\\u003c");
  const std::string body = fmt::format(
      "{}<script type=\"application/json\" id=\"explored\">{}</script>\n"
      "<script type=\"text/plain\" id=\"module\">{}</script>\n",
      assets::explore_html, data, base64(assets::models_wasm_gz));
  return scripted_page("gonio explore", body, assets::explore_css, assets::explore_js, true);
}

}  // namespace gonio
