// Facts of the cost report for the index: times of terms and of whole models in cache.
#include "reports/cost/cost.h"

namespace gonio {

Facts facts(const CostRows& r) {
  Facts f;
  const auto& best = r.machine.instruction_sets.back();
  f.setting = Facts::Setting{r.machine.cpu, r.machine.threads, best, r.others};
  for (const auto& row : r.rows) {
    if (row.number != "float" || row.isa != best || is_mistake(row)) continue;
    const Facts::Time time{row.id, row.time.ns, row.time.spread_ns, row.each};
    if (row.memory == "cache" && row.way.empty()) f.in_cache.push_back(time);
    if (row.memory == "cache" && row.way == "fused" && row.id == "ggx/smith_ggx.correlated/schlick")
      f.setting->model_ns = row.time.ns;
    // Few models have a fused loop.
    if (row.memory == "cache" && row.way == "composed") f.whole.push_back(time);
  }
  return f;
}

}  // namespace gonio
