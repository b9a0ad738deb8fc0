#include "reports/audit/audit.h"

#include <mutex>

#include "brdf/catalogue/registry.h"
#include "brdf/model/presets.h"
#include "integrate/light/split_sum.h"
#include "reports/audit/entry.h"

#include <tbb/parallel_for.h>

namespace gonio {
namespace {

EntryAudit audit_entry(std::string_view id) {
  using namespace auditing;
  if (id == split_sum_about.id) return audit_split_sum();
  if (const auto map = find_map(id)) return audit_map(*map);
  if (const auto* preset = find_preset(id)) return audit_model(*preset);
  return audit_term(find_term(id));
}

}  // namespace

std::vector<std::string_view> auditable_ids() {
  std::vector<std::string_view> ids;
  for (const auto& t : catalogue()) ids.push_back(t.about->id);
  for (const auto& m : maps()) ids.push_back(m.about->id);
  for (const auto& p : presets()) ids.push_back(p.about.id);
  ids.push_back(split_sum_about.id);
  return ids;
}

std::vector<EntryAudit> audit(const std::vector<std::string>& ids,
                              const std::function<void(std::size_t)>& done) {
  for (const auto& id : ids)  // an unknown one is refused before any work
    if (!find_map(id) && !find_preset(id) && id != split_sum_about.id) find_term(id);
  std::vector<EntryAudit> entries(ids.size());
  std::mutex mutex;
  std::size_t count = 0;
  tbb::parallel_for(std::size_t{0}, ids.size(), [&](std::size_t i) {
    entries[i] = audit_entry(ids[i]);
    const std::lock_guard lock(mutex);
    if (done) done(++count);
  });
  return entries;
}

}  // namespace gonio
