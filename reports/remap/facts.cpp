// What the index decides by: how far each masking form for GGX is from exact Smith.
#include <algorithm>

#include "reports/remap/remap.h"

namespace gonio {

Facts facts(const RemapRows& r) {
  Facts f;
  const auto reference = references_of("ndf.ggx")[1];
  for (const auto& form : r.forms)
    if (const auto rms = overall_rms(r, form.form, reference))
      f.masking.push_back({form.form, *rms});
  // Several are the same values in other words: the one of fewer operations comes first.
  std::ranges::stable_sort(f.masking, {}, [&](const Facts::Masking& m) {
    return find_form(r.forms, m.form)->operations;
  });
  return f;
}

}  // namespace gonio
