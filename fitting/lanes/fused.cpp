// Compiled once per instruction set (GONIO_ARCH): whole models over texels.
#include "brdf/kernel/fused.h"

#include "brdf/formula/diffuse.h"
#include "brdf/formula/masking.h"
#include "brdf/formula/ndf.h"
#include "brdf/formula/ndf_anisotropic.h"
#include "brdf/formula/ndf_ggx.h"
#include "fitting/lanes/worth.h"
#include "optics/fresnel_approximate.h"

namespace gonio::inline GONIO_ARCH {
namespace {

template <class Fit, Link link>
constexpr TexelPass normal = Fit::template pass<link, NormalSums, TexelArguments>;
template <class Fit, Link link>
constexpr TexelPass worth = Fit::template pass<link, WorthSums, TexelArguments>;

template <class Model, class Own, class All>
constexpr FusedTexels entry() {
  constexpr auto id = Link::identity, log = Link::log;
  using Lanes = FusedNormal<float, Model, Own>;
  using Shared = FusedNormal<float, Model, All>;
  using LinearLanes = FusedNormal<float, Model, Own, false>;
  using LinearShared = FusedNormal<float, Model, All, false>;
  return {ids_of<float>(Model{}),
          {Lanes::columns(), Lanes::K - 1},
          {LinearLanes::columns(), LinearLanes::K - 1},
          {{{normal<Lanes, id>, normal<Lanes, log>}, {normal<Shared, id>, normal<Shared, log>}}},
          {normal<LinearLanes, id>, normal<LinearShared, id>},
          {{{worth<Lanes, id>, worth<Lanes, log>}, {worth<Shared, id>, worth<Shared, log>}}}};
}
template <class Own, class All, class... Models>
constexpr auto table(FusedList<Models...>) {
  return std::array{entry<Models, Own, All>()...};
}

using OfGgx = ModelTerms<TermList<Lambert>, TermList<Ggx, SmithGgxCorrelated, Schlick>>;
using OfGtr = ModelTerms<TermList<Lambert>, TermList<Gtr, SmithGgxCorrelated, Schlick>>;
using Hot =
    FusedList<OfGgx,
              ModelTerms<TermList<Lambert>, TermList<GgxAniso, SmithGgxAnisoCorrelated, Schlick>>,
              OfGtr>;

}  // namespace

std::array<std::span<const FusedTexels>, 2> fused_texels();
std::array<std::span<const FusedTexels>, 2> fused_texels() {
  static constexpr auto given = table<TexelsAsLanes<false>, TexelsAsLanes<true>>(Hot{});
  static constexpr auto tilted = table<TiltedTexels, TiltedTexels>(FusedList<OfGgx, OfGtr>{});
  return {given, tilted};
}

}  // namespace gonio::inline GONIO_ARCH
