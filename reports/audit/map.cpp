#include <map>

#include "brdf/catalogue/registry.h"
#include "brdf/in_number/one_term.h"
#include "reports/audit/entry.h"
#include "reports/measure/samples.h"

namespace gonio::auditing {
namespace {

std::map<std::string, double> named(std::span<const Parameter> parameters, const Values& values) {
  std::map<std::string, double> m;
  for (std::size_t k = 0; k < parameters.size(); ++k)
    m[std::string(parameters[k].name)] = values[k];
  return m;
}

}  // namespace

EntryAudit audit_map(std::size_t map) {
  const auto& m = maps()[map];
  EntryAudit e;
  e.about = m.about;
  e.kind = "map";
  const auto value = [](std::size_t which, const MapEntry& entry, const Values& p) {
    return evaluate_map(which, Number::double_, named(entry.parameters, p), {}).values[0];
  };
  Differences all;
  const auto reference = find_map(m.about->reference());
  for (const auto& p : combinations(m.parameters)) {
    const auto out = value(map, m, p);
    for (std::size_t k = 0; k < out.size(); ++k) {
      const auto where = [&] { return joined(std::string(m.outputs[k]), text(m.parameters, p)); };
      look(e, out[k], where);
      if (reference) all.add(out[k] - value(*reference, maps()[*reference], p)[k], where);
    }
  }
  if (reference) e.distance = all.distance(maps()[*reference].about->id, m.outputs[0]);
  const auto& first = m.parameters[0];
  e.picture.x = first.name;
  e.picture.y = m.outputs[0];
  const double high = std::min(first.legal.high, 4.0);
  for (int i = 0; i <= 90; ++i) {
    Values p = defaults(m.parameters);
    p[0] = first.legal.low + (high - first.legal.low) * i / 90;
    e.picture.at.push_back(p[0]);
    e.picture.value.push_back(value(map, m, p)[0]);
    if (reference) e.picture.reference.push_back(value(*reference, maps()[*reference], p)[0]);
  }
  judge(e);
  return e;
}

}  // namespace gonio::auditing
