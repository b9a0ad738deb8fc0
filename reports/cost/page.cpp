// The cost report as JSON and as a page.
#include "reports/page/page.h"

#include "reports/cost/baseline.h"
#include "reports/page/assets.h"
#include "reports/picture/json_numbers.h"

namespace gonio {
namespace {

PageJson row(const CostRow& r) {
  const bool known = !r.error.truth.empty();
  PageJson j{{"id", r.id},
             {"number", r.number},
             {"isa", r.isa},
             {"ns", page_json(r.time.ns)},
             {"ns_spread", page_json(r.time.spread_ns)},
             {"ops", r.kind == "by_hand" ? PageJson(nullptr) : PageJson(r.operations.total())},
             {"error_max", known ? page_json(r.error.max) : PageJson(nullptr)},
             {"error_rms", known ? page_json(r.error.rms) : PageJson(nullptr)},
             {"pareto", known ? PageJson(r.pareto) : PageJson(nullptr)},
             {"tie", r.tie},
             {"memory", r.memory},
             {"kind", r.kind},
             {"way", r.way},
             {"channels", r.channels},
             {"truth", r.error.truth},
             {"measure", r.error.measure},
             {"delta_e", page_json(r.error.delta_e)},
             {"bytes", r.bytes}};
  for (std::size_t k = 0; k < operation_names.size(); ++k)
    j["ops_" + std::string(operation_names[k])] = r.operations.by_kind[k];
  return j;
}

PageJson machine(const Machine& m) {
  PageJson caches = PageJson::array();
  for (const auto& c : m.caches)
    caches.push_back({{"level", c.level}, {"bytes", c.bytes}, {"type", c.type}});
  return {{"cpu", m.cpu},           {"threads", m.threads},
          {"caches", caches},       {"instruction_sets", m.instruction_sets},
          {"compiler", m.compiler}, {"flags", m.flags}};
}

PageJson settings(const Machine& m, const CostOptions& o, std::string_view schema) {
  return {{"schema", schema},
          {"full", o.full},
          {"machine", machine(m)},
          {"repetitions", o.timing.repetitions},
          {"cache_samples", o.cache_samples},
          {"stream_samples", o.stream_samples}};
}
PageJson rows_json(const std::vector<CostRow>& rows) {
  PageJson out = PageJson::array();
  for (const auto& r : rows) out.push_back(row(r));
  return out;
}

PageJson timing(const std::optional<Timing>& t) {
  if (!t) return nullptr;
  return {{"ns", page_json(t->ns)}, {"ns_spread", page_json(t->spread_ns)}};
}
PageJson change(const CostChange& c) {
  const bool both = c.before && c.now;
  return {{"id", c.name.id},
          {"number", c.name.number},
          {"isa", c.name.isa},
          {"memory", c.name.memory},
          {"way", c.name.way},
          {"before", timing(c.before)},
          {"now", timing(c.now)},
          {"ratio", both ? page_json(c.ratio) : PageJson(nullptr)},
          {"ratio_spread", both ? page_json(c.spread) : PageJson(nullptr)},
          {"differs", both ? PageJson(c.differs) : PageJson(nullptr)}};
}

}  // namespace

std::string costs_json(const Machine& m,
                       const CostOptions& o,
                       const std::vector<CostRow>& rows,
                       const std::vector<CostChange>& changes) {
  auto out = settings(m, o, "gonio.bench/1");
  out["rows"] = rows_json(rows);
  if (changes.empty()) return page_text(out);
  out["changes"] = PageJson::array();
  for (const auto& c : changes) out["changes"].push_back(change(c));
  return page_text(out);
}

std::string to_json(const CostReport& r) {
  PageJson points = PageJson::array(), switches = PageJson::array();
  for (const auto& p : r.rows.points)
    points.push_back({{"picture", p.picture},
                      {"series", p.series},
                      {"label", p.label},
                      {"ns", page_json(p.time.ns)},
                      {"ns_spread", page_json(p.time.spread_ns)},
                      {"error_rms", page_json(p.error)},
                      {"error_spread", page_json(p.error_spread)},
                      {"ops", p.operations},
                      {"bytes", p.bytes},
                      {"without_ns", page_json(p.without_ns)}});
  for (const auto& s : r.rows.switches)
    switches.push_back({{"question", s.question},
                        {"from", s.from},
                        {"to", s.to},
                        {"number", s.number},
                        {"isa", s.isa},
                        {"memory", s.memory},
                        {"way", s.way},
                        {"more_ns", page_json(s.ns)},
                        {"more_spread_ns", page_json(s.ns_spread)},
                        {"ratio_ns", page_json(s.ratio)},
                        {"more_ops", s.operations},
                        {"error_from", page_json(s.error_from)},
                        {"error_to", page_json(s.error_to)}});
  auto out = settings(r.rows.machine, r.rows.options, "gonio.report.cost/1");
  out["findings"] = r.findings.sentences;
  out["rows"] = rows_json(r.rows.rows);
  out["switches"] = switches;
  out["points"] = points;
  put_pictures(out, r.pictures);
  return page_text(out);
}

std::string cost_page_html(std::string_view data) {
  return make_report_page("What accuracy costs in time", data, assets::cost_js);
}

}  // namespace gonio
