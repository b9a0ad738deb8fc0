#include "reports/cost/baseline.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/json/reader.h"

namespace gonio {
namespace {

double time_at(const JsonReader& row, const std::string& key, bool may_be_0) {
  const auto value = row.at(key);
  const double x = value.number();
  if (!(may_be_0 ? x >= 0 : x > 0)) value.fail(may_be_0 ? "a time from 0 on" : "a time above 0");
  return x;
}

EarlierCosts::Entry entry(const JsonReader& row) {
  return {{row.at("id").string(), row.at("number").string(), row.at("isa").string(),
           row.at("memory").string(), row.at("way").string()},
          {time_at(row, "ns", false), time_at(row, "ns_spread", true)}};
}

}  // namespace

CostName name_of(const CostRow& r) {
  return {r.id, std::string(r.number), r.isa, std::string(r.memory), std::string(r.way)};
}

namespace {

EarlierCosts costs_in(const JsonReader& document) {
  const auto schema = document.at("schema");
  if (const auto s = schema.string(); s != "gonio.bench/1" && s != "gonio.report.cost/1")
    schema.fail("gonio.bench/1 or gonio.report.cost/1");
  const auto machine = document.at("machine");
  EarlierCosts out{machine.at("cpu").string(),
                   machine.at("compiler").string(),
                   machine.at("flags").string(),
                   {}};
  const auto rows = document.at("rows");
  if (!rows.is_array()) rows.fail("an array");
  for (std::size_t i = 0; i < rows.size(); ++i) out.entries.push_back(entry(rows.at(i)));
  return out;
}

}  // namespace

EarlierCosts read_costs(const std::string& path) {
  return costs_in(JsonDocument(path).root());
}
EarlierCosts costs_of(const std::string& text, const std::string& name) {
  return costs_in(JsonDocument(name, text).root());
}

std::vector<CostChange> changes(const EarlierCosts& earlier,
                                const std::vector<CostRow>& rows,
                                std::string_view filter) {
  std::map<CostName, Timing> before;
  for (const auto& e : earlier.entries)
    if (e.name.id.find(filter) != e.name.id.npos) before.emplace(e.name, e.time);
  std::vector<CostChange> out;
  for (const auto& r : rows) {
    auto& c = out.emplace_back(CostChange{name_of(r), {}, r.time});
    const auto at = before.find(c.name);
    if (at == before.end()) continue;
    const Timing& old = at->second;
    c.before = old;
    c.ratio = r.time.ns / old.ns;
    c.spread = c.ratio * std::hypot(r.time.spread_ns / r.time.ns, old.spread_ns / old.ns);
    c.differs = std::abs(r.time.ns - old.ns) > 3 * (r.time.spread_ns + old.spread_ns);
    before.erase(at);
  }
  for (const auto& [name, time] : before) out.push_back({name, time, {}});
  return out;
}

}  // namespace gonio
