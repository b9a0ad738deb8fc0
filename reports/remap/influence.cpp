// How much masking matters at all: what GGX reflects without it, over what it reflects with exact
// Smith.
#include "reports/remap/influence.h"

#include <algorithm>

#include "reports/finding/words.h"

#include <fmt/format.h>

namespace gonio {
namespace {

/// Bounds of 'neither near grazing angles nor very rough'.
constexpr double least_mu = 0.5, most_roughness = 0.5;

}  // namespace

void judge_influence_of_masking(Findings& to, const RemapRows& r) {
  const auto *none = find_form(r.forms, "masking.none"),
             *smith = find_form(r.forms, "masking.smith_ggx.correlated");
  if (!none || !smith || none->at.size() != smith->at.size()) return;
  double within = 0, beyond = 0, roughness = 0, mu = 0;
  for (std::size_t i = 0; i < none->at.size(); ++i)
    for (std::size_t m = 0; m < r.mu.size(); ++m) {
      const double more = none->at[i].albedo[m] / smith->at[i].albedo[m] - 1;
      if (r.mu[m] >= least_mu - 1e-9 && none->at[i].roughness <= most_roughness + 1e-9)
        within = std::max(within, more);
      else if (more > beyond)
        beyond = more, roughness = none->at[i].roughness, mu = r.mu[m];
    }
  to.judge("except at grazing angles and high roughness, G matters little", "",
           verdict_on_small(within),
           fmt::format("GGX without G reflects up to {} more light", percent_at_most(within)),
           fmt::format("for cosines of {:g} or more and roughness up to {:g}. At cosine {:g} and "
                       "roughness {:g} GGX without G reflects {}.",
                       least_mu, most_roughness, mu, roughness,
                       beyond > 10 ? fmt::format("{:.0f} times as much", 1 + beyond)
                                   : percent_at_most(beyond) + " more"));
}

}  // namespace gonio
