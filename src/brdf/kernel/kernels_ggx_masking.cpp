// Compiled once per instruction set (GONIO_ARCH): GGX's D with every masking and shadowing in one
// loop.
#include "brdf/catalogue/masking_terms.h"
#include "brdf/formula/ndf_ggx.h"
#include "brdf/kernel/lane.h"
#include "brdf/term/product.h"

namespace gonio::inline GONIO_ARCH {
namespace {

template <template <class> class V, class F>
void with_ggx(const Block<F>& x, const F* ggx, const F* p, F* out) {
  using B = Lane<F>;
  const LobeShape<Ggx, V, B> shape{bind_value<Ggx, F>(ggx), bind_value<V, F>(p)};
  for (std::size_t i = 0; i < x.n; i += lanes<B>)
    store<B>(out + i, shape(angles_with<shape.anisotropic>(x, i)).value());
}

template <class F, template <class> class... Terms>
constexpr auto table_of(TermList<Terms...>) {
  return std::array{&with_ggx<Terms, F>...};
}

}  // namespace

/// [masking term]
template <class F>
std::span<const typename TermKernels<F>::WithGgx> maskings_with_ggx();
template <>
std::span<const TermKernels<float>::WithGgx> maskings_with_ggx<float>() {
  static constexpr auto table = table_of<float>(MaskingTerms{});
  return table;
}
template <>
std::span<const TermKernels<double>::WithGgx> maskings_with_ggx<double>() {
  static constexpr auto table = table_of<double>(MaskingTerms{});
  return table;
}

}  // namespace gonio::inline GONIO_ARCH
