#include "fitting/judge/seen.h"

#include <algorithm>
#include <cmath>

#include "brdf/model/roughness.h"
#include "fitting/judge/undetermined.h"

#include <fmt/format.h>

namespace gonio {

namespace {

void forget_empty_channels(const Table& t, const Problem& p, Uncertainty& u) {
  for (std::size_t c = 0; c < t.channels.size(); ++c) {
    if (std::ranges::any_of(t.values[c], [&](double y) {
          return std::isfinite(y) && usable(p.options.metric, y, p.offset);
        }))
      continue;
    for (const auto& q : p.start.model.parameters) {
      if (q.count == 1 || !p.free.mask()[q.slot(c)]) continue;
      u[p.free.index(q.slot(c))].forget(no_value_of_channel);
    }
  }
}

void keep_to_highlights(TableFacts& facts,
                        const Problem& p,
                        std::span<const double> values,
                        const Misfit& misfit,
                        Uncertainty& u) {
  const Table& t = facts.table();
  if (p.start.model.lobes.empty()) return;
  if (facts.computed()) {
    forget_lobes(p, u, Lobes::whole, "each incident angle holds one constant: a computed table");
    return;
  }
  if (const auto retro = !misfit.reproduces() ? facts.retro() : std::nullopt) {
    forget_lobes(p, u, Lobes::fresnel,
                 fmt::format("the larger highlight ({:.3g} 1/sr) is at wo = wi, and none of it is "
                             "this lobe's",
                             retro->height));
    return;
  }
  if (t.truth) return;
  // The peak is the narrowest lobe's.
  const ModelParameter* narrowest = nullptr;
  for (const auto& q : p.start.model.parameters)
    if (is_alpha(q.name) && (!narrowest || values[q.first] < values[narrowest->first]))
      narrowest = &q;
  if (!narrowest || !p.free.mask()[narrowest->first]) return;
  const std::size_t i = p.free.index(narrowest->first);
  const double value = values[narrowest->first];
  if (value >= 0.1 && !(u[i].low_end(value) < 0.1)) return;
  using enum ParameterStatus;
  if (u[i].status != free && u[i].status != at_bound && u[i].status != unbounded) return;
  if (t.aperture) {  // the samples say how wide it is, though it lies between them
    constexpr double known = 1.0 / 32;  // of both widths: an eighth of how far h turns
    const double least = known * (t.aperture.light + t.aperture.detector);
    if (value < least)
      u[i].keep_limit(upper_limit, least,
                      "the lobe is narrower than an eighth of what the instrument sees at once");
    return;
  }
  const auto peak = facts.peak().peak;
  if (!peak || peak->resolved) return;
  // A width that meets the samples about the peak, too, is not wider than it.
  const double met = misfit.told ? 0 : std::fmax(value, u[i].high_end(value));
  u[i].keep_limit(upper_limit, std::max(peak->alpha, met),
                  misfit.told && value > peak->alpha ? "the table's highlight is no wider than this"
                                                     : "the samples do not resolve the highlight");
}

/// A width at the low end of all there are: narrower ones, or no lobe, would do as well.
void forget_least_widths(const Problem& p, std::span<const double> values, Uncertainty& u) {
  for (const auto& q : p.start.model.parameters) {
    if (!is_alpha(q.name) || !p.free.mask()[q.first]) continue;
    const std::size_t i = p.free.index(q.first);
    constexpr double next_to = 1 + 1e-3;
    if (u[i].status == ParameterStatus::at_bound && !p.narrowed[i] &&
        values[q.first] <= p.bounds.low[i] * next_to)
      u[i].forget("narrower than the samples can tell");
  }
}

}  // namespace

void keep_to_what_is_seen(TableFacts& facts,
                          const Problem& p,
                          std::span<const double> values,
                          const Misfit& misfit,
                          Uncertainty& u) {
  forget_empty_channels(facts.table(), p, u);
  keep_to_highlights(facts, p, values, misfit, u);
  forget_least_widths(p, values, u);
}

}  // namespace gonio
