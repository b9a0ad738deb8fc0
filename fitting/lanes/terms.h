#pragma once
/// \file
/// The terms of a role over texels, one loop each.  Included by the one file of each role, compiled per instruction set.

#include "brdf/kernel/term_kernels.h"
#include "brdf/kernel/tilt.h"
#include "brdf/model/derivatives.h"

namespace gonio::inline GONIO_ARCH {

template <template <class> class Term>
void tilted(const Block<float>& x, const float* p, float* value, float* const* d) {
  using B = Lane<float>;
  using Way = TexelsAsLanes<false>;
  constexpr std::size_t N = Term<B>::parameters.size() + 2;
  using T = Dual<B, N, true>;
  const auto term =
      bind<Term<T>, T, Way>(p, [](const B& v, std::size_t k) { return T::variable(v, k); });
  for (std::size_t i = 0; i < x.n; i += lanes<B>) {
    const T t = as_value<T>(term(tilting<N>(angles_with<true, Way>(x, i))));
    store<B>(value + i, t.v);
    for (std::size_t k = 0; k < N; ++k) store<B>(d[k] + i, t.d[k]);
  }
}

template <template <class> class Term>
constexpr TexelTerms<float>::Derivatives tilted_entry() {
  if constexpr (is_anisotropic<Term<float>>)
    return nullptr;
  else
    return tilted<Term>;
}

template <template <class> class... Terms>
constexpr auto texel_table(TermList<Terms...>) {
  return std::array<TexelTerms<float>::Derivatives, sizeof...(Terms)>{
      derivatives<Terms, float, TexelsAsLanes<false>>...};
}
template <template <class> class... Terms>
constexpr auto tilted_table(TermList<Terms...>) {
  return std::array<TexelTerms<float>::Derivatives, sizeof...(Terms)>{tilted_entry<Terms>()...};
}

/// Defined in the file of each role: its terms, given normals and tilted ones.
template <Role role>
std::array<std::span<const TexelTerms<float>::Derivatives>, 2> texel_terms_of();

#define GONIO_TEXEL_TERMS_OF(role, list)                                                  \
  template <>                                                                             \
  std::array<std::span<const TexelTerms<float>::Derivatives>, 2> texel_terms_of<role>() { \
    static constexpr auto given = texel_table(list{});                                    \
    static constexpr auto tilt = tilted_table(list{});                                    \
    return {given, tilt};                                                                 \
  }

}  // namespace gonio::inline GONIO_ARCH
