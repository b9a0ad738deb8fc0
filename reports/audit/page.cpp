// The audit as JSON and as a page.
#include "reports/page/page.h"

#include "reports/audit/audit.h"
#include "reports/page/assets.h"
#include "reports/picture/json_numbers.h"

namespace gonio {
namespace {

PageJson json(const std::optional<Worst>& w) {
  if (!w) return nullptr;
  return {{"value", page_json(w->value)}, {"error", page_json(w->error)}, {"where", w->where}};
}

PageJson json(const EntryAudit& e) {
  PageJson distance = nullptr, operations = nullptr;
  if (e.distance)
    distance = {{"reference", e.distance->reference},
                {"measure", e.distance->measure},
                {"max", page_json(e.distance->most.value)},
                {"where", e.distance->most.where},
                {"rms", page_json(e.distance->rms)}};
  if (e.operations) {
    operations = PageJson::object();
    for (std::size_t k = 0; k < operation_names.size(); ++k)
      operations[operation_names[k]] = e.operations->by_kind[k];
  }
  return {{"id", e.about->id},
          {"kind", e.kind},
          {"title", e.about->title},
          {"formula", e.about->formula},
          {"source", e.about->source},
          {"seed", e.about->seed},
          {"ships", e.about->ships},
          {"mistake", e.mistake},
          {"violates", e.violates},
          {"normalisation", json(e.normalisation)},
          {"reciprocity", json(e.reciprocity)},
          {"energy", json(e.energy)},
          {"energy_of", e.energy_of},
          {"energy_under_lobe", json(e.energy_under_lobe)},
          {"lowest", json(e.lowest)},
          {"highest", json(e.highest)},
          {"grazing", json(e.grazing)},
          {"not_finite", e.not_finite},
          {"distance", distance},
          {"operations", operations},
          {"picture",
           {{"x", e.picture.x},
            {"y", e.picture.y},
            {"at", page_json(e.picture.at)},
            {"value", page_json(e.picture.value)},
            {"reference", page_json(e.picture.reference)}}}};
}

}  // namespace

std::string to_json(const std::vector<EntryAudit>& entries) {
  PageJson list = PageJson::array();
  for (const auto& e : entries) list.push_back(json(e));
  return page_text({{"entries", list}});
}

std::string audit_page_html(std::string_view data) {
  return make_page("The catalogue, audited", data, assets::audit_js);
}

}  // namespace gonio
