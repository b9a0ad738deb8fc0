// Multiple scattering over columns, per instruction set.
#include "scene/kernel/layer.h"

#include "brdf/formula/scattering.h"
#include "brdf/kernel/lane.h"

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
  using B = Lane<F>;
  brighten(x, curve, strength, m, [](const B& f, const B& e, const B& f0) {
    const std::array p{f, e, f0};
    return Turquin<B>::apply(p)[0] - f;
  });
}

template <class F>
void fdez_aguera(const Block<F>& x,
                 const AlbedoCurve<F>& curve,
                 const std::array<F, max_channels>& strength,
                 const MultipleColumns<F>& m) {
  using B = Lane<F>;
  brighten(x, curve, strength, m, [](const B& f, const B& e, const B& f_average) {
    const B bounced = f_average * (1 - e);
    return f * bounced / (1 - bounced);
  });
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
    const B lost = (1 - value_at<B>(albedo, load<B>(x.nol + i))) *
                   (1 - value_at<B>(albedo, load<B>(x.nov + i)));
    for (std::size_t c = 0; c < max_channels; ++c)
      store<B>(m.f[c] + i, load<B>(m.f[c] + i) + B(strength[c]) * lost);
  }
}

extern const LayerKernels<float> layer_float;
extern const LayerKernels<double> layer_double;
const LayerKernels<float> layer_float{GONIO_TEXT(GONIO_ARCH), turquin<float>, fdez_aguera<float>,
                                      kulla_conty<float>};
const LayerKernels<double> layer_double{GONIO_TEXT(GONIO_ARCH), turquin<double>,
                                        fdez_aguera<double>, kulla_conty<double>};

}  // namespace GONIO_ARCH
}  // namespace gonio::scene
