#pragma once
/// \file
/// A frame for angles that come without one, for formulas that read directions but do not care how the surface is turned.

#include "geometry/angles.h"

namespace gonio::inline GONIO_ARCH {

/// Directions with these angles, h in the plane of n and x:
///
///   v = VoH h + t,  l = VoH h − t,  t = (NoV − NoL)/(2 sin θ_h) e + b y,  e ⟂ h in that plane,  |t|² = 1 − VoH²
///
/// h is exact and l + v = 2 VoH h; of l and v only the azimuth about h is as good as NoV − NoL.
template <Real B>
FrameAngles<B> with_frame(const Angles<B>& a) {
  const B sine = sqrt(max<B>(a.sin2_theta_h, B(0)));
  const auto tilted = constant<B>(1e-18L) < sine;
  const B along = select<B>(tilted, (a.nov - a.nol) / (2 * select<B>(tilted, sine, B(1))), B(0));
  const B across = sqrt(max<B>(1 - a.voh * a.voh - along * along, B(0)));
  const B x = a.voh * sine, turned = along * a.noh;
  return {a, sine, B(0), x + turned, -across, x - turned, across};
}

}  // namespace gonio::inline GONIO_ARCH
