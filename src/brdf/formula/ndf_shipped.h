#pragma once
/// \file
/// Normal distributions as shaders ship them, operation by operation: what they leave out, clamp and
/// cancel is what the audit shows.  Each stands for an exact one of ndf.h or ndf_ggx.h.

#include "brdf/formula/widths.h"
#include "brdf/term/term.h"

namespace gonio::inline GONIO_ARCH {

/// GTR with GGX's normalisation at every γ.
///
///   D = α² / (π (1 + (α² − 1) NoH²)^γ)
///
/// Normalised at γ = 2 alone: ∫ D cos θ dω is α² ln(1/α²)/(1 − α²) at γ = 1.  The shader has 3.1415
/// for π, 3e-5 more.  Near the peak 1 + (α² − 1) NoH² cancels: in float it is 0 for α = 1e-4, and at
/// γ = 10 even the true value exceeds the largest float where α < 1e-3.
template <Real T>
struct GtrAsWritten {
  static constexpr About about{"ndf.gtr.as_written",
                               "Generalised Trowbridge–Reitz, normalised as if γ were 2",
                               "D = α² / (π (NoH² (α² − 1) + 1)^γ)",
                               "D_GTR2, as printed in notes in circulation",
                               "",
                               "",
                               "ndf.gtr"};
  static constexpr std::array parameters{alpha_parameter, gamma_parameter};
  static constexpr bool as_shipped = true;

  T a2, gamma;

  explicit GtrAsWritten(std::span<const T, 2> p) : a2(p[0] * p[0]), gamma(p[1]) {}

  T operator()(const Angles<plain_t<T>>& a) const {
    const auto cos2 = a.noh * a.noh;
    const T den = 1 + (a2 - 1) * cos2;
    return a2 / (pi<plain_t<T>>() * exp(gamma * log(den)));
  }
};

/// GGX as a mobile port of Unreal Engine 4.27 has it: without 1/π, which the light's colour was to
/// bring along, and no larger than 2048, a value that fits a half.
///
///   D = min(α² / ((NoH α² − NoH) NoH + 1)², 2048)
///
/// α is a half and NoH a float there.  In float the denominator is 0 at the peak of α = 1e-4; the
/// clamp catches it.
template <Real T>
struct GgxUeMobile {
  static constexpr About about{"ndf.ggx.ue_mobile",
                               "GGX without 1/π, clamped (D_GGX_R2)",
                               "D = min(α² / ((NoH α² − NoH) NoH + 1)², 2048)",
                               "D_GGX_R2, as shipped",
                               "a mobile game on Unreal Engine 4.27",
                               "",
                               "ndf.ggx"};
  static constexpr std::array parameters{alpha_parameter};
  static constexpr bool as_shipped = true;

  T a2;

  explicit GgxUeMobile(std::span<const T, 1> p) : a2(in_float(p[0] * p[0])) {}

  T operator()(const Angles<plain_t<T>>& a) const {
    const T d = in_float((a.noh * a2 - a.noh) * a.noh + 1);
    return min<T>(a2 / (d * d), T(2048));
  }
};

/// The rest of GGX_Mobile once 1 − NoH² is there: n = NoH α, p = α / (1 − NoH² + n²), min(p², 2048).
/// Without 1/π: the engine divides the light's colour by π beforehand.  Roughness, NoH and the result
/// are halves there, all between them floats.
template <Real T>
struct GgxMobileBase {
  static constexpr std::array parameters{alpha_parameter};
  static constexpr bool as_shipped = true;

  T alpha;

  explicit GgxMobileBase(std::span<const T, 1> p) : alpha(in_float(p[0])) {}

  T from(const plain_t<T>& noh, const plain_t<T>& one_minus_noh2) const {
    const T n = in_float(noh * alpha);
    const T p = in_float(alpha / (one_minus_noh2 + n * n));
    const T d = in_float(p * p);
    return in_half(min<T>(d, T(2048)));
  }
};

/// GGX_Mobile, where 1 − NoH² cancels near the peak.  NoH is a half there, and 1 for angles up to 0.022: where α is
/// 0.03, D is then 2.4 times what it should be.
///
///   D = min((α / (1 − NoH² + (NoH α)²))², 2048)
template <Real T>
struct GgxMobile : GgxMobileBase<T> {
  static constexpr About about{"ndf.ggx.mobile",
                               "GGX without 1/π, clamped (GGX_Mobile)",
                               "D = min((α / (1 − NoH² + (NoH α)²))², 2048)",
                               "GGX_Mobile, as shipped, after Romain Guy",
                               "Unreal Engine 4 (mobile renderer)",
                               "",
                               "ndf.ggx"};
  using GgxMobileBase<T>::GgxMobileBase;

  T operator()(const Angles<plain_t<T>>& a) const {
    const auto noh = in_half(a.noh);  // and so is its square, until it is assigned
    return this->from(noh, in_float(1 - noh * noh));
  }
};

/// GGX_Mobile with |n × h|² for 1 − NoH², by Lagrange's identity: nothing cancels.
template <Real T>
struct GgxMobileCross : GgxMobileBase<T> {
  static constexpr About about{"ndf.ggx.mobile.cross",
                               "GGX without 1/π, clamped, by the cross product",
                               "D = min((α / (|n×h|² + (NoH α)²))², 2048)",
                               "Guy & Agopian 2018 (Filament), specular D",
                               "Unreal Engine 4 (mobile renderer, MOBILE_GGX_USE_FP16)",
                               "",
                               "ndf.ggx"};
  using GgxMobileBase<T>::GgxMobileBase;

  T operator()(const Angles<plain_t<T>>& a) const {
    return this->from(in_half(a.noh), a.sin2_theta_h);
  }
};

}  // namespace gonio::inline GONIO_ARCH
