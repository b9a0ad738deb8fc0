// Compiled once per instruction set (GONIO_ARCH), with contraction, as shaders
// are.
#include "number/batch.h"
#include "reports/study/kernels.h"
#include "reports/study/sampling_weight.h"

namespace gonio::inline GONIO_ARCH {
namespace {

#ifdef GONIO_SCALAR
using Lanes = float;
#else
using Lanes = Batch<float>;
#endif

template <template <class> class Sampling>
void draw(const VectorColumns& views,
          const float* u,
          const float* w,
          float alpha,
          const std::array<float*, 4>& out) {
  using S = Sampling<Lanes>;
  const Lanes width(alpha);
  for (std::size_t i = 0; i < views.n; i += lanes<Lanes>) {
    const Vector3<Lanes> v{load<Lanes>(views.view[0] + i), load<Lanes>(views.view[1] + i),
                           load<Lanes>(views.view[2] + i)};
    const auto l = S::light(v, width, load<Lanes>(u + i), load<Lanes>(w + i));
    for (std::size_t k = 0; k < l.size(); ++k) store<Lanes>(out[k] + i, l[k]);
    store<Lanes>(out[3] + i, sampling_weight<S, Lanes>(v, width, l));
  }
}

template <template <class> class Sampling>
constexpr SamplingKernel kernel{Sampling<float>::id, Sampling<float>::name, draw<Sampling>};
constexpr SamplingKernel table[] = {kernel<GgxNormals>, kernel<GgxVisible2018>, kernel<GgxCaps>,
                                    kernel<GgxBounded>};

}  // namespace

extern const std::span<const SamplingKernel> sampling_table;
constinit const std::span<const SamplingKernel> sampling_table{table};

}  // namespace gonio::inline GONIO_ARCH
