#pragma once
/// \file
/// The loops of a term over columns, and the table of a role's terms.  Included by the one file of each
/// role, compiled per instruction set: it sees the formulas of that role alone.

#include <array>

#include "brdf/kernel/lane.h"
#include "brdf/term/product.h"
#include "brdf/term/term_list.h"
#include "number/dual.h"

namespace gonio::inline GONIO_ARCH {

template <template <class> class Term, class F>
void start_product(const Block<F>& x, const F* p, const ProductColumns<F>& j) {
  using B = Lane<F>;
  const auto term = bind_value<Term, F>(p);
  for (std::size_t i = 0; i < x.n; i += lanes<B>) {
    const auto q = as_quotient<B>(term(angles<Term<B>>(x, i)));
    store<B>(j.out + i, q.num);
    if constexpr (is_fraction<Term, F>) store<B>(j.out_den + i, q.den);
  }
}

template <template <class> class Term, class F, bool over_den>
void finish_product_over(const Block<F>& x, const F* p, const ProductColumns<F>& j) {
  using B = Lane<F>;
  const auto term = bind_value<Term, F>(p);
  for (std::size_t i = 0; i < x.n; i += lanes<B>) {
    const auto q = as_quotient<B>(term(angles<Term<B>>(x, i)));
    const B num = load<B>(j.num + i) * q.num;
    if constexpr (over_den)
      store<B>(j.out + i, num / (load<B>(j.den + i) * q.den));
    else if constexpr (is_fraction<Term, F>)
      store<B>(j.out + i, num / q.den);
    else
      store<B>(j.out + i, num);
  }
}
template <template <class> class Term, class F>
void finish_product(const Block<F>& x, const F* p, const ProductColumns<F>& j) {
  j.den ? finish_product_over<Term, F, true>(x, p, j)
        : finish_product_over<Term, F, false>(x, p, j);
}

template <template <class> class Term, class F>
void add_product(const Block<F>& x, const F* p, const ProductColumns<F>& j) {
  using B = Lane<F>;
  const auto term = bind_value<Term, F>(p);
  for (std::size_t i = 0; i < x.n; i += lanes<B>)
    store<B>(j.out + i, lobe_on(load<B>(j.base + i), Zero{}, One{}, load<B>(j.num + i),
                                as_value<B>(term(angles<Term<B>>(x, i)))));
}

template <template <class> class Term, class F, class Way = SamplesAsLanes>
void derivatives(const Block<F>& x, const F* p, F* value, F* const* d) {
  using B = Lane<F>;
  constexpr bool turns = is_anisotropic<Term<B>>;
  constexpr std::size_t N = Term<B>::parameters.size() + turns;
  using T = Dual<B, N>;
  const auto term =
      bind<Term<T>, T, Way>(p, [](const B& v, std::size_t k) { return T::variable(v, k); });
  for (std::size_t i = 0; i < x.n; i += lanes<B>) {
    const auto a = angles<Term<B>, Way>(x, i);
    T t;
    if constexpr (turns)
      t = as_value<T>(term(turning<N>(a)));
    else
      t = as_value<T>(term(a));
    store<B>(value + i, t.v);
    for (std::size_t k = 0; k < N; ++k) store<B>(d[k] + i, t.d[k]);
  }
}

/// Base that a term of the channels is added to.
enum class Under { nothing, column, uniform };

template <template <class> class Term, std::size_t channels, class F, Under base, bool coupled>
void shade_with(const Block<F> x, const ChannelColumns<F> j) {  // copied: stores cannot change them
  using B = Lane<F>;
  constexpr bool is_fresnel = role_of(Term<F>::about.id) == Role::fresnel;
  const auto terms = bind_channels<Term, channels>(j.parameters);
  std::array<B, channels> under, value;
  if constexpr (base == Under::uniform)
    for (std::size_t c = 0; c < channels; ++c) under[c] = B(j.uniform[c]);
  for (std::size_t i = 0; i < x.n; i += lanes<B>) {
    const auto a = angles<Term<B>>(x, i);
    B factor;
    if constexpr (is_fresnel) factor = load<B>(j.factor + i);
    for (std::size_t c = 0; c < channels; ++c) {
      if constexpr (base == Under::column) under[c] = load<B>(j.base[c] + i);
      value[c] = as_value<B>(terms[c](a));
      if constexpr (is_fresnel && base == Under::nothing)
        value[c] = lobe_on(Zero{}, Zero{}, One{}, factor, value[c]);
      else if constexpr (is_fresnel)
        value[c] = lobe_on(under[c], only_if<coupled>(under[c]), One{}, factor, value[c]);
    }
    for (std::size_t c = 0; c < channels; ++c) store<B>(j.out[c] + i, value[c]);
  }
}
template <template <class> class Term, std::size_t channels, class F>
void shade(const Block<F>& x, const ChannelColumns<F>& j) {
  if constexpr (role_of(Term<F>::about.id) == Role::fresnel) {
    const auto on = [&]<Under base>() {
      j.coupled ? shade_with<Term, channels, F, base, true>(x, j)
                : shade_with<Term, channels, F, base, false>(x, j);
    };
    if (j.base[0]) return on.template operator()<Under::column>();
    if (j.uniform) return on.template operator()<Under::uniform>();
  }
  shade_with<Term, channels, F, Under::nothing, false>(x, j);
}
template <template <class> class Term, class F>
F uniform(const F* p) {
  using B = Lane<F>;
  alignas(64) std::array<F, lanes<B>> value;
  store<B>(value.data(), bind_value<Term, F>(p)(Angles<B>{}));
  return value[0];
}
template <template <class> class Term, class F>
constexpr auto shades() {
  std::array<typename TermKernels<F>::Shade, max_channels + 1> by_channels{};
  constexpr Role role = role_of(Term<F>::about.id);
  if constexpr (role == Role::fresnel || role == Role::diffuse) {
    by_channels[1] = shade<Term, 1, F>;
    by_channels[3] = shade<Term, 3, F>;
  }
  return by_channels;
}

template <template <class> class Term, class F>
constexpr TermKernels<F> term_entry() {
  static_assert(Term<F>::parameters.size() <= max_parameters);
  F (*same_at_all_angles)(const F*) = nullptr;
  if constexpr (is_uniform<Term<F>>) same_at_all_angles = uniform<Term, F>;
  return {start_product<Term, F>, finish_product<Term, F>, add_product<Term, F>,
          same_at_all_angles,     shades<Term, F>(),       derivatives<Term, F>};
}
template <class F, template <class> class... Terms>
constexpr auto term_table(TermList<Terms...>) {
  return std::array{term_entry<Terms, F>()...};
}

/// Defined in the file of each role.
template <Role role, class F>
std::span<const TermKernels<F>> terms_of();

#define GONIO_TERMS_OF(role, list)                                \
  template <>                                                     \
  std::span<const TermKernels<float>> terms_of<role, float>() {   \
    static constexpr auto table = term_table<float>(list{});      \
    return table;                                                 \
  }                                                               \
  template <>                                                     \
  std::span<const TermKernels<double>> terms_of<role, double>() { \
    static constexpr auto table = term_table<double>(list{});     \
    return table;                                                 \
  }

}  // namespace gonio::inline GONIO_ARCH
