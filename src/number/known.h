#pragma once
/// \file
/// −1, 0 and 1 that are known when compiled, and numbers some of whose derivatives are such: no compiler
/// may drop 0·x, so a rule that is to cost nothing where a part of it is absent is given these instead.

#include <tuple>
#include <type_traits>
#include <utility>

#include "number/real.h"

namespace gonio::inline GONIO_ARCH {

/// The number k, −1, 0 or 1: arithmetic with it leaves what is left to do, bit for bit but for −0 + 0.
template <int k>
struct Known {};
using Zero = Known<0>;
using One = Known<1>;

template <class T>
inline constexpr bool is_known = false;
template <int k>
inline constexpr bool is_known<Known<k>> = true;
template <class T>
concept Unknown = !is_known<T>;

template <int a, int b>
constexpr Known<a + b> operator+(Known<a>, Known<b>) {
  return {};
}
template <int a, int b>
constexpr Known<a - b> operator-(Known<a>, Known<b>) {
  return {};
}
template <int a, int b>
constexpr Known<a * b> operator*(Known<a>, Known<b>) {
  return {};
}
template <int k>
constexpr Known<-k> operator-(Known<k>) {
  return {};
}

template <int k, Unknown T>
constexpr auto operator+(Known<k>, const T& x) {
  if constexpr (k == 0)
    return x;
  else
    return k + x;
}
template <int k, Unknown T>
constexpr auto operator+(const T& x, Known<k>) {
  return Known<k>{} + x;
}
template <int k, Unknown T>
constexpr auto operator-(Known<k>, const T& x) {
  if constexpr (k == 0)
    return -x;
  else
    return k - x;
}
template <int k, Unknown T>
constexpr auto operator-(const T& x, Known<k>) {
  if constexpr (k == 0)
    return x;
  else
    return x - k;
}
template <int k, Unknown T>
constexpr auto operator*(Known<k>, const T& x) {
  if constexpr (k == 0)
    return Zero{};
  else if constexpr (k == 1)
    return x;
  else
    return -x;
}
template <int k, Unknown T>
constexpr auto operator*(const T& x, Known<k>) {
  return Known<k>{} * x;
}

/// x where `wanted`, else 0.
template <bool wanted, class T>
constexpr auto only_if(const T& x) {
  if constexpr (wanted)
    return x;
  else
    return Zero{};
}

/// A value with its derivative by each of some inputs, of which many are known to be 0 or 1: what Dual
/// has, without arithmetic on zeros.
template <class V, class... D>
struct Partials {
  V v;
  std::tuple<D...> d;

  friend constexpr auto operator-(const Partials& a) {
    return std::apply(
        [&](const auto&... x) {
          return Partials<V, decltype(-x)...>{-a.v, {-x...}};
        },
        a.d);
  }
};

namespace detail {
template <class V, class... A, class... B>
constexpr auto combined(const V& value,
                        const Partials<V, A...>& a,
                        const Partials<V, B...>& b,
                        auto&& rule) {
  static_assert(sizeof...(A) == sizeof...(B));
  return [&]<std::size_t... I>(std::index_sequence<I...>) {
    const auto of = [&]<std::size_t i>() { return rule(std::get<i>(a.d), std::get<i>(b.d)); };
    return Partials<V, decltype(of.template operator()<I>())...>{value,
                                                                 {of.template operator()<I>()...}};
  }
  (std::index_sequence_for<A...>{});
}
}  // namespace detail

template <class V, class... A, class... B>
constexpr auto operator+(const Partials<V, A...>& a, const Partials<V, B...>& b) {
  return detail::combined(V(a.v + b.v), a, b,
                          [](const auto& da, const auto& db) { return da + db; });
}
template <class V, class... A, class... B>
constexpr auto operator-(const Partials<V, A...>& a, const Partials<V, B...>& b) {
  return detail::combined(V(a.v - b.v), a, b,
                          [](const auto& da, const auto& db) { return da - db; });
}
template <class V, class... A, class... B>
constexpr auto operator*(const Partials<V, A...>& a, const Partials<V, B...>& b) {
  return detail::combined(V(a.v * b.v), a, b,
                          [&](const auto& da, const auto& db) { return da * b.v + a.v * db; });
}

/// v as input i of n: its own derivative is 1, all others are 0.
template <std::size_t i, std::size_t n, class V>
constexpr auto input(const V& v) {
  return [&]<std::size_t... K>(std::index_sequence<K...>) {
    return Partials<V, Known<K == i>...>{v, {}};
  }
  (std::make_index_sequence<n>{});
}

}  // namespace gonio::inline GONIO_ARCH
