#include "reports/explore/page.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "base/base85.h"
#include "base/error.h"
#include "base/json/reader.h"
#include "base/sha256.h"
#include "base/text.h"
#include "brdf/model/presets.h"
#include "reports/explore/assets.h"
#include "reports/page/page.h"
#include "table/format/formats.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

std::string file_name_in(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

/// Name of a model that a person gave: its file's, or what a shipped one is called; "" of terms.
std::string name_given(const std::string& model) {
  if (!file_in(model).empty()) return file_name_in(model);
  const Preset* const shipped = find_preset(model);
  return shipped ? std::string(shipped->about.title) : "";
}

Json page_json(const ExploredModel& m) {
  Json values = Json::object();
  for (const auto& [name, v] : named_values(m.model.model)) values[name] = v;
  return {{"kind", "model"},
          {"name", name_given(m.name)},
          {"spec", to_text(m.model.model.model.spec)},
          {"channels", m.model.channels},
          {"values", values},
          {"document", m.document}};
}

/// Gives values that a fit could not determine one to begin with.
void fill_undetermined(FittedModel& fit) {
  std::optional<Model> model;
  for (auto& [name, values] : fit.parameters) {
    double sum = 0, known = 0;
    for (const double v : values)
      if (!std::isnan(v)) sum += v, ++known;
    if (known == static_cast<double>(values.size())) continue;
    if (!model) model = compose(fit.model, std::max<std::size_t>(fit.channels.size(), 1));
    const ModelParameter* const p = model->find(name);
    if (!p) continue;  // roughness beside alpha
    for (double& v : values)
      if (std::isnan(v)) v = known > 0 ? sum / known : p->about->start;
  }
}

}  // namespace

ExploredModel explore_model(const std::string& name,
                            const std::vector<Setting>& set,
                            std::optional<std::size_t> channels) {
  const bool is_file = !file_in(name).empty();
  ExploredModel m{name, {}};
  if (is_file && std::filesystem::exists(name)) {
    FittedModel fit = read_fitted_model(name);
    expect_known_scale(name, fit);
    fill_undetermined(fit);
    m.model = model_argument(name, fit, set);
  } else {
    m.model = model_argument(name, set, channels);
  }
  if (m.model.model.model.channels != 1 && m.model.model.model.channels != 3)
    throw bad_input(name, "channels", std::to_string(m.model.model.model.channels),
                    "1 or 3, as more are not drawn: gonio fit --channels takes three");
  constexpr std::uintmax_t longest = 1 << 20;
  if (is_file && name.ends_with(".json") && std::filesystem::file_size(name) <= longest &&
      JsonDocument(name).root().has("parameters"))
    m.document = InputFile(name).read_rest();
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
  for (const auto& one : all) {
    items.push_back(std::visit([](const auto& e) { return page_json(e); }, one));
    if (const auto* t = std::get_if<ExploredTable>(&one))
      items.back()["name"] = file_name_in(t->name), reads = true;
  }
  // No text of a name ends the element that it stands in.
  std::string data = line_of(Json{{"items", items}});
  for (std::size_t at = 0; (at = data.find('<', at)) != data.npos;) data.replace(at, 1, "\\u003c");
  std::string body = fmt::format(
      "{}<script type=\"application/json\" id=\"explored\">{}</script>\n"
      "<script type=\"text/plain\" id=\"module\">{}</script>\n",
      assets::explore_html, data, base85(assets::models_wasm_gz));
  if (reads)
    body += fmt::format(
        "<script type=\"text/plain\" id=\"worker\">{}</script>\n"
        "<script type=\"text/plain\" id=\"fit-module\">{}</script>\n",
        assets::worker_js, base85(assets::fit_wasm_gz));
  return scripted_page(
      "gonio explore", body, assets::explore_css,
      fmt::format("{}{}{}", assets::explore_js, assets::views_js, assets::fitting_js), true);
}

}  // namespace gonio
