#include "integrate/scattering/microsurface.h"

#include <algorithm>

#include "base/error.h"
#include "brdf/catalogue/registry.h"
#include "integrate/rule/slopes.h"

#include <fmt/format.h>

namespace gonio {
namespace {

struct Pair {
  std::string_view ndf, masking;
  Microsurface::Slopes slopes;
};
constexpr Pair pairs[] = {
    {"ndf.ggx", "masking.smith_ggx.correlated", Microsurface::Slopes::ggx},
    {"ndf.ggx_aniso", "masking.smith_ggx_aniso.correlated", Microsurface::Slopes::ggx},
    {"ndf.beckmann", "masking.smith_beckmann.correlated", Microsurface::Slopes::beckmann},
    {"ndf.beckmann_aniso", "masking.smith_beckmann_aniso.correlated",
     Microsurface::Slopes::beckmann},
};

}  // namespace

std::vector<Microsurface> microsurfaces(const BoundModel& m) {
  std::vector<Microsurface> surfaces;
  for (const auto& lobe : m.model.lobes) {
    const auto ndf = catalogue()[lobe.ndf.term].about->id;
    const auto masking = catalogue()[lobe.masking.term].about->id;
    const auto* const pair = std::ranges::find(pairs, ndf, &Pair::ndf);
    if (pair == std::end(pairs))
      throw wrong_usage(fmt::format(
          "'{}' is no surface to walk on: ggx, ggx_aniso, beckmann and beckmann_aniso are",
          short_id(ndf)));
    if (masking != pair->masking)
      throw wrong_usage(
          fmt::format("'{}' under '{}' is no surface to walk on: its own masking is '{}'",
                      short_id(ndf), short_id(masking), short_id(pair->masking)));
    const auto widths = term_parameters(m, lobe.ndf, 0);
    surfaces.push_back({pair->slopes, widths.front(), widths.back(), lobe.fresnel});
  }
  if (surfaces.empty())
    throw wrong_usage(
        fmt::format("'{}' has no lobe, so no facets to walk on", to_text(m.model.spec)));
  return surfaces;
}

}  // namespace gonio
