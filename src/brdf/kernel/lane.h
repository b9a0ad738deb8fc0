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

/// A register of samples of one model: its parameters are the same for all of them.
struct SamplesAsLanes {
  static constexpr std::size_t block = 256;  ///< numbers of a column that a loop takes at once
  template <class F>
  static Lane<F> parameter(const F* p, std::size_t k) {
    return Lane<F>(p[k]);
  }
  /// Of a column of angles or weights, at its number i.
  template <class F>
  static Lane<F> of_sample(const F* column, std::size_t i) {
    return load<Lane<F>>(column + i);
  }
  /// Where that column has it.
  template <class F>
  static std::size_t place(std::size_t i) {
    return i;
  }
  template <class F>
  static Block<F> part(const Block<F>& x, std::size_t first, std::size_t n) {
    return x.part(first, n);
  }
};

/// A register of one sample of many models, texels of a map: each has its own parameters, [parameter][padding], and its own
/// value, [sample][texel].
/// \tparam shared  angles and weights are the same for all of them: [sample]
template <bool shared>
struct TexelsAsLanes {
  static constexpr std::size_t block = 1024;
  template <class F>
  static Lane<F> parameter(const F* p, std::size_t k) {
    return load<Lane<F>>(p + k * padding);
  }
  template <class F>
  static Lane<F> of_sample(const F* column, std::size_t i) {
    if constexpr (shared)
      return Lane<F>(column[place<F>(i)]);
    else
      return load<Lane<F>>(column + i);
  }
  template <class F>
  static std::size_t place(std::size_t i) {
    return shared ? i / lanes<Lane<F>> : i;
  }
  template <class F>
  static Block<F> part(const Block<F>& x, std::size_t first, std::size_t n) {
    return x.part(place<F>(first), n);
  }
};

/// Angles of the samples from i on; the frame is read only for who asks.
template <bool frame, class Way = SamplesAsLanes, class F>
auto angles_with(const Block<F>& x, std::size_t i) {
  using B = Lane<F>;
  const auto at = [&](const F* column) { return Way::of_sample(column, i); };
  const Angles<B> a{at(x.nol), at(x.nov), at(x.noh), at(x.voh), at(x.sin2_theta_h)};
  if constexpr (frame) {
    const auto of = [&](std::size_t k) { return at(x.frame[k]); };
    return FrameAngles<B>{a, of(0), of(1), of(2), of(3), of(4), of(5)};
  } else {
    return a;
  }
}
template <class Term = void, class Way = SamplesAsLanes, class F>
auto angles(const Block<F>& x, std::size_t i) {
  return angles_with<is_anisotropic<Term>, Way>(x, i);
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

template <class Term, class T, class Way = SamplesAsLanes, class F>
Term bind(const F* p, auto lift) {
  std::array<T, Term::parameters.size()> a;
  for (std::size_t k = 0; k < a.size(); ++k) a[k] = lift(Way::parameter(p, k), k);
  return Term(std::span<const T, Term::parameters.size()>(a));
}
template <template <class> class Term, class F>
auto bind_value(const F* p) {
  using B = Lane<F>;
  static_assert(TermOver<Term<B>, B>);
  return bind<Term<B>, B>(p, [](const B& x, std::size_t) { return x; });
}

/// A term of each channel.  What all channels share is read of the first: where it alone decides, one
/// loop computes it once.
template <template <class> class Term, std::size_t channels, class F>
auto bind_channels(const std::array<const F*, max_channels>& p) {
  using B = Lane<F>;
  const auto of = [&](std::size_t c) {
    return bind<Term<B>, B>(p[c], [&](const B& x, std::size_t k) {
      return Term<B>::parameters[k].per_channel ? x : B(p[0][k]);
    });
  };
  return [&]<std::size_t... C>(std::index_sequence<C...>) {
    return std::array{of(C)...};
  }
  (std::make_index_sequence<channels>{});
}

}  // namespace gonio::inline GONIO_ARCH
