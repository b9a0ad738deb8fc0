#pragma once
/// \file
/// Light that a lobe's several bounces add to f, by the compensations of brdf/formula/scattering.h.

#include "brdf/formula/scattering.h"
#include "scene/kernel/albedo_curve.h"

namespace gonio::scene {
inline namespace GONIO_ARCH {

/// \param lobe, e  f of the lobe, and its albedo at F = 1 of the viewer's direction
template <Real T>
T added_by_turquin(const T& lobe, const T& e, const T& f0) {
  const std::array p{lobe, e, f0};
  return Turquin<T>::apply(p)[0] - lobe;
}
/// s/(1 − b) − s = s b/(1 − b),   b = F_avg (1 − E)
template <Real T>
T added_by_fdez_aguera(const T& lobe, const T& e, const T& f_average) {
  const T bounced = f_average * (1 - e);
  return lobe * bounced / (1 - bounced);
}
/// \param strength  f of two directions from which nothing comes out at once
/// \param lost      (1 − E_l)(1 − E_v), the same for all channels
template <Real T>
T added_by_kulla_conty(const T& strength, const T& lost) {
  return strength * lost;
}
template <Real T>
T lost_to_bounces(const AlbedoCurve<T>& albedo, const T& nol, const T& nov) {
  return (1 - value_at<T>(albedo, nol)) * (1 - value_at<T>(albedo, nov));
}

}  // namespace GONIO_ARCH
}  // namespace gonio::scene
