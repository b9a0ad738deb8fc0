#include "reports/tables/batch_page.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "base/base64.h"
#include "base/file.h"
#include "base/json_reader.h"
#include "reports/page/assets.h"
#include "reports/page/page.h"

#include <fmt/format.h>

namespace gonio {
namespace {

// --- A preview in a document ---
Json rows_json(const std::vector<std::vector<double>>& v) {
  Json out = Json::array();
  for (const auto& row : v) out.push_back(row);
  return out;
}

Json json(const Preview& p) {
  const Thumbnail& t = p.curve;
  Json curve = nullptr;
  if (!t.at.empty())
    curve = {{"at", t.at},
             {"at_deg", t.at_deg},
             {"along", t.along},
             {"channels", t.channels},
             {"data_deg", t.data_deg},
             {"data", rows_json(t.data)},
             {"model_deg", t.model_deg},
             {"model", rows_json(t.model)}};
  return {{"curve", curve}, {"albedo", p.albedo}, {"sphere", base64(p.sphere)}};
}

std::vector<std::vector<double>> rows_of(const JsonReader& j) {
  std::vector<std::vector<double>> out;
  for (const auto& row : j.elements()) out.push_back(row.numbers());
  return out;
}

Preview read_preview(const JsonReader& j) {
  Preview p{{}, j.at("albedo").numbers(), from_base64(j.at("sphere").string())};
  const JsonReader c = j.at("curve");
  if (c.is_null()) return p;
  p.curve = {c.at("at").string(),        c.at("at_deg").number(),
             c.at("along").string(),     {},
             c.at("data_deg").numbers(), c.at("model_deg").numbers(),
             rows_of(c.at("data")),      rows_of(c.at("model"))};
  for (const auto& k : c.at("channels").elements()) p.curve.channels.push_back(k.whole_number());
  return p;
}

// --- A fit document, as far as the summary shows it ---
FitDocument read_fit(const JsonReader& j) {
  FitDocument d;
  d.model = j.at("model").string();
  for (const auto& c : j.at("channels").elements()) d.channels.push_back(c.string());
  for (const auto& w : j.at("warnings").elements()) d.warnings.push_back(w.string());
  for (const auto& [name, q] : j.at("parameters").members()) {
    FittedParameter p{name, q.at("value").numbers(), q.at("std_error").numbers(), {}, {}, {}};
    for (const auto& s : q.at("status").elements()) {
      const auto known = find_value<ParameterStatus>(s.string());
      if (!known) s.fail("a status");
      p.status.push_back(*known);
    }
    const std::size_t n = p.value.size();
    if ((n != 1 && n != d.channels.size()) || p.std_error.size() != n || p.status.size() != n)
      q.fail("a value, an error and a status for all channels or for each");
    d.parameters.push_back(std::move(p));
  }
  d.cost = j.at("cost").number();
  d.residuals.rms = j.at("residuals").at("rms").number();
  d.residuals.log_rms = j.at("residuals").at("log_rms").number();
  d.solver.termination = j.at("solver").at("termination").string();
  d.solver.message = j.at("solver").at("message").string();
  for (const auto& [phase, ms] : j.at("solver").at("time_ms").members())
    d.solver.phase_ms.emplace_back(phase, ms.number());
  d.input_sha256 = j.at("input").at("sha256").string();
  d.values_used = j.at("input").at("values_used").whole_number();
  for (const auto& [reason, n] : j.at("input").at("masked").members())
    d.masked[reason] = n.whole_number();
  return d;
}

Json read_document(const std::string& path) {
  InputFile file(path);
  return parse_json(path, file.read_rest(std::uint64_t{1} << 26));
}

bool has_fit(const BatchRow& r) {
  return !r.document.empty();
}

std::size_t masked_values(const FitDocument& d) {
  return std::accumulate(d.masked.begin(), d.masked.end(), std::size_t{0},
                         [](std::size_t sum, const auto& m) { return sum + m.second; });
}

// --- CSV ---
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == text.npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

std::string field(double v) {
  return std::isfinite(v) ? fmt::format("{}", v) : "";
}

/// "alpha", "kd.r": the column of a parameter's channel.
std::string column(const FitDocument& d, const FittedParameter& p, std::size_t channel) {
  return p.value.size() == 1 ? p.name : p.name + "." + d.channels[channel];
}

}  // namespace

std::string batch_document(const FitDocument& d,
                           const Preview& preview,
                           const std::string& made_with) {
  Json document = Json::parse(to_json(d));
  document["batch"] = {{"made_with", made_with}, {"preview", json(preview)}};
  return text_of(document);
}

std::optional<BatchRow> read_batch_document(const std::string& path,
                                            const std::string& sha256,
                                            const std::string& made_with) {
  try {
    const Json document = read_document(path);
    const JsonReader root(path, document);
    if (root.at("schema").string() != "gonio.fit/1" ||
        root.at("batch").at("made_with").string() != made_with ||
        root.at("input").at("sha256").string() != sha256)
      return {};
    BatchRow row;
    row.fit = read_fit(root);
    row.outcome = row.fit.solver.termination == "converged" ? Exit::done : Exit::not_converged;
    row.message = row.fit.solver.message;
    row.preview = read_preview(root.at("batch").at("preview"));
    return row;
  } catch (const Error&) {
    return {};  // not there, or not what a batch writes
  }
}

bool is_batch_document(const std::string& path) {
  try {
    const Json document = read_document(path);
    return JsonReader(path, document).at("batch").has("made_with");
  } catch (const Error&) {
    return false;
  }
}

std::string batch_csv(const std::vector<BatchRow>& rows) {
  std::vector<std::string> columns;  // those of all tables, as they are first seen
  for (const auto& r : rows)
    for (const auto& p : r.fit.parameters)
      for (std::size_t c = 0; c < p.value.size(); ++c)
        if (const auto name = column(r.fit, p, c);
            std::ranges::find(columns, name) == columns.end())
          columns.push_back(name);

  std::string csv = "path,document,status,exit_code,model";
  for (const auto& name : columns)
    csv += fmt::format(",{0},{1},{2}", field(name), field(name + ".std_error"),
                       field(name + ".status"));
  csv += ",log_rms,rms,cost,values_used,masked,warnings,message\n";
  for (const auto& r : rows) {
    csv += fmt::format("{},{},{},{},{}", field(r.path), field(r.document), name_of(r.outcome),
                       static_cast<int>(r.outcome), field(r.fit.model));
    std::map<std::string, std::string> cells;
    for (const auto& p : r.fit.parameters)
      for (std::size_t c = 0; c < p.value.size(); ++c)
        cells[column(r.fit, p, c)] = fmt::format(",{},{},{}", field(p.value[c]),
                                                 field(p.std_error[c]), name_of(p.status[c]));
    for (const auto& name : columns) csv += cells.contains(name) ? cells.at(name) : ",,,";
    if (has_fit(r))
      csv += fmt::format(",{},{},{},{},{},{}", field(r.fit.residuals.log_rms),
                         field(r.fit.residuals.rms), field(r.fit.cost), r.fit.values_used,
                         masked_values(r.fit), r.fit.warnings.size());
    else
      csv += ",,,,,,";
    csv += "," + field(r.message) + "\n";
  }
  return csv;
}

std::string batch_json(const std::vector<BatchRow>& rows,
                       const std::string& made_with,
                       bool previews) {
  Json counts = Json::object();
  for (const auto outcome : {Exit::done, Exit::not_converged, Exit::bad_input, Exit::usage})
    counts[name_of(outcome)] = std::ranges::count(rows, outcome, &BatchRow::outcome);
  Json tables = Json::array();
  for (const auto& r : rows) {
    Json t{{"path", r.path},
           {"document", r.document.empty() ? Json(nullptr) : Json(r.document)},
           {"status", name_of(r.outcome)},
           {"exit_code", static_cast<int>(r.outcome)},
           {"message", r.message}};
    if (has_fit(r)) {
      const FitDocument& d = r.fit;
      Json parameters = Json::object();
      for (const auto& p : d.parameters)
        parameters[p.name] = {{"value", per_channel(p.value)},
                              {"std_error", per_channel(p.std_error)},
                              {"status", per_channel(p.status.size(), [&](std::size_t c) {
                                 return Json(name_of(p.status[c]));
                               })}};
      double time = 0;
      for (const auto& [phase, ms] : d.solver.phase_ms) time += ms;
      t.update({{"model", d.model},
                {"channels", d.channels},
                {"parameters", parameters},
                {"log_rms", d.residuals.log_rms},
                {"rms", d.residuals.rms},
                {"cost", d.cost},
                {"values_used", d.values_used},
                {"masked", masked_values(d)},
                {"warnings", d.warnings},
                {"time_ms", time}});
      if (previews) t["preview"] = json(r.preview);
    }
    tables.push_back(std::move(t));
  }
  const Json all{{"schema", "gonio.batch/1"},
                 {"made_with", made_with},
                 {"counts", counts},
                 {"tables", tables}};
  return previews ? all.dump(-1, ' ', false, Json::error_handler_t::replace) : text_of(all);
}

std::string batch_page_html(std::string_view title, std::string_view data) {
  return make_page(title, data, assets::batch_js);
}

}  // namespace gonio
