#pragma once
/// \file
/// Masking terms that come from no distribution, and so have no roughness.  As V = G₂ / (4 NoL NoV)
/// [1/sr], like those of masking.h.

#include "brdf/term/term.h"
#include "number/special.h"

namespace gonio::inline GONIO_ARCH {

/// V-shaped grooves of equal slopes:  G = min(1, 2 NoH NoV/VoH, 2 NoH NoL/VoH)
///                                                                   [Cook & Torrance 1982]
/// With m and M the lesser and the greater of NoL and NoV,  V = NoH / (2 M max(2 m NoH, VoH)).
template <Real T>
struct CookTorrance {
  static constexpr About about{"masking.cook_torrance", "Cook–Torrance, V-shaped grooves",
                               "G2 = min(1, 2 NoH NoV/VoH, 2 NoH NoL/VoH)",
                               "Torrance & Sparrow 1967; Cook & Torrance 1982"};
  static constexpr std::array<Parameter, 0> parameters{};

  explicit CookTorrance(std::span<const T, 0>) {}

  Quotient<T> operator()(const Angles<plain_t<T>>& a) const {
    using P = plain_t<T>;
    const P least = min<P>(a.nol, a.nov), greatest = max<P>(a.nol, a.nov);
    return {T(a.noh), T(2 * greatest * max<P>(2 * least * a.noh, least_voh(a)))};
  }
};

/// G = NoL NoV / max(NoL, NoV),   V = 1 / (4 max(NoL, NoV))
template <Real T>
struct Neumann {
  static constexpr About about{"masking.neumann", "Neumann–Neumann", "G2 = NoL NoV / max(NoL, NoV)",
                               "Neumann & Neumann 1999; Neumann, Neumann & Szirmay-Kalos 1999",
                               "Unreal Engine 4 (Vis_Neumann)"};
  static constexpr std::array<Parameter, 0> parameters{};

  explicit Neumann(std::span<const T, 0>) {}

  Quotient<T> operator()(const Angles<plain_t<T>>& a) const {
    return {T(1), T(4 * max<plain_t<T>>(a.nol, a.nov))};
  }
};

/// G = NoL NoV / VoH²,   V = 1 / (4 VoH²);   G = NoH² 4 NoL NoV/(NoL + NoV)² ≤ 1.
template <Real T>
struct Kelemen {
  static constexpr About about{"masking.kelemen",
                               "Kelemen–Szirmay-Kalos",
                               "G2 = NoL NoV / VoH²",
                               "Kelemen & Szirmay-Kalos 2001",
                               "Filament (clear coat), Unreal Engine 4 (Vis_Kelemen)",
                               "masking.cook_torrance"};
  static constexpr std::array<Parameter, 0> parameters{};

  explicit Kelemen(std::span<const T, 0>) {}

  Quotient<T> operator()(const Angles<plain_t<T>>& a) const {
    return {T(1), T(4 * square(least_voh(a)))};
  }
};

/// G = NoL NoV, which costs nothing:  V = 1/4
template <Real T>
struct Implicit {
  static constexpr About about{"masking.implicit", "Implicit", "G2 = NoL NoV",
                               "Hoffman 2013, Background: Physics and Math of Shading",
                               "Unreal Engine 4 (Vis_Implicit)"};
  static constexpr std::array<Parameter, 0> parameters{};

  explicit Implicit(std::span<const T, 0>) {}

  T operator()(const Angles<plain_t<T>>&) const { return constant<T>(0.25L); }
};

/// No masking: G = 1,  V = 1 / (4 NoL NoV).
///
/// Has no bound where either direction grazes, so its domain is NoL, NoV > 0.  At 0 it is finite and
/// huge: 4 NoL NoV counts as the least normal number at the least.
template <Real T>
struct Unmasked {
  static constexpr About about{"masking.none", "None", "G2 = 1",
                               "the definition of D F G/(4 NoL NoV)"};
  static constexpr std::array<Parameter, 0> parameters{};

  explicit Unmasked(std::span<const T, 0>) {}

  Quotient<T> operator()(const Angles<plain_t<T>>& a) const {
    return {T(1), T(max<plain_t<T>>(4 * (a.nol * a.nov), least<plain_t<T>>()))};
  }
};

}  // namespace gonio::inline GONIO_ARCH
