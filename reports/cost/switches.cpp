// Cost of going from one form to another: pairs that engineers consider.
#include <algorithm>
#include <cmath>
#include <limits>

#include "reports/cost/cost.h"

namespace gonio {
namespace {

struct Pair {
  std::string_view question, from, to;
};
constexpr Pair pairs[] = {
    {"Schlick's k = (r+1)²/8 to exact Smith, separable", "masking.schlick_ggx.direct",
     "masking.smith_ggx.separable"},
    {"Schlick's k = (r+1)²/8 to exact Smith, correlated", "masking.schlick_ggx.direct",
     "masking.smith_ggx.correlated"},
    {"Schlick's k = α/2 to exact Smith, separable", "masking.schlick_ggx.half_alpha",
     "masking.smith_ggx.separable"},
    {"Schlick's k = α/2 to exact Smith, correlated", "masking.schlick_ggx.half_alpha",
     "masking.smith_ggx.correlated"},
    {"Unreal's joint form to exact Smith, correlated", "masking.ue_joint",
     "masking.smith_ggx.correlated"},
    {"Smith separable to correlated", "masking.smith_ggx.separable",
     "masking.smith_ggx.correlated"},
    {"Walter's rational Beckmann to exact", "masking.smith_beckmann.rational",
     "masking.smith_beckmann.correlated"},
    {"Schlick to the exact dielectric", "fresnel.schlick", "fresnel.dielectric"},
    {"Schlick to F82", "fresnel.schlick", "fresnel.f82"},
    {"Schlick to the exact conductor", "fresnel.schlick", "fresnel.conductor"},
    {"Beckmann to GGX", "ndf.beckmann", "ndf.ggx"},
    {"GGX to GTR with free gamma", "ndf.ggx", "ndf.gtr"},
    {"Smith of GGX to Smith of GTR", "masking.smith_ggx.correlated",
     "masking.smith_gtr.correlated"},
    {"Lambert to Disney's diffuse", "diffuse.lambert", "diffuse.disney"},
    {"A whole GGX model, Schlick's k to exact Smith", "ggx/schlick_ggx.direct/schlick",
     "ggx/smith_ggx.correlated/schlick"},
    {"A whole GGX model, Unreal's joint form (Hammon) to exact Smith", "ggx/hammon/schlick",
     "ggx/smith_ggx.correlated/schlick"},
    {"A whole GGX model, Schlick to the exact dielectric", "ggx/smith_ggx.correlated/schlick",
     "ggx/smith_ggx.correlated/dielectric"},
    {"A whole GGX model, Schlick to the exact conductor", "ggx/smith_ggx.correlated/schlick",
     "ggx/smith_ggx.correlated/conductor"},
    {"A whole model, GGX to GTR", "ggx/smith_ggx.correlated/schlick",
     "gtr/smith_gtr.correlated/schlick"},
    {"Unreal's mobile specular to Cook–Torrance with Lambert", "model.ue_mobile",
     "model.cook_torrance"},
    {"glTF to Disney", "model.gltf", "model.disney"}};

}  // namespace

bool is_mistake(const CostRow& r) {
  return r.id.ends_with(".as_written");
}

const CostRow* find_row(const std::vector<CostRow>& rows,
                        std::string_view id,
                        std::string_view number,
                        std::string_view isa,
                        std::string_view memory,
                        std::string_view way) {
  const auto at = std::ranges::find_if(rows, [&](const CostRow& r) {
    return r.id == id && r.number == number && r.isa == isa && r.memory == memory && r.way == way;
  });
  return at == rows.end() ? nullptr : &*at;
}

std::vector<CostSwitch> cost_switches(const std::vector<CostRow>& rows) {
  std::vector<CostSwitch> out;
  for (const auto& p : pairs)
    for (const auto& from : rows) {
      if (from.id != p.from) continue;
      // both in the same way, fused where both can be
      const auto there = [&](std::string_view id, std::string_view way) {
        return find_row(rows, id, from.number, from.isa, from.memory, way);
      };
      if (from.way == "by_hand" ||
          (from.way == "composed" && there(p.from, "fused") && there(p.to, "fused")))
        continue;
      const auto* to = there(p.to, from.way);
      if (!to) continue;
      // errors from different truths say nothing about each other
      const bool same = from.error.truth == to->error.truth;
      const auto more = difference(compared(from), compared(*to));
      out.push_back({std::string(p.question), from.id, to->id, from.isa, from.number, from.memory,
                     from.way, more.ns, more.spread_ns, to->time.ns / from.time.ns,
                     static_cast<double>(to->operations.total()) -
                         static_cast<double>(from.operations.total()),
                     same ? from.error.rms : no_value, same ? to->error.rms : no_value,
                     more.survives});
    }
  return out;
}

}  // namespace gonio
