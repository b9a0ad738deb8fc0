#pragma once
/// \file
/// Unit of light of an engine: what its shipped formulas leave out, and bring along with the light.

#include <numbers>
#include <string_view>

namespace gonio {

/// Divisor that makes a BRDF of a shipped term or model: π of Unreal's mobile forms, whose lights come divided by it; else 1.
constexpr double light_unit(std::string_view id) {
  for (const std::string_view without_pi :
       {"ndf.ggx.ue_mobile", "ndf.ggx.mobile", "ndf.ggx.mobile.cross", "model.ue_mobile",
        "model.ue_mobile_simple"})
    if (id == without_pi) return std::numbers::pi;
  return 1;
}

}  // namespace gonio
