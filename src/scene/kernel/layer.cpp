// Multiple scattering and spectra of metals over columns, per instruction set.
#include "scene/kernel/layer.h"

#include "brdf/kernel/lane.h"
#include "scene/kernel/multiple.h"

namespace gonio::scene {
inline namespace GONIO_ARCH {

#define GONIO_TEXT_OF(name) #name
#define GONIO_TEXT(name) GONIO_TEXT_OF(name)

/// f += lobe (made brighter by `of` − 1)
template <class F>
void brighten(const Block<F>& x,
              const AlbedoCurve<F>& curve,
              const std::array<F, max_channels>& strength,
              const MultipleColumns<F> m,
              auto&& added) {
  using B = Lane<F>;
  const auto albedo = curve.template in<B>();
  for (std::size_t i = 0; i < x.n; i += lanes<B>) {
    const B e = value_at<B>(albedo, load<B>(x.nov + i));
    for (std::size_t c = 0; c < max_channels; ++c)
      store<B>(m.f[c] + i, load<B>(m.f[c] + i) + added(load<B>(m.lobe[c] + i), e, B(strength[c])));
  }
}

template <class F>
void turquin(const Block<F>& x,
             const AlbedoCurve<F>& curve,
             const std::array<F, max_channels>& strength,
             const MultipleColumns<F>& m) {
  brighten(x, curve, strength, m, added_by_turquin<Lane<F>>);
}

template <class F>
void fdez_aguera(const Block<F>& x,
                 const AlbedoCurve<F>& curve,
                 const std::array<F, max_channels>& strength,
                 const MultipleColumns<F>& m) {
  brighten(x, curve, strength, m, added_by_fdez_aguera<Lane<F>>);
}

template <class F>
void kulla_conty(const Block<F>& x,
                 const AlbedoCurve<F>& curve,
                 const std::array<F, max_channels>& strength,
                 const MultipleColumns<F>& columns) {
  using B = Lane<F>;
  const auto m = columns;
  const auto albedo = curve.template in<B>();
  for (std::size_t i = 0; i < x.n; i += lanes<B>) {
    const B lost = lost_to_bounces(albedo, load<B>(x.nol + i), load<B>(x.nov + i));
    for (std::size_t c = 0; c < max_channels; ++c)
      store<B>(m.f[c] + i, load<B>(m.f[c] + i) + added_by_kulla_conty(B(strength[c]), lost));
  }
}

template <class F>
void spectral(const Block<F>& x, const SpectralMetal<F>& metal, const ChannelColumns<F>& columns) {
  using B = Lane<F>;
  const auto j = columns;
  const SpectralReflectance<B> reflectance(metal.template in<B>());
  for (std::size_t i = 0; i < x.n; i += lanes<B>) {
    const auto f = reflectance(load<B>(x.voh + i));
    const B factor = load<B>(j.factor + i);
    for (std::size_t c = 0; c < max_channels; ++c) {
      const B base = j.base[c] ? load<B>(j.base[c] + i) : B(0);
      store<B>(j.out[c] + i, spectral_lobe<B>(base, j.coupled ? base : B(0), factor, f[c]));
    }
  }
}

extern const LayerKernels<float> layer_float;
extern const LayerKernels<double> layer_double;
const LayerKernels<float> layer_float{GONIO_TEXT(GONIO_ARCH), turquin<float>, fdez_aguera<float>,
                                      kulla_conty<float>, spectral<float>};
const LayerKernels<double> layer_double{GONIO_TEXT(GONIO_ARCH), turquin<double>,
                                        fdez_aguera<double>, kulla_conty<double>, spectral<double>};

}  // namespace GONIO_ARCH
}  // namespace gonio::scene
