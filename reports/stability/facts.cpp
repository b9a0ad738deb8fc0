// What the index decides by: which alpha GGX keeps its tolerance from, in few bits.
#include "reports/stability/stability.h"

namespace gonio {

Facts facts(const StabilityRows& r) {
  Facts f;
  for (const auto& row : r.rows)
    if (row.decides == "alpha" && row.id.starts_with("ndf.ggx"))
      f.precision.push_back({row.id, row.form, row.number, row.tolerance, row.safe_from});
  for (const auto& row : r.highlights)
    f.precision.push_back({row.id, "directions", row.number, row.tolerance, row.safe_from,
                           row.zenith_deg, row.least_f0});
  return f;
}

}  // namespace gonio
