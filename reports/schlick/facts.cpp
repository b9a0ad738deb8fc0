// What the index decides by: what each form does to the colour of a rough surface.
#include <algorithm>

#include "reports/schlick/schlick.h"

namespace gonio {

Facts facts(const SchlickRows& r) {
  Facts f;
  for (const auto& c : r.rough.colours) {
    if (c.form.ends_with(".as_written") || c.delta_e.empty()) continue;
    auto at = std::ranges::find_if(f.fresnel, [&](const Facts::Fresnel& x) {
      return x.form == c.form && x.material == c.material;
    });
    if (at == f.fresnel.end())
      at = f.fresnel.insert(
          at, {c.form, c.material.starts_with("IOR ") ? "dielectric" : "metal", c.material, 0, 0});
    const double most = *std::ranges::max_element(c.delta_e);
    at->delta_e = std::max(at->delta_e, most);
    if (c.mu == 1) at->head_on = most;
  }
  return f;
}

}  // namespace gonio
