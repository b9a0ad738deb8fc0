#include "fitting/ask/page_request.h"

#include <algorithm>

#include "base/error.h"
#include "base/file.h"
#include "base/json/describe.h"
#include "base/nearest_names.h"
#include "base/options.h"
#include "explore/explored_table.h"
#include "fitting/choice/document.h"
#include "table/format/as_one.h"
#include "table/format/column_proposal.h"
#include "table/format/formats.h"
#include "table/format/metadata.h"
#include "table/health/health.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

/// Columns of a text file, what they may be, and why; null of a file that has none.
Json columns_in(const std::string& path) try {
  InputFile in(path);
  if (!is_csv(in.peek(1 << 16))) return {};
  const auto columns = csv_columns(in);
  Json names = Json::array(), map;
  for (const auto& c : columns) names.push_back(c.name);
  const auto p = propose_columns(columns, path, in.peek(1 << 14));
  if (p.map) map = parse_json(path, with_columns(side_path(path), "", *p.map))["columns"];
  return {{"names", names}, {"map", map}, {"needed", p.needed}, {"said", p.said}};
} catch (const Error&) {
  return {};
}

/// A file that cannot be read as it is still has columns, for a person to say what they are.
Json read_for_page(const PageRequest& r,
                   const HowFitted& how,
                   const std::function<void(const std::string&)>& phase) {
  phase("reading " + r.file);
  Json answer = {{"table", {}}, {"inspection", {}}, {"columns", {}}, {"error", ""}};
  std::optional<Table> t;
  try {
    t = read_table(r.file, how.bins);
  } catch (const Error& e) {
    answer["error"] = e.what();
  }
  if (!t || t->format == "csv") answer["columns"] = columns_in(r.file);
  if (!t) return answer;
  take(*t, how.measured);
  phase("inspecting");
  answer["inspection"] = parse_json(r.file, to_json(*t, inspect(*t)));
  phase("resampling");
  answer["table"] = page_json(explore_table(r.file, std::move(*t)));
  return answer;
}

std::string compare_for_page(const PageRequest& r,
                             const HowFitted& how,
                             const std::function<void(const std::string&)>& phase) {
  const auto models = models_asked(r.models);
  phase("reading " + r.file);
  TableAndDigest in = read_files({r.file}, how.bins);
  take(in.table, how.measured);
  const ModelChoice choice =
      compare_on_scale(in.table, how.options, models, [&](const std::string& what, double part) {
        phase(fmt::format("{} ({:.0f} %)", what, 100 * part));
      });
  in.finish();
  return to_json(choice, advise(choice), compared_table(in.table, how.options));
}

/// Options in the words of the command line, refused as it refuses them.
HowFitted how_asked(const PageRequest& r) {
  HowFitted how;
  NamedWords given(r.options.begin(), r.options.end());
  std::vector<std::string> names;
  const auto written = [](std::string_view name) {
    std::string word = "--" + std::string(name);
    std::ranges::replace(word, '_', '-');
    return word;
  };
  for_each_option(record_of<HowFitted>, &how, [&](const RecordField& f, void*) {
    names.push_back(written(f.name));
    const auto at = given.find(std::string(f.name));
    if (at == given.end() || !at->second.empty()) return;
    if (!is_flag(f)) throw wrong_usage(names.back() + " has no value");
    at->second = {"true"};
  });
  for (const auto& [name, words] : given)
    if (std::ranges::find(names, written(name)) == names.end())
      refuse_name(written(name), std::vector<std::string_view>(names.begin(), names.end()),
                  "option");
  take_words(record_of<HowFitted>, &how, given);
  return how;
}

/// The document, and the values that the page draws: also of parameters that the document has none of, being one of many.
Json fit_for_page(const FitResult& r) {
  Json optimum = Json::object();
  for (const auto& [name, values] : named_values(r.model)) optimum[name] = values;
  return {{"document", to_json(r.document)}, {"optimum", std::move(optimum)}};
}

}  // namespace

std::string answer_page(const std::string& request,
                        const std::function<void(const std::string&)>& phase) {
  PageRequest r;
  read_record(JsonDocument("the request", request).root(), r);
  const HowFitted how = how_asked(r);
  switch (r.command) {
    case PageCommand::read:
      return line_of(read_for_page(r, how, phase));
    case PageCommand::fit:
      return line_of(fit_for_page(fit_files({r.file}, how, phase).result));
    case PageCommand::models:
      return compare_for_page(r, how, phase);
  }
  return "";
}

}  // namespace gonio
