#include "fitting/batch/batch_document.h"

#include <algorithm>
#include <map>
#include <unordered_set>

#include "base/csv_describe.h"
#include "base/error.h"
#include "base/file.h"
#include "base/json/describe.h"
#include "base/text.h"
#include "fitting/batch/preview_json.h"
#include "fitting/result/document_fields.h"

#include <fmt/format.h>

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
  BatchRow row;
  std::string made_with;
};

/// Fit document of a batch, as much as its summary shows.
struct KeptFit {
  BatchFit fit;
  Preview preview;
  std::string path, sha256, termination, message, made_with;
};

/// Sum of what is given by name.
template <auto member>
auto sum(const BatchFit& f) {
  auto all = std::remove_cvref_t<decltype((f.*member).begin()->second)>{};
  for (const auto& [name, part] : f.*member) all += part;
  return all;
}

}  // namespace

template <>
inline constexpr auto description<BatchParameter> =
    FieldList{Field{"value", per_channel(&BatchParameter::value), "fitted value"},
              Field{"std_error", per_channel(&BatchParameter::std_error),
                    "standard error; null where it is not known"},
              Field{"status", per_channel(&BatchParameter::status), ""},
              Field{"limit", per_channel(&BatchParameter::limit),
                    "one-sided 95 % bound where the status is upper_limit or lower_limit"}};

template <>
struct Description<BatchFit> {
  static constexpr auto model = field("model", &BatchFit::model, "the model fitted");
  static constexpr auto log_rms =
      field("log_rms", &BatchFit::log_rms, "RMS of ln f_model − ln f_data");
  static constexpr auto rms = field("rms", "1/sr", &BatchFit::rms, "RMS of f_model − f_data");
  static constexpr auto cost = field("cost", &BatchFit::cost, "half the sum of the losses");
  static constexpr auto values_used =
      field("values_used", &BatchFit::values_used, "values of the table that were fitted");
  static constexpr auto masked = field("masked", sum<&BatchFit::masked>, "values left out");
  static constexpr auto misfit =
      field("misfit", &BatchFit::misfit, "RMS of what follows the angles, of f");
  static constexpr auto misfit_told =
      field("misfit_told", &BatchFit::misfit_told, "whether that is more than luck");

  static constexpr auto fields() {
    return FieldList{
        model,
        field("channels", &BatchFit::channels, "names of the table's channels"),
        field("parameters", by_name(&BatchFit::parameters), "parameters by name"),
        log_rms,
        rms,
        cost,
        values_used,
        masked,
        misfit,
        misfit_told,
        field("warnings", &BatchFit::warnings, "sentences to know before believing the values"),
        field("time_ms", "ms", sum<&BatchFit::time_ms>, "time from reading to the result")};
  }
};

template <>
struct Description<BatchRow> {
  static constexpr auto path = field("path", &BatchRow::path, "path of the table");
  static constexpr auto status = field("status", &BatchRow::outcome, "");
  static constexpr auto exit_code = field(
      "exit_code",
      [](const BatchRow& r) { return static_cast<int>(r.outcome); },
      "exit code of a fit of only this table");
  static constexpr auto message =
      field("message", &BatchRow::message, "why there is no fit; else why the search ended");

  static constexpr auto fields() {
    return FieldList{
        path,
        field(
            "document",
            [](const BatchRow& r) {
              return r.document.empty() ? std::nullopt : std::optional(r.document);
            },
            "name of the fit document, beside the summary; null where there is none"),
        field(
            "page",
            [](const BatchRow& r) { return r.page.empty() ? std::nullopt : std::optional(r.page); },
            "name of the table's page, beside the summary; null where none was asked for"),
        status,
        exit_code,
        message,
        inlined(&BatchRow::fit),
        field("preview", if_there(&BatchRow::preview), "small pictures, only for the page")};
  }
};

template <>
inline constexpr auto description<Kept> = FieldList{
    Field{"made_with", &Kept::made_with, "all that determines the result beside the table's bytes"},
    Field{"preview", &Kept::preview, "small pictures, for the summary"}};
template <>
inline constexpr auto description<Document> = FieldList{
    inlined(&Document::fit), Field{"batch", if_there(&Document::batch), "of one table of a batch"}};

template <>
struct Description<KeptFit> {
  static constexpr bool has_others = true;
  template <class Member>
  static constexpr auto of_fit(Member member) {
    return at(&KeptFit::fit, member);
  }
  static constexpr auto fields() {
    using F = BatchFit;
    return FieldList{
        constant_text("schema", "gonio.fit/1"),
        field("model", of_fit(&F::model), ""),
        field("channels", of_fit(&F::channels), ""),
        field("parameters", by_name(of_fit(&F::parameters)), ""),
        field("cost", of_fit(&F::cost), ""),
        field("warnings", of_fit(&F::warnings), ""),
        group("residuals", "", field("rms", of_fit(&F::rms), ""),
              field("log_rms", of_fit(&F::log_rms), "")),
        group("misfit", "", field("size", of_fit(&F::misfit), ""),
              field("told", of_fit(&F::misfit_told), "")),
        group("solver", "", field("termination", &KeptFit::termination, ""),
              field("message", &KeptFit::message, ""), field("time_ms", of_fit(&F::time_ms), "")),
        group("input", "", field("path", &KeptFit::path, ""), field("sha256", &KeptFit::sha256, ""),
              field("values_used", of_fit(&F::values_used), ""),
              field("masked", of_fit(&F::masked), "")),
        group("batch", "", field("made_with", &KeptFit::made_with, ""),
              field("preview", &KeptFit::preview, ""))};
  }
  static void check(KeptFit& k, Demand expect) {
    for (const auto& p : k.fit.parameters) {
      const std::size_t n = p.value.size();
      expect((n == 1 || n == k.fit.channels.size()) && p.std_error.size() == n &&
                 p.status.size() == n && p.limit.size() == n,
             "parameters", "a value, an error, a status and a limit for all channels or for each");
    }
  }
};

template <>
struct Description<Failure> {
  template <class Member>
  static constexpr auto of_row(Member member) {
    return at(&Failure::row, member);
  }
  static constexpr auto fields() {
    return FieldList{
        constant_text("schema", "gonio.failure/1"),
        group("input", "the table", field("path", of_row(&BatchRow::path), "path of the table")),
        field("status", of_row(&BatchRow::outcome), ""),
        field(
            "exit_code", [](const Failure& f) { return static_cast<int>(f.row.outcome); },
            "exit code of a fit of only this table"),
        field("message", of_row(&BatchRow::message), "why there is no fit"),
        group("batch", "of one table of a batch",
              field("made_with", &Failure::made_with,
                    "all that determines the result beside the table's bytes"))};
  }
  static void check(Failure& f, Demand expect) {
    expect(f.row.outcome == Exit::bad_input || f.row.outcome == Exit::usage, "status",
           "the status of a failure");
  }
};

template <>
inline constexpr auto description<LeftOutDocument> = FieldList{
    Field{"document", &LeftOutDocument::document, "its name, beside the summary"},
    Field{"why", &LeftOutDocument::why, "made_otherwise: by another version or with other options"},
    Field{"path", &LeftOutDocument::path, "path of its table; empty where it cannot be read"},
    Field{"made_with", &LeftOutDocument::made_with,
          "what determined its result; empty where it cannot be read"},
    Field{"message", &LeftOutDocument::message, "why it cannot be read; empty where it can"}};

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
    return FieldList{constant_text("schema", "gonio.batch/1"),
                     field("made_with", &BatchSummary::made_with,
                           "all that determines a result beside the table's bytes"),
                     field(
                         "part",
                         [](const BatchSummary& s) {
                           return s.part.empty() ? std::nullopt : std::optional(s.part);
                         },
                         "K/N where these are only the tables of one part, else null"),
                     field("counts", counts, "number of tables by status"),
                     field("missing", &BatchSummary::missing,
                           "paths of the tables that nobody has tried yet in this way"),
                     field("left_out", &BatchSummary::left_out,
                           "documents that lie beside the summary and are not in it"),
                     field("tables", &BatchSummary::rows, "")};
  }
};

namespace {

/// Column of a parameter's channel: "alpha", "kd.r".
std::string column(const BatchFit& d, const BatchParameter& p, std::size_t channel) {
  return p.value.size() == 1 ? p.name : p.name + "." + d.channels[channel];
}

}  // namespace

std::string batch_document(const FitDocument& d,
                           const Preview& preview,
                           const std::string& made_with) {
  return json_text(Document{d, Kept{made_with, preview}});
}

std::string failure_document(const BatchRow& row, const std::string& made_with) {
  return json_text(Failure{row, made_with});
}

std::string as_in_document(const std::string& text) {
  const auto is_plain = [](unsigned char c) { return c < 0x80; };
  return std::ranges::all_of(text, is_plain) ? text
                                             : JsonDocument("", json_line(text)).root().string();
}

std::size_t memory_of(const ReadDocument& d) {
  std::size_t all = sizeof d + d.made_with.size() + d.sha256.size();
  const auto add = [&](const auto& list) { all += list.size() * sizeof list[0]; };
  const auto add_texts = [&](const std::vector<std::string>& list) {
    add(list);
    for (const auto& text : list) all += text.size();
  };
  add_texts({d.row.path, d.row.document, d.row.message, d.row.page});
  if (const auto& f = d.row.fit) {
    add_texts({f->model});
    add_texts(f->channels);
    add_texts(f->warnings);
    for (const auto& [name, n] : f->masked) all += 2 * sizeof name + name.size();
    for (const auto& [name, ms] : f->time_ms) all += 2 * sizeof name + name.size();
    add(f->parameters);
    for (const auto& p : f->parameters) {
      all += p.name.size();
      for (const auto* of : {&p.value, &p.std_error, &p.limit}) add(*of);
      add(p.status);
    }
  }
  if (const auto& p = d.row.preview) {
    all += p->sphere.size();
    add(p->albedo);
    if (const auto& c = p->curve) {
      add_texts({c->at, c->along});
      add(c->channels);
      for (const auto* of : {&c->data_deg, &c->model_deg}) add(*of);
      for (const auto* of : {&c->data, &c->model}) {
        add(*of);
        for (const auto& channel : *of) add(channel);
      }
    }
  }
  return all;
}

/// Throws bad_input where a curve has not one value for each place.
void check_curve(const std::string& path, const Thumbnail& t) {
  const auto check = [&](const char* name, const std::vector<std::vector<double>>& rows,
                         const std::vector<double>& places) {
    const std::string place = fmt::format("/batch/preview/curve/{}", name);
    if (rows.size() != t.channels.size())
      throw bad_input(path, place, counted(rows.size(), "row"),
                      fmt::format("{}, one for each channel", t.channels.size()));
    for (const auto& row : rows)
      if (row.size() != places.size())
        throw bad_input(path, place, counted(row.size(), "value"),
                        fmt::format("{}, one for each place", places.size()));
  };
  check("data", t.data, t.data_deg);
  check("model", t.model, t.model_deg);
}

std::optional<ReadDocument> parse_document(const std::string& path, const std::string& bytes) {
  const JsonDocument document(path, bytes);
  const JsonReader& root = document.root();
  if (!root.has("schema") || !root.at("schema").is_string()) return {};
  const std::string schema = root.at("schema").string();
  if (schema == "gonio.failure/1") {
    Failure failure;
    read_record(root, failure);
    return ReadDocument{std::move(failure.row), std::move(failure.made_with), ""};
  }
  if (schema != "gonio.fit/1" || !root.has("batch")) return {};
  KeptFit k;
  read_record(root, k);
  if (k.preview.curve) check_curve(path, *k.preview.curve);
  const Exit outcome = k.termination == "converged" ? Exit::done : Exit::not_converged;
  ReadDocument d{{std::move(k.path), "", outcome, std::move(k.message), std::move(k.fit),
                  std::move(k.preview)},
                 std::move(k.made_with),
                 std::move(k.sha256)};
  if (const auto needed = memory_of(d); needed > most_of_a_row)
    throw bad_input(path, "the document",
                    fmt::format("{} bytes that a summary shows of it", needed),
                    fmt::format("at most {}", most_of_a_row));
  return d;
}

std::optional<ReadDocument> read_document(const std::string& path) {
  may_replace(path);
  return parse_document(path, InputFile(path).read_rest(most_document_bytes));
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
  may_replace(path);
  try {
    return JsonDocument(path).root().at("batch").has("made_with");
  } catch (const Error&) {
    return false;
  }
}

std::string batch_csv(const std::vector<BatchRow>& rows) {
  using Row = Description<BatchRow>;
  using Fit = Description<BatchFit>;
  constexpr FieldList first{Row::path, field("document", &BatchRow::document, ""), Row::status,
                            Row::exit_code};
  constexpr FieldList last{
      Fit::log_rms,
      Fit::rms,
      Fit::cost,
      Fit::values_used,
      Fit::masked,
      Fit::misfit,
      Fit::misfit_told,
      field(
          "warnings", [](const BatchFit& f) { return f.warnings.size(); }, "")};
  const std::string none(decltype(last)::size - 1, ',');

  // A document of many channels with names of its own gives all other tables their columns, too.
  constexpr std::size_t most_cells = std::size_t{1} << 26, each = 4;
  std::vector<std::string> columns;  // those of all tables, as they are first seen
  std::unordered_set<std::string> seen;
  std::size_t letters = 0;
  for (const auto& r : rows)
    if (r.fit)
      for (const auto& p : r.fit->parameters)
        for (std::size_t c = 0; c < p.value.size(); ++c)
          if (auto name = column(*r.fit, p, c); seen.insert(name).second) {
            letters += name.size();
            columns.push_back(std::move(name));
            if (each * columns.size() > most_cells / rows.size() || letters > most_cells)
              throw bad_input(
                  "summary.csv", "writing",
                  fmt::format("{} or more columns of parameters in {} tables, whose names have {} "
                              "bytes",
                              each * columns.size(), rows.size(), letters),
                  fmt::format("at most {} cells and bytes", most_cells));
          }

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
  if (previews) return json_line(summary);
  BatchSummary without = summary;
  for (auto& row : without.rows) row.preview.reset();
  return json_text(without);
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
