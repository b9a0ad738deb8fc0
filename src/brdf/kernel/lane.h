#pragma once
/// \file
/// A term over a column: what the kernels of every role share.  Included by files compiled per
/// instruction set alone.

#include <utility>

#include "brdf/kernel/kernels.h"
#include "brdf/term/term.h"
#include "number/batch.h"
#include "number/dual.h"
#ifdef GONIO_SHAKEN
#include "number/shaken.h"
#endif

namespace gonio::inline GONIO_ARCH {

/// Number in which a loop takes its samples.
#ifdef GONIO_SHAKEN
template <class F>
using Lane = Shaken<F>;
#elif defined(GONIO_SCALAR)
template <class F>
using Lane = F;
#else
template <class F>
using Lane = Batch<F>;
#endif

/// Angles of the samples from i on; the frame is read only for who asks.
template <bool frame, class F>
auto angles_with(const Block<F>& x, std::size_t i) {
  using B = Lane<F>;
  const Angles<B> a{load<B>(x.nol + i), load<B>(x.nov + i), load<B>(x.noh + i), load<B>(x.voh + i),
                    load<B>(x.sin2_theta_h + i)};
  if constexpr (frame) {
    const auto of = [&](std::size_t k) { return load<B>(x.frame[k] + i); };
    return FrameAngles<B>{a, of(0), of(1), of(2), of(3), of(4), of(5)};
  } else {
    return a;
  }
}
template <class Term = void, class F>
auto angles(const Block<F>& x, std::size_t i) {
  return angles_with<is_anisotropic<Term>>(x, i);
}

/// A frame whose tangent turns [°]: unknown N − 1 of its numbers.
///
///   XoH' = YoH π/180,  YoH' = −XoH π/180;  so of l and v
template <std::size_t N, class B>
FrameAngles<B, Dual<B, N>> turning(const FrameAngles<B>& a) {
  const B radians = pi<B>() / 180;
  const auto along = [&](const B& value, const B& slope) {
    Dual<B, N> x(value);
    x.d[N - 1] = slope * radians;
    return x;
  };
  return {a,
          along(a.xoh, a.yoh),
          along(a.yoh, -a.xoh),
          along(a.xol, a.yol),
          along(a.yol, -a.xol),
          along(a.xov, a.yov),
          along(a.yov, -a.xov)};
}

template <class Term, class T, class F>
Term bind(const F* p, auto lift) {
  std::array<T, Term::parameters.size()> a;
  for (std::size_t k = 0; k < a.size(); ++k) a[k] = lift(p[k], k);
  return Term(std::span<const T, Term::parameters.size()>(a));
}
template <template <class> class Term, class F>
auto bind_value(const F* p) {
  using B = Lane<F>;
  static_assert(TermOver<Term<B>, B>);
  return bind<Term<B>, B>(p, [](F x, std::size_t) { return B(x); });
}

/// A term of each channel.  What all channels share is read of the first: where it alone decides, one
/// loop computes it once.
template <template <class> class Term, std::size_t channels, class F>
auto bind_channels(const std::array<const F*, max_channels>& p) {
  using B = Lane<F>;
  const auto of = [&](std::size_t c) {
    return bind<Term<B>, B>(p[c], [&](F x, std::size_t k) {
      return B(Term<B>::parameters[k].per_channel ? x : p[0][k]);
    });
  };
  return [&]<std::size_t... C>(std::index_sequence<C...>) {
    return std::array{of(C)...};
  }
  (std::make_index_sequence<channels>{});
}

}  // namespace gonio::inline GONIO_ARCH
