#pragma once
/// \file
/// Fresnel reflectance of a metal by its spectrum, as a colour.

#include <array>
#include <cstddef>
#include <utility>

#include "geometry/angles.h"
#include "optics/fresnel.h"

namespace gonio::scene {

/// N = η + i k in 16 bands of wavelengths, and what each adds to red, green and blue.  \see waveband_colours
template <class T>
struct SpectralMetal {
  static constexpr std::size_t bands = 16;
  std::array<T, bands> eta{}, k{};
  std::array<std::array<T, bands>, 3> weight{};  ///< [channel][band]

  template <class S>
  SpectralMetal<S> in() const {
    SpectralMetal<S> m;
    for (std::size_t b = 0; b < bands; ++b) {
      m.eta[b] = S(eta[b]);
      m.k[b] = S(k[b]);
      for (std::size_t c = 0; c < 3; ++c) m.weight[c][b] = S(weight[c][b]);
    }
    return m;
  }
};

inline namespace GONIO_ARCH {

/// Red, green and blue of Fresnel's equations in every band.
///
///   F_c = Σ_b weight_cb F(η_b, k_b, VoH)
template <Real T>
class SpectralReflectance {
 public:
  explicit SpectralReflectance(const SpectralMetal<T>& m)
      : f_(of_bands(m, std::make_index_sequence<bands>{})), weight_(m.weight) {}
  std::array<T, 3> operator()(const T& voh) const {
    const Angles<T> a{voh, voh, voh, voh, voh};  // of which F reads VoH alone
    std::array<T, 3> sum{T(0), T(0), T(0)};
    for (std::size_t b = 0; b < bands; ++b) {
      const T f = f_[b](a).value();
      for (std::size_t c = 0; c < 3; ++c) sum[c] = sum[c] + weight_[c][b] * f;
    }
    return sum;
  }

 private:
  static constexpr std::size_t bands = SpectralMetal<T>::bands;
  template <std::size_t... b>
  static std::array<Conductor<T>, bands> of_bands(const SpectralMetal<T>& m,
                                                  std::index_sequence<b...>) {
    return {Conductor<T>(std::array{m.eta[b], m.k[b]})...};
  }

  std::array<Conductor<T>, bands> f_;
  std::array<std::array<T, bands>, 3> weight_;
};

/// Lobe on what lies under it.  A colour's F may be above 1, as gold's red is; no more than all is kept from below.
template <Real T>
T spectral_lobe(const T& base, const T& under, const T& dv, const T& f) {
  return base + dv * f - under * min<T>(f, T(1));
}

}  // namespace GONIO_ARCH

}  // namespace gonio::scene
