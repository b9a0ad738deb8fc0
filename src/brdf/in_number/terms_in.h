#pragma once
/// \file
/// Every term and every map over one number T.  Included by the one file of each number (term_in_*.cpp).

#include "brdf/catalogue/catalogue.h"
#include "brdf/catalogue/maps.h"
#include "brdf/in_number/number.h"

namespace gonio::inline GONIO_ARCH {

/// How doubles become a T and a T a double.
template <class T>
struct Doors {
  static T parameter(double x) { return static_cast<T>(x); }
  static T angle(double x) { return static_cast<T>(x); }
  static double out(const T& x) { return static_cast<double>(x); }
};

template <class T>
FrameAngles<T> angles_in(const FrameAngles<double>& a) {
  const auto in = [](double x) { return Doors<T>::angle(x); };
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
  for (std::size_t k = 0; k < n; ++k) p[k] = Doors<T>::parameter(parameters[k]);
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
    *out++ = Doors<T>::out(g2 ? g2_of<T>(value, a) : value);
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
    out.push_back(Doors<T>::out(x));
  return out;
}
template <class T, template <class> class... M>
constexpr auto table_in(MapList<M...>) {
  return std::array{&map_in<M, T>...};
}

template <class T>
constexpr auto terms_in = table_in<T>(Catalogue{});
template <class T>
constexpr auto maps_in = table_in<T>(Maps{});

}  // namespace gonio::inline GONIO_ARCH
