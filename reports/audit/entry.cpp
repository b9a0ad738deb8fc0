#include "reports/audit/entry.h"

#include <array>

#include "integrate/albedo/directional_albedo.h"
#include "reports/measure/samples.h"

#include <fmt/format.h>

namespace gonio::auditing {
namespace {

/// Rounding and clamps that change nothing stay below it.
constexpr double noticeable = 1e-6;

}  // namespace

void largest_albedo(std::optional<Worst>& most,
                    const BoundModel& b,
                    const std::string& where,
                    double unit) {
  static constexpr std::array mu{0.02, 0.1, 0.3, 0.6, 1.0};
  const auto albedo = directional_albedo(b, mu, 0, {.error = 1e-6});
  for (std::size_t i = 0; i < mu.size(); ++i) {
    const double value = albedo[i].value[0] / unit;
    if (most && !(value > most->value)) continue;
    most = Worst{value, albedo[i].error / unit, joined(where, fmt::format("NoV {}", mu[i]))};
  }
}

void judge(EntryAudit& e) {
  if (!e.about->named_for.empty() && e.distance) e.mistake = e.distance->most.value > noticeable;
  const auto violates = [&](std::string_view law, bool does) {
    if (does) e.violates.push_back(law);
  };
  violates("normalisation", e.normalisation && !(std::isfinite(e.normalisation->value) &&
                                                 std::abs(e.normalisation->value - 1) <=
                                                     noticeable + e.normalisation->error));
  violates("reciprocity", e.reciprocity && e.reciprocity->value > 1e-9);
  const auto makes_light = [](const std::optional<Worst>& w) {
    return w && w->value - w->error > 1 + noticeable;
  };
  // An uncoupled term keeps the law by itself; that a lobe on top is too much is no fault of
  // either.
  violates("energy", (!e.energy_is_shared && makes_light(e.energy)) ||
                         (!e.energy && makes_light(e.energy_under_lobe)));
  violates("range", (e.lowest && e.lowest->value < 0) ||
                        (e.highest && e.kind != "ndf" && e.kind != "diffuse" && e.kind != "map" &&
                         e.kind != "model" && e.highest->value > 1 + 1e-12));
  violates("finite", e.not_finite > 0);
}

}  // namespace gonio::auditing
