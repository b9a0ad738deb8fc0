#include "scene/plan/verify.h"

#include <algorithm>

#include "base/json_describe.h"
#include "scene/plan/reference.h"

namespace gonio::scene {

bool Verification::holds() const {
  return std::ranges::all_of(materials, &VerifiedMaterial::holds);
}

Verification verify(const Scene& s,
                    const PlannedForms& planned,
                    std::uint64_t seed,
                    std::size_t samples,
                    const std::function<void(double)>& done) {
  constexpr std::uint64_t verifying = 1'000;  // after the planner's streams
  const Lit lit(s);
  Verification v{s.tolerance, {}};
  for (std::size_t m = 0; m < s.materials.size(); ++m) {
    if (!planned.by_material[m]) continue;
    const auto& look = lit.looks[m];
    VerifiedMaterial one{s.materials[m].name, {}, false};
    one.found = judge_fresh(s, lit.drawer(m, PlanOptions{}.directions), verifying + seed, samples,
                            look.surface(look.exact()), look.surface(*planned.by_material[m]));
    one.holds = one.found.bound <= 1 - s.tolerance.quantile && one.found.worst <= s.tolerance.max;
    v.materials.push_back(std::move(one));
    if (done) done(static_cast<double>(m + 1) / static_cast<double>(s.materials.size()));
  }
  return v;
}

std::string to_json(const Verification& v) {
  Json materials = Json::object();
  for (const auto& m : v.materials)
    materials[m.name] = {{"holds", m.holds},
                         {"exceeding", m.found.exceeding},
                         {"samples", m.found.samples},
                         {"upper_bound", m.found.bound},
                         {"confidence", v.tolerance.confidence},
                         {"worst", m.found.worst}};
  return text_of(
      Json{{"schema", "gonio.verification/1"}, {"holds", v.holds()}, {"materials", materials}});
}

}  // namespace gonio::scene
