#pragma once
/// \file
/// The laws by which a coat lies on what is below it [1/sr].
///
///   by facet        f = F D V + (1 − F) f_below,   F at VoH
///   by view         f = f_coat + (1 − R(v)) f_below
///   by both         f = f_coat + (1 − R(l)) (1 − R(v)) f_below
///
/// R(w) is the part of light from w that the coat reflects: its directional albedo E, or its F at that cosine.

#include "brdf/term/product.h"

namespace gonio::inline GONIO_ARCH {

/// f by facet: what a facet reflects is missing below it.  Scenes have this law, and coupled diffuse terms below the first lobe.
/// It is the same where light and view change places.  [Burley 2012; glTF 2.0, Appendix B]
template <class T>
T coated_by_facet(const T& below, const T& dv, const T& f) {
  return lobe_on(below, below, One{}, dv, f);
}

/// Part of f_below that is left by view.  With R = E on white, E + (1 − E) = 1: all light comes back.  Where light and view change
/// places f changes.  [glTF 2.0, KHR_materials_clearcoat, with w F; MaterialX 1.39.5, mx_layer_bsdf, with w E]
template <class T>
T left_by_view(const T& view) {
  return 1 - view;
}

/// Part of f_below that is left by both.  It is the same where light and view change places, and white keeps back what R takes of the
/// light again.  [Kelemen, Szirmay-Kalos 2001, without their norm]
template <class T>
T left_by_both(const T& light, const T& view) {
  return (1 - view) * (1 - light);
}

}  // namespace gonio::inline GONIO_ARCH
