#pragma once
/// \file
/// The loop of a term over columns of halves, and the table of a role's terms.  Included by the one file of each
/// role, compiled per instruction set.

#include "brdf/kernel/lane.h"
#include "brdf/term/term_list.h"
#include "number/half_lanes.h"
#include "stability/kernel/half_columns.h"

namespace gonio::stability {
inline namespace GONIO_ARCH {

template <template <class> class Term, HalfRules rules>
void half_values(const Block<float>& x, const float* p, float* out) {
  using R = Lane<float>;
  using T = HalfOver<R, rules>;
  static_assert(TermOver<Term<T>, T>);
  const auto term = bind<Term<T>, T>(p, [](const R& v, std::size_t) { return T(v); });
  for (std::size_t i = 0; i < x.n; i += lanes<R>) {
    const auto in = [&](const float* column) { return T(load<R>(column + i)); };
    const Angles<T> a{in(x.nol), in(x.nov), in(x.noh), in(x.voh), in(x.sin2_theta_h)};
    if constexpr (is_anisotropic<Term<T>>) {
      const auto& f = x.frame;
      store<R>(out + i, as_value<T>(term(FrameAngles<T>{a, in(f[0]), in(f[1]), in(f[2]), in(f[3]),
                                                        in(f[4]), in(f[5])}))
                            .as_floats());
    } else {
      store<R>(out + i, as_value<T>(term(a)).as_floats());
    }
  }
}

template <template <class> class... Terms>
constexpr auto half_table(TermList<Terms...>) {
  const auto by_rules =
      []<template <class> class Term, std::size_t... K>(std::index_sequence<K...>) {
        return HalfByRules{half_values<Term, all_rules[K]>...};
      };
  return std::array{
      by_rules.template operator()<Terms>(std::make_index_sequence<all_rules.size()>{})...};
}

/// Defined in the file of each role.
template <Role role>
std::span<const HalfByRules> half_terms_of();

#define GONIO_HALF_TERMS_OF(role, list)                \
  template <>                                          \
  std::span<const HalfByRules> half_terms_of<role>() { \
    static constexpr auto table = half_table(list{});  \
    return table;                                      \
  }

}  // namespace GONIO_ARCH
}  // namespace gonio::stability
