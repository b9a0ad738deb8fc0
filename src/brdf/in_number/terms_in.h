#pragma once
/// \file
/// A role's terms over a number T.  Included by the one file of each role, which compiles it for all numbers
/// but fifty digits, and by those of fifty digits (wide*.cpp): a change of a formula compiles its role alone.

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "brdf/in_number/tables.h"
#include "brdf/term/map.h"
#include "brdf/term/term.h"
#include "brdf/term/term_list.h"
#include "number/counted.h"
#include "number/half.h"
#include "number/mixed.h"

namespace gonio::inline GONIO_ARCH {

/// Conversions of doubles to a T, and back.
template <class T>
struct Conversion {
  static T parameter(double x) { return static_cast<T>(x); }
  static T angle(double x) { return static_cast<T>(x); }
  static double out(const T& x) { return static_cast<double>(x); }
};

template <>
struct Conversion<Mixed> {
  static Mixed parameter(double x) { return Mixed(Half(x)); }
  static Mixed angle(double x) { return Mixed(static_cast<float>(x)); }
  static double out(const Mixed& x) { return x.value(); }
};

template <class T>
FrameAngles<T> angles_in(const FrameAngles<double>& a) {
  const auto in = [](double x) { return Conversion<T>::angle(x); };
  return {{in(a.nol), in(a.nov), in(a.noh), in(a.voh), in(a.sin2_theta_h)},
          in(a.xoh),
          in(a.yoh),
          in(a.xol),
          in(a.yol),
          in(a.xov),
          in(a.yov)};
}

template <class T, std::size_t n>
std::array<T, n> numbers_in(std::span<const double> parameters) {
  std::array<T, n> p;
  for (std::size_t k = 0; k < n; ++k) p[k] = Conversion<T>::parameter(parameters[k]);
  return p;
}

template <class Term>
inline constexpr bool is_masking = role_of(Term::about.id) == Role::masking;

/// 4 NoL NoV V; at grazing 0, even where V has no bound
template <class T>
T g2_of(const T& v, const Angles<T>& a) {
  const T cosines = 4 * a.nol * a.nov;
  return select<T>(T(0) < cosines, cosines * v, T(0));
}

template <template <class> class Term, class T, bool g2>
void values_in(std::span<const double> parameters,
               std::span<const FrameAngles<double>> rows,
               double* out) {
  static_assert(TermOver<Term<T>, T>);
  constexpr std::size_t n = Term<T>::parameters.size();
  const auto p = numbers_in<T, n>(parameters);
  const Term<T> term{std::span<const T, n>(p)};
  for (const auto& row : rows) {
    const auto a = angles_in<T>(row);
    const T value = as_value<T>(term(a));
    *out++ = Conversion<T>::out(g2 ? g2_of<T>(value, a) : value);
  }
}

template <template <class> class Term, class T>
constexpr TermIn entry_in() {
  if constexpr (is_masking<Term<T>>)
    return {values_in<Term, T, false>, values_in<Term, T, true>};
  else
    return {values_in<Term, T, false>, nullptr};
}
template <class T, template <class> class... Terms>
constexpr auto table_in(TermList<Terms...>) {
  return std::array{entry_in<Terms, T>()...};
}

template <template <class> class Map, class T>
std::vector<double> map_in(std::span<const double> parameters) {
  static_assert(MapOver<Map<T>, T>);
  std::vector<double> out;
  for (const T& x : Map<T>::apply(numbers_in<T, Map<T>::parameters.size()>(parameters)))
    out.push_back(Conversion<T>::out(x));
  return out;
}
template <class T, template <class> class... M>
constexpr auto table_in(MapList<M...>) {
  return std::array{&map_in<M, T>...};
}

// ---- operations ---------------------------------------------------------------------------------

template <template <class> class Term>
TermOperations operations() {
  using C = Counted<double>;
  // Formulas have no branches: any values are as good as these.
  constexpr std::size_t n = Term<C>::parameters.size();
  std::array<C, n> p;
  for (std::size_t k = 0; k < n; ++k) p[k] = C(Term<C>::parameters[k].start);
  const C c(0.5);
  const FrameAngles<C> angles{{c, c, c, c, c}, c, c, c, c, c, c};
  std::optional<Term<C>> term;
  TermOperations cost;
  cost.parameters = count_operations([&] { term.emplace(std::span<const C, n>(p)); });
  cost.sample = count_operations([&] { as_value<C>((*term)(angles)); });
  cost.fraction = count_operations([&] { as_quotient<C>((*term)(angles)); });
  return cost;
}
template <template <class> class... Terms>
constexpr auto operations_in(TermList<Terms...>) {
  return std::array{&operations<Terms>...};
}

}  // namespace gonio::inline GONIO_ARCH

namespace gonio {

#define GONIO_TERMS_IN(role, list)                              \
  template <>                                                   \
  std::span<const TermIn> terms_in<role>(Number number) {       \
    static constexpr auto in_double = table_in<double>(list{}); \
    static constexpr auto in_float = table_in<float>(list{});   \
    static constexpr auto in_half = table_in<Half>(list{});     \
    static constexpr auto in_mixed = table_in<Mixed>(list{});   \
    switch (number) {                                           \
      case Number::double_:                                     \
        return in_double;                                       \
      case Number::float_:                                      \
        return in_float;                                        \
      case Number::half:                                        \
        return in_half;                                         \
      case Number::mixed:                                       \
        return in_mixed;                                        \
      case Number::wide:                                        \
        break;                                                  \
    }                                                           \
    return terms_in_wide<role>();                               \
  }                                                             \
  template <>                                                   \
  std::span<TermOperations (*const)()> operations_in<role>() {  \
    static constexpr auto all = operations_in(list{});          \
    return all;                                                 \
  }

}  // namespace gonio
