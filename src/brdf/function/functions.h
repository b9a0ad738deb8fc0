#pragma once
/// \file
/// Terms as functions over a number T of any kind: values in a number, operations, enclosures, scripts and graphs.  Each role's are
/// compiled by one file for each kind of number (enclosure_*.cpp, ../in_number/ndf.cpp …).

#include <array>
#include <cstddef>
#include <span>

#include "brdf/term/term.h"
#include "brdf/term/term_list.h"
#include "number/half.h"
#include "number/quotient.h"

namespace gonio {

template <class T>
struct TermFunction {
  /// The term at each row; what depends on parameters alone is computed once.
  void (*rows)(std::span<const T> parameters, std::span<const FrameAngles<T>>, Quotient<T>* out);

  Quotient<T> operator()(std::span<const T> parameters, const FrameAngles<T>& angles) const {
    Quotient<T> q;
    rows(parameters, {&angles, 1}, &q);
    return q;
  }
};

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
  return {};
}

inline namespace GONIO_ARCH {

template <template <class> class Term, class T>
void term_at(std::span<const T> parameters,
             std::span<const FrameAngles<T>> rows,
             Quotient<T>* out) {
  static_assert(TermOver<Term<T>, T>);
  const Term<T> term{parameters.template first<Term<T>::parameters.size()>()};
  for (const auto& row : rows) *out++ = as_quotient<T>(term(row));
}
template <class T, template <class> class... Terms>
constexpr auto functions_of(TermList<Terms...>) {
  return std::array{TermFunction<T>{&term_at<Terms, T>}...};
}

}  // namespace GONIO_ARCH

#define GONIO_TERMS_AS_FUNCTIONS(role, list, T)              \
  template <>                                                \
  std::span<const TermFunction<T>> functions_in<T, role>() { \
    static constexpr auto all = functions_of<T>(list{});     \
    return all;                                              \
  }

}  // namespace gonio
