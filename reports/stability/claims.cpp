// The claim that half is enough for F and G, by the rows of the atlas.
#include <algorithm>

#include "reports/finding/words.h"
#include "reports/stability/measure.h"

#include <fmt/format.h>

namespace gonio::stabilities {
namespace {

const StabilityRow* row_of(const StabilityRows& r, std::string_view id) {
  const auto at = std::ranges::find_if(
      r.rows, [&](const StabilityRow& x) { return x.id == id && x.number == "half"; });
  return at == r.rows.end() ? nullptr : &*at;
}

/// What the clamp of that masking changes besides.
std::string by_clamp(const StabilityRows& r) {
  const auto at = std::ranges::find_if(r.clamps, [](const ClampRow& c) {
    return c.where == "masking.ue_joint.clamped" && c.number == "half";
  });
  if (at == r.clamps.end() || !at->changed_to) return {};
  return fmt::format(
      " Its clamp changes values by up to {}, and by over 1\u00a0% where the {} is at most {:.2g}.",
      percent_at_most(at->changed_most), at->by, *at->changed_to);
}

}  // namespace

void judge_f_and_g_in_half(Findings& to, const StabilityRows& r) {
  const auto *f = row_of(r, "fresnel.schlick"), *g = row_of(r, "masking.ue_joint.clamped");
  if (!f || !g) return;
  const auto keeps = [](const StabilityRow& x) {
    return (x.is_absolute ? x.lost == 0 : x.worst_rel <= x.tolerance) &&
           x.nonfinite + x.overflow == 0;
  };
  const auto lost = [](const StabilityRow& x) {
    if (x.is_absolute && x.nonfinite + x.overflow == 0)
      return x.lost == 0 ? fmt::format("is off by at most {:g} of full light", x.tolerance)
                         : fmt::format("is off by more than {:g} of full light at {} of the inputs",
                                       x.tolerance,
                                       percent_at_most(static_cast<double>(x.lost) /
                                                       static_cast<double>(x.evaluations)));
    return x.nonfinite + x.overflow > 0 ? std::string("has inputs without a value")
                                        : "is off by up to " + percent_at_most(x.worst_rel);
  };
  to.judge("F and G can be computed in half", "",
           verdict(keeps(*f) && keeps(*g), keeps(*f) || keeps(*g)),
           fmt::format("Schlick's F {}", lost(*f)),
           fmt::format("for Schlick's F all halves were tried. Unreal's clamped joint masking {} "
                       "by rounding, as far as "
                       "a search found.{}",
                       lost(*g), by_clamp(r)));
}

}  // namespace gonio::stabilities
