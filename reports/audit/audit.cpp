#include "reports/audit/audit.h"

#include <mutex>

#include "base/rounded.h"
#include "base/whole_loop.h"
#include "brdf/catalogue/registry.h"
#include "brdf/model/presets.h"
#include "integrate/light/split_sum.h"
#include "reports/audit/entry.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

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

std::string verdict(const EntryAudit& e) {
  constexpr double far = 0.1, near = 1e-6;
  std::vector<std::string> words;
  if (e.mistake) words.emplace_back("a mistake");
  if (!e.violates.empty()) words.push_back(fmt::format("breaks {}", fmt::join(e.violates, ", ")));
  if (words.empty()) words.emplace_back("keeps the laws");
  if (e.energy_is_shared) words.emplace_back("has no masking of its own");
  if (e.energy && e.energy_under_lobe && e.energy_under_lobe->value > 1 + near)
    words.push_back(fmt::format("{:.2g} with a lobe on it", e.energy_under_lobe->value));
  if (e.distance) {
    const double off = e.distance->most.value;
    const auto of = e.distance->reference.substr(e.distance->reference.find('.') + 1);
    words.push_back(off > far    ? fmt::format("far from {} (up to {})", of, rounded_up(off))
                    : off > near ? fmt::format("{:.1g} from {}", off, of)
                                 : fmt::format("equal to {}", of));
  }
  return fmt::format("{}", fmt::join(words, "; "));
}

std::vector<EntryAudit> audit(const std::vector<std::string>& ids,
                              const std::function<void(std::size_t)>& done) {
  for (const auto& id : ids)  // an unknown one is refused before any work
    if (!find_map(id) && !find_preset(id) && id != split_sum_about.id) find_term(id);
  std::vector<EntryAudit> entries(ids.size());
  std::mutex mutex;
  std::size_t count = 0;
  for_each_whole(ids.size(), [&](std::size_t i) {
    entries[i] = audit_entry(ids[i]);
    const std::lock_guard lock(mutex);
    if (done) done(++count);
  });
  return entries;
}

}  // namespace gonio
