// JSON Schemas of the documents that the program reads and writes.
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/nearest_names.h"
#include "cli/line/command.h"
#include "fitting/batch/batch_document.h"
#include "fitting/batch/gather.h"
#include "fitting/choice/document.h"
#include "fitting/export/export.h"
#include "fitting/export/map_export.h"
#include "fitting/map/fit_map.h"
#include "fitting/map/gather.h"
#include "fitting/result/document.h"
#include "reports/audit/audit.h"
#include "reports/cost/baseline.h"
#include "reports/index/index_page.h"
#include "reports/index/kinds.h"
#include "reports/pages/fit_page.h"
#include "reports/pages/inspect_page.h"
#include "reports/pages/models_page.h"
#include "scene/description/scene.h"
#include "scene/plan/document.h"
#include "scene/plan/verify.h"
#include "shader/shader.h"
#include "stability/answer.h"
#include "stack/stack.h"
#include "table/format/metadata.h"
#include "table/health/health.h"
#include "validate/validate.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio::cli {
namespace {

struct Options {
  std::optional<std::string> name;
};

std::vector<std::pair<std::string, std::function<std::string()>>> schemas() {
  std::vector<std::pair<std::string, std::function<std::string()>>> all{
      {"table", side_file_schema},
      {"inspect", health_schema},
      {"inspect.page", inspect_page_schema},
      {"fit", fit_schema},
      {"fit.page", fit_page_schema},
      {"models", models_schema},
      {"models.page", models_page_schema},
      {"batch", batch_schema},
      {"failure", failure_schema},
      {"list", list_schema},
      {"stack", stack_schema},
      {"map", map_schema},
      {"map_tiles", map_tiles_schema},
      {"compare", comparison_schema},
      {"export", export_schema},
      {"map_export", map_export_schema},
      {"shader", shader::shader_schema},
      {"audit", audit_schema},
      {"stability", stability::answer_schema},
      {"choice", choice_schema},
      {"validation", validation_schema},
      {"scene", scene::scene_schema},
      {"plan", scene::plan_schema},
      {"verification", scene::verification_schema},
      {"bench", bench_schema},
      {"report.index", index_schema}};
  for (const auto& kind : report_kinds())
    all.emplace_back("report." + std::string(kind.name), kind.schema);
  return all;
}

Exit run(const Options& o) {
  std::vector<std::string_view> names;
  const auto all = schemas();
  for (const auto& [name, schema] : all) {
    if (name == o.name) {
      fmt::print("{}", schema());
      return Exit::done;
    }
    names.push_back(name);
  }
  if (o.name) refuse_name(*o.name, names, "schema");
  fmt::print("{}\n", fmt::join(names, "\n"));
  return Exit::done;
}

}  // namespace

void add_schema(CommandLine& line) {
  auto [c, o] = line.command<Options>(
      "schema", "Print the JSON Schema of a document that gonio reads or writes",
      "gonio schema fit > fit.schema.json", run);
  c.option("NAME", o->name, "Document; without it the names of all");
}

}  // namespace gonio::cli
