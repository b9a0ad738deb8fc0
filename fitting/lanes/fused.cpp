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
template <class Model, bool shared>
using Fit = FusedNormal<float, Model, TexelsAsLanes<shared>>;
template <class Model, bool shared>
using LinearFit = FusedNormal<float, Model, TexelsAsLanes<shared>, false>;

template <class Model>
constexpr FusedTexels entry() {
  constexpr auto id = Link::identity, log = Link::log;
  using Lanes = Fit<Model, false>;
  using Shared = Fit<Model, true>;
  return {ids_of<float>(Model{}),
          {Lanes::columns(), Lanes::K - 1},
          {LinearFit<Model, false>::columns(), LinearFit<Model, false>::K - 1},
          {{{normal<Lanes, id>, normal<Lanes, log>}, {normal<Shared, id>, normal<Shared, log>}}},
          {normal<LinearFit<Model, false>, id>, normal<LinearFit<Model, true>, id>},
          {{{worth<Lanes, id>, worth<Lanes, log>}, {worth<Shared, id>, worth<Shared, log>}}}};
}
template <class... Models>
constexpr auto table(FusedList<Models...>) {
  return std::array{entry<Models>()...};
}

using Hot =
    FusedList<ModelTerms<TermList<Lambert>, TermList<Ggx, SmithGgxCorrelated, Schlick>>,
              ModelTerms<TermList<Lambert>, TermList<GgxAniso, SmithGgxAnisoCorrelated, Schlick>>,
              ModelTerms<TermList<Lambert>, TermList<Gtr, SmithGgxCorrelated, Schlick>>>;

}  // namespace

std::span<const FusedTexels> fused_texels();
std::span<const FusedTexels> fused_texels() {
  static constexpr auto all = table(Hot{});
  return all;
}

}  // namespace gonio::inline GONIO_ARCH
