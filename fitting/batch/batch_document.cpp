#include "fitting/batch/batch_document.h"

#include <algorithm>
#include <map>
#include <unordered_set>

#include "base/csv_describe.h"
#include "base/json/describe.h"
#include "fitting/batch/preview_json.h"
#include "fitting/result/document_fields.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

/// Part of a document that a batch adds.
struct Kept {
  std::string made_with;
  Preview preview;
};
/// Fit document with that part, or without.
struct Document {
  FitDocument fit;
  std::optional<Kept> batch;
};

/// Document of a table without a fit.
struct Failure {
  const BatchRow& row;
  std::string made_with;
};

}  // namespace

template <>
struct Description<BatchParameter> {
  static constexpr auto fields() {
    return std::tuple{field("value", "", per_channel(&BatchParameter::value), "fitted value"),
                      field("std_error", "", per_channel(&BatchParameter::std_error),
                            "standard error; null where it is not known"),
                      field("status", "", per_channel(&BatchParameter::status), ""),
                      field("limit", "", per_channel(&BatchParameter::limit),
                            "one-sided 95 % bound where the status is upper_limit or lower_limit")};
  }
};

template <>
struct Description<BatchFit> {
  static constexpr auto model = field("model", "", &BatchFit::model, "the model fitted");
  static constexpr auto log_rms =
      field("log_rms", "", &BatchFit::log_rms, "RMS of ln f_model − ln f_data");
  static constexpr auto rms = field("rms", "1/sr", &BatchFit::rms, "RMS of f_model − f_data");
  static constexpr auto cost = field("cost", "", &BatchFit::cost, "half the sum of the losses");
  static constexpr auto values_used =
      field("values_used", "", &BatchFit::values_used, "values of the table that were fitted");
  static constexpr auto masked = field("masked", "", &BatchFit::masked, "values left out");
  static constexpr auto misfit =
      field("misfit", "", &BatchFit::misfit, "RMS of what follows the angles, of f");
  static constexpr auto misfit_told =
      field("misfit_told", "", &BatchFit::misfit_told, "whether that is more than luck");

  static constexpr auto fields() {
    return std::tuple{
        model,
        field("channels", "", &BatchFit::channels, "names of the table's channels"),
        field("parameters", "", by_name(&BatchFit::parameters), "parameters by name"),
        log_rms,
        rms,
        cost,
        values_used,
        masked,
        misfit,
        misfit_told,
        field("warnings", "", &BatchFit::warnings, "sentences to know before believing the values"),
        field("time_ms", "ms", &BatchFit::time_ms, "time from reading to the result")};
  }
};

template <>
struct Description<BatchRow> {
  static constexpr auto path = field("path", "", &BatchRow::path, "path of the table");
  static constexpr auto status = field("status", "", &BatchRow::outcome, "");
  static constexpr auto exit_code = field(
      "exit_code",
      "",
      [](const BatchRow& r) { return static_cast<int>(r.outcome); },
      "exit code of a fit of this table alone");
  static constexpr auto message =
      field("message", "", &BatchRow::message, "why there is no fit; else why the search ended");

  static constexpr auto fields() {
    return std::tuple{
        path,
        field(
            "document", "",
            [](const BatchRow& r) {
              return r.document.empty() ? std::nullopt : std::optional(r.document);
            },
            "name of the fit document, beside the summary; null where there is none"),
        field(
            "page", "",
            [](const BatchRow& r) { return r.page.empty() ? std::nullopt : std::optional(r.page); },
            "name of the table's page, beside the summary; null where none was asked for"),
        status,
        exit_code,
        message,
        inlined(&BatchRow::fit),
        field("preview", "", if_there(&BatchRow::preview), "small pictures, for the page alone")};
  }
};

template <>
struct Description<Kept> {
  static constexpr auto fields() {
    return std::tuple{field("made_with", "", &Kept::made_with,
                            "all that determines the result beside the table's bytes"),
                      field("preview", "", &Kept::preview, "small pictures, for the summary")};
  }
};
template <>
struct Description<Document> {
  static constexpr auto fields() {
    return std::tuple{inlined(&Document::fit),
                      field("batch", "", if_there(&Document::batch), "of one table of a batch")};
  }
};

template <>
struct Description<Failure> {
  static constexpr auto fields() {
    return std::tuple{
        constant_text("schema", "gonio.failure/1"),
        group("input", "the table",
              field(
                  "path", "", [](const Failure& f) { return f.row.path; }, "path of the table")),
        field(
            "status", "", [](const Failure& f) { return f.row.outcome; }, ""),
        field(
            "exit_code", "", [](const Failure& f) { return static_cast<int>(f.row.outcome); },
            "exit code of a fit of this table alone"),
        field(
            "message", "", [](const Failure& f) { return f.row.message; }, "why there is no fit"),
        group("batch", "of one table of a batch",
              field("made_with", "", &Failure::made_with,
                    "all that determines the result beside the table's bytes"))};
  }
};

template <>
struct Description<LeftOutDocument> {
  static constexpr auto fields() {
    return std::tuple{
        field("document", "", &LeftOutDocument::document, "its name, beside the summary"),
        field("why", "", &LeftOutDocument::why,
              "made_otherwise: by another version or with other options"),
        field("path", "", &LeftOutDocument::path,
              "path of its table; empty where it cannot be read"),
        field("made_with", "", &LeftOutDocument::made_with,
              "what determined its result; empty where it cannot be read"),
        field("message", "", &LeftOutDocument::message,
              "why it cannot be read; empty where it can")};
  }
};

template <>
struct Description<BatchSummary> {
  /// Number of tables by status.
  static auto counts(const BatchSummary& s) {
    std::vector<std::pair<std::string_view, std::size_t>> all;
    for (const auto outcome : {Exit::done, Exit::not_converged, Exit::bad_input, Exit::usage})
      all.emplace_back(name_of(outcome), std::ranges::count(s.rows, outcome, &BatchRow::outcome));
    return all;
  }
  static constexpr auto fields() {
    return std::tuple{constant_text("schema", "gonio.batch/1"),
                      field("made_with", "", &BatchSummary::made_with,
                            "all that determines a result beside the table's bytes"),
                      field(
                          "part", "",
                          [](const BatchSummary& s) {
                            return s.part.empty() ? std::nullopt : std::optional(s.part);
                          },
                          "K/N where these are the tables of one part alone, else null"),
                      field("counts", "", counts, "number of tables by status"),
                      field("missing", "", &BatchSummary::missing,
                            "paths of the tables that nobody has tried yet in this way"),
                      field("left_out", "", &BatchSummary::left_out,
                            "documents that lie beside the summary and are not in it"),
                      field("tables", "", &BatchSummary::rows, "")};
  }
};

namespace {

BatchFit read_fit(const JsonReader& j) {
  BatchFit d;
  d.model = j.at("model").string();
  for (const auto& c : j.at("channels").elements()) d.channels.push_back(c.string());
  for (const auto& w : j.at("warnings").elements()) d.warnings.push_back(w.string());
  for (const auto& [name, q] : j.at("parameters").members()) {
    BatchParameter p{
        name, q.at("value").numbers(), q.at("std_error").numbers(), {}, q.at("limit").numbers()};
    for (const auto& s : q.at("status").elements()) {
      const auto known = find_value<ParameterStatus>(s.string());
      if (!known) s.fail("a status");
      p.status.push_back(*known);
    }
    const std::size_t n = p.value.size();
    if ((n != 1 && n != d.channels.size()) || p.std_error.size() != n || p.status.size() != n ||
        p.limit.size() != n)
      q.fail("a value, an error, a status and a limit for all channels or for each");
    d.parameters.push_back(std::move(p));
  }
  d.cost = j.at("cost").number();
  d.rms = j.at("residuals").at("rms").number();
  d.log_rms = j.at("residuals").at("log_rms").number();
  d.misfit = j.at("misfit").at("size").number();
  d.misfit_told = j.at("misfit").at("told").boolean();
  for (const auto& [phase, ms] : j.at("solver").at("time_ms").members()) d.time_ms += ms.number();
  d.values_used = j.at("input").at("values_used").whole_number();
  for (const auto& [reason, n] : j.at("input").at("masked").members()) d.masked += n.whole_number();
  return d;
}

Exit outcome_of(std::string_view termination) {
  return termination == "converged" ? Exit::done : Exit::not_converged;
}

/// Column of a parameter's channel: "alpha", "kd.r".
std::string column(const BatchFit& d, const BatchParameter& p, std::size_t channel) {
  return p.value.size() == 1 ? p.name : p.name + "." + d.channels[channel];
}

}  // namespace

BatchFit in_brief(const FitDocument& d) {
  BatchFit b;
  b.model = d.model;
  b.channels = d.channels;
  b.log_rms = d.residuals.log_rms;
  b.rms = d.residuals.rms;
  b.cost = d.cost;
  b.misfit = d.misfit.size;
  b.misfit_told = d.misfit.told;
  b.values_used = d.values_used;
  b.warnings = d.warnings;
  for (const auto& p : d.parameters)
    b.parameters.push_back({p.name, p.value, p.std_error, p.status, p.limit});
  for (const auto& [reason, n] : d.masked) b.masked += n;
  for (const auto& [phase, ms] : d.solver.phase_ms) b.time_ms += ms;
  return b;
}

std::string batch_document(const FitDocument& d,
                           const Preview& preview,
                           const std::string& made_with) {
  return json_text(Document{d, Kept{made_with, preview}});
}

std::string failure_document(const BatchRow& row, const std::string& made_with) {
  return json_text(Failure{row, made_with});
}

std::optional<ReadDocument> read_document(const std::string& path) {
  const Json document = read_json(path);
  const JsonReader root(path, document);
  if (!document.is_object() || !root.has("schema") || !root.at("schema").is_string()) return {};
  const std::string schema = root.at("schema").string();
  if (schema == "gonio.failure/1") {
    const auto outcome = find_value<Exit>(root.at("status").string());
    if (outcome != Exit::bad_input && outcome != Exit::usage)
      root.at("status").fail("the status of a failure");
    return ReadDocument{
        {root.at("input").at("path").string(), "", *outcome, root.at("message").string(), {}, {}},
        root.at("batch").at("made_with").string(),
        ""};
  }
  if (schema != "gonio.fit/1" || !root.has("batch")) return {};
  const JsonReader solver = root.at("solver"), input = root.at("input"), batch = root.at("batch");
  return ReadDocument{
      {input.at("path").string(), "", outcome_of(solver.at("termination").string()),
       solver.at("message").string(), read_fit(root), read_preview(batch.at("preview"))},
      batch.at("made_with").string(),
      input.at("sha256").string()};
}

std::optional<BatchRow> read_batch_document(const std::string& path,
                                            const std::string& sha256,
                                            const std::string& made_with) {
  try {
    auto read = read_document(path);
    if (!read || !read->row.fit || read->made_with != made_with || read->sha256 != sha256)
      return {};
    return std::move(read->row);
  } catch (const Error&) {
    return {};  // not there, or not what a batch writes
  }
}

bool is_batch_document(const std::string& path) {
  try {
    const Json document = read_json(path);
    return JsonReader(path, document).at("batch").has("made_with");
  } catch (const Error&) {
    return false;
  }
}

std::string batch_csv(const std::vector<BatchRow>& rows) {
  using Row = Description<BatchRow>;
  using Fit = Description<BatchFit>;
  constexpr std::tuple first{Row::path, field("document", "", &BatchRow::document, ""), Row::status,
                             Row::exit_code};
  constexpr std::tuple last{
      Fit::log_rms,
      Fit::rms,
      Fit::cost,
      Fit::values_used,
      Fit::masked,
      Fit::misfit,
      Fit::misfit_told,
      field(
          "warnings", "", [](const BatchFit& f) { return f.warnings.size(); }, "")};
  const std::string none(std::tuple_size_v<decltype(last)> - 1, ',');

  std::vector<std::string> columns;  // those of all tables, as they are first seen
  std::unordered_set<std::string> seen;
  for (const auto& r : rows)
    if (r.fit)
      for (const auto& p : r.fit->parameters)
        for (std::size_t c = 0; c < p.value.size(); ++c)
          if (auto name = column(*r.fit, p, c); seen.insert(name).second)
            columns.push_back(std::move(name));

  std::string csv = csv_columns(first) + ",model";
  for (const auto& name : columns)
    csv += fmt::format(",{},{},{},{}", csv_text(name), csv_text(name + ".std_error"),
                       csv_text(name + ".status"), csv_text(name + ".limit"));
  csv += "," + csv_columns(last) + ",message\n";
  for (const auto& r : rows) {
    csv += csv_cells(first, r) + "," + (r.fit ? csv_text(r.fit->model) : "");
    std::map<std::string, std::string> cells;
    if (r.fit)
      for (const auto& p : r.fit->parameters)
        for (std::size_t c = 0; c < p.value.size(); ++c)
          cells[column(*r.fit, p, c)] = fmt::format(
              ",{},{},{},{}", csv_number(p.value[c]), csv_number(p.std_error[c]),
              name_of(p.status[c]), csv_number(p.limit.empty() ? std::nan("") : p.limit[c]));
    for (const auto& name : columns) csv += cells.contains(name) ? cells.at(name) : ",,,,";
    csv += "," + (r.fit ? csv_cells(last, *r.fit) : none) + "," + csv_text(r.message) + "\n";
  }
  return csv;
}

Exit BatchSummary::outcome() const {
  if (!missing.empty()) return Exit::check_failed;
  for (const Exit worst : {Exit::bad_input, Exit::usage, Exit::not_converged})
    if (std::ranges::find(rows, worst, &BatchRow::outcome) != rows.end()) return worst;
  return Exit::done;
}

std::string batch_json(const BatchSummary& summary, bool previews) {
  Json all = json_of(summary);
  if (previews) return all.dump(-1, ' ', false, Json::error_handler_t::replace);
  for (Json& table : all["tables"]) table.erase("preview");
  return text_of(all);
}

std::string fit_schema() {
  return schema_text<Document>("Fit of a model to a table");
}

std::string failure_schema() {
  return schema_text<Failure>("Table of a batch that has no fit");
}

std::string batch_schema() {
  return schema_text<BatchSummary>("Fits of many tables");
}

}  // namespace gonio
