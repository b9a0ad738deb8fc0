#pragma once
/// \file
/// Lobes as surfaces: those terms of the catalogue that describe Smith's microsurface, on which light may
/// be followed from facet to facet.

#include <vector>

#include "brdf/model/model.h"

namespace gonio {

/// Facets whose slopes have GGX's or Beckmann's density, at heights and slopes that know nothing of their
/// neighbours' [Smith 1967; Heitz 2014], and the Fresnel term of each.
struct Microsurface {
  enum class Slopes { ggx, beckmann } slopes;
  double alpha_x, alpha_y;
  TermUse fresnel;
};

/// Those of the model's lobes, in their order.  A lobe is one where its distribution stands under its
/// own Smith masking, correlated: ndf.ggx, ndf.beckmann, and the anisotropic of both.  Any other is wrong
/// usage; so is a model without lobes.
std::vector<Microsurface> microsurfaces(const BoundModel&);

}  // namespace gonio
