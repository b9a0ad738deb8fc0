#include "reports/explore/page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>

#include "base/base64.h"
#include "base/error.h"
#include "base/json/reader.h"
#include "base/sha256.h"
#include "base/text.h"
#include "reports/explore/assets.h"
#include "reports/page/page.h"
#include "reports/pages/model_names.h"
#include "table/format/formats.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

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

Json page_json(const ExploredModel& m) {
  Json values = Json::object(), intervals = Json::object();
  for (const auto& [name, v] : named_values(m.model.model)) values[name] = v;
  for (const auto& [name, all] : m.intervals) {
    auto& list = intervals[name] = Json::array();
    for (const auto& [low, high] : all) list.push_back({low, high});
  }
  return {{"kind", "model"},
          {"name", m.name},
          {"spec", to_text(m.model.model.model.spec)},
          {"channels", m.model.channels},
          {"values", values},
          {"said", m.undetermined.empty()
                       ? ""
                       : fmt::format("The fit has no value for {}: it begins with another.",
                                     fmt::join(m.undetermined, ", "))},
          {"intervals", intervals},
          {"document", m.document}};
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
    expect_known_scale(name, fit);
    m.undetermined = fill_undetermined(fit);
    m.model = model_argument(name, fit, set);
  } else {
    m.model = model_argument(name, set, channels);
  }
  if (m.model.model.model.channels != 1 && m.model.model.model.channels != 3)
    throw bad_input(name, "channels", std::to_string(m.model.model.model.channels),
                    "1 or 3, as more are not drawn: gonio fit --channels takes three");
  if (!is_file || !name.ends_with(".json")) return m;
  const JsonDocument document(name);
  const JsonReader& root = document.root();
  if (!root.has("parameters")) return m;
  constexpr std::uintmax_t longest = 1 << 20;
  if (root.has("next") && std::filesystem::file_size(name) <= longest)
    m.document = InputFile(name).read_rest();
  for (const auto& [of, parameter] : root.at("parameters").members()) {
    auto all = intervals_in(parameter);
    if (!all.empty() && m.model.model.model.find(of)) m.intervals.emplace_back(of, std::move(all));
  }
  return m;
}

ExploredTable explore_file(const std::string& path, std::optional<Bins> bins) {
  TableAndDigest in(path, bins);
  in.finish();
  ExploredTable e = explore_table(path, std::move(in.table));
  InputFile file(path);
  e.sha256 = sha256_of_file(file);
  if (file.size() > most_held_bytes) return e;
  e.file = file.read_rest();
  e.side = side_text(path);
  return e;
}

std::string explore_page_html(const std::vector<Explored>& all, bool reads) {
  Json items = Json::array();
  const auto names = short_names(all);
  for (std::size_t i = 0; i < all.size(); ++i) {
    items.push_back(std::visit([](const auto& one) { return page_json(one); }, all[i]));
    items.back()["name"] = names[i];
    reads = reads || std::holds_alternative<ExploredTable>(all[i]);
  }
  // No text of a name ends the element that it stands in.
  std::string data = line_of(Json{{"items", items}});
  for (std::size_t at = 0; (at = data.find('<', at)) != data.npos;) data.replace(at, 1, "\\u003c");
  std::string body = fmt::format(
      "{}<script type=\"application/json\" id=\"explored\">{}</script>\n"
      "<script type=\"text/plain\" id=\"module\">{}</script>\n",
      assets::explore_html, data, base64(assets::models_wasm_gz));
  if (reads)
    body += fmt::format(
        "<script type=\"text/plain\" id=\"worker\">{}</script>\n"
        "<script type=\"text/plain\" id=\"fit-module\">{}</script>\n",
        assets::worker_js, base64(assets::fit_wasm_gz));
  return scripted_page("gonio explore", body, assets::explore_css,
                       fmt::format("{}{}", assets::explore_js, assets::fitting_js), true);
}

}  // namespace gonio
