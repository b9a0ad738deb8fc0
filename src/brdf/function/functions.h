#pragma once
/// \file
/// Terms as functions over a number T of any kind: what is not evaluated row by row but looked into, an
/// enclosure or a script.  Each role's are compiled by one file for each kind of number (enclosure_*.cpp).

#include <array>
#include <cstddef>
#include <span>

#include "brdf/term/term.h"
#include "brdf/term/term_list.h"
#include "number/half.h"
#include "number/quotient.h"

namespace gonio {

template <class T>
using TermFunction = Quotient<T> (*)(std::span<const T> parameters, const FrameAngles<T>& angles);

/// Halves with the liberties that drivers take.
using FlushedHalf = HalfOver<float, HalfRules{.flush = true}>;
using ContractedHalf = HalfOver<float, HalfRules{.contract = true}>;
using FlushedContractedHalf = HalfOver<float, HalfRules{.flush = true, .contract = true}>;

/// One role's terms, in the order of the catalogue.
template <class T, Role role>
std::span<const TermFunction<T>> functions_in();

/// A term by its index in the catalogue.
template <class T>
TermFunction<T> term_function(std::size_t term) {
  for (const auto role : {functions_in<T, Role::ndf>(), functions_in<T, Role::masking>(),
                          functions_in<T, Role::fresnel>(), functions_in<T, Role::diffuse>()}) {
    if (term < role.size()) return role[term];
    term -= role.size();
  }
  return nullptr;
}

inline namespace GONIO_ARCH {

/// A term, made anew for every sample.
template <template <class> class Term, class T>
Quotient<T> as_function(std::span<const T> parameters, const FrameAngles<T>& angles) {
  static_assert(TermOver<Term<T>, T>);
  constexpr std::size_t n = Term<T>::parameters.size();
  return as_quotient<T>(Term<T>{parameters.template first<n>()}(angles));
}
template <class T, template <class> class... Terms>
constexpr auto functions_of(TermList<Terms...>) {
  return std::array{&as_function<Terms, T>...};
}

}  // namespace GONIO_ARCH

#define GONIO_TERMS_AS_FUNCTIONS(role, list, T)              \
  template <>                                                \
  std::span<const TermFunction<T>> functions_in<T, role>() { \
    static constexpr auto all = functions_of<T>(list{});     \
    return all;                                              \
  }

}  // namespace gonio
