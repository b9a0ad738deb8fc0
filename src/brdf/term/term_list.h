#pragma once
/// \file
/// A list of terms, as a type.

namespace gonio::inline GONIO_ARCH {

template <template <class> class... Terms>
struct TermList {};

namespace detail {
template <class... Lists>
struct Joined;
template <template <class> class... A>
struct Joined<TermList<A...>> {
  using Type = TermList<A...>;
};
template <template <class> class... A, template <class> class... B, class... Rest>
struct Joined<TermList<A...>, TermList<B...>, Rest...> : Joined<TermList<A..., B...>, Rest...> {};
}  // namespace detail

/// Lists one after the other.
template <class... Lists>
using Joined = typename detail::Joined<Lists...>::Type;

}  // namespace gonio::inline GONIO_ARCH
