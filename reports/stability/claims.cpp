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
      return fmt::format("is off by {} {:g}", x.lost == 0 ? "at most" : "more than", x.tolerance);
    return x.nonfinite + x.overflow > 0 ? std::string("has inputs without a value")
                                        : "is off by up to " + percent(x.worst_rel, 2);
  };
  to.judge(
      "F and G can be computed in half", "",
      verdict(keeps(*f) && keeps(*g), keeps(*f) || keeps(*g)),
      fmt::format("Schlick's F {}", lost(*f)),
      fmt::format("of every half there is, or those that a search found, Schlick's F {}. Unreal's "
                  "joint masking, clamped as it ships, {}.",
                  lost(*f), lost(*g)));
}

}  // namespace gonio::stabilities
