#pragma once
/// \file
/// A sample's residual and its share of the normal equations.  Included by files compiled per instruction
/// set alone.

#include <array>

#include "brdf/kernel/lane.h"

namespace gonio::inline GONIO_ARCH {

/// link(f + offset) and its derivative by f.  A model value of 0 (kd = 0 without a lobe) counts as tiny and
/// has no slope: the log never sees it.  A call for each few samples would take as long as the log.
template <Link kind, class B>
[[gnu::always_inline]] inline std::array<B, 2> linked(const B& f, const B& offset) {
  const B x = f + offset, one(1), tiny = constant<B>(faintest);
  if constexpr (kind == Link::identity) return {x, one};
  const auto positive = tiny < x;
  const B y = select<B>(positive, x, tiny);
  return {log(y), select<B>(positive, one / y, B(0))};
}

/// r = w (value − target) and ∂r/∂f.  Masked values must not reach a sum whatever they are (0·NaN is
/// NaN), so they are chosen away.
template <class B>
std::array<B, 2> weighted(const B& value, const B& slope, const B& target, const B& w) {
  const B zero(0);
  const auto on = zero < w;
  return {select<B>(on, w * (value - target), zero), select<B>(on, w * slope, zero)};
}

/// K (K + 1)/2 sums of products of K columns in registers, upper triangle row by row.
template <class F, std::size_t K>
class Products {
  using B = Lane<F>;

 public:
  explicit Products(const F* sums) {
    for (std::size_t e = 0; e < s_.size(); ++e) s_[e] = load<B>(sums + e * padding);
  }
  void add(const std::array<B, K>& c) {
    std::size_t e = 0;
#pragma GCC unroll 12
    for (std::size_t a = 0; a < K; ++a)
#pragma GCC unroll 12
      for (std::size_t b = a; b < K; ++b, ++e) s_[e] = s_[e] + c[a] * c[b];
  }
  void store_to(F* sums) const {
    for (std::size_t e = 0; e < s_.size(); ++e) store<B>(sums + e * padding, s_[e]);
  }

 private:
  std::array<B, K*(K + 1) / 2> s_;
};

/// w j, or 0 where w is 0: there j may be NaN.
template <class B>
B unmasked(const B& w, const B& j) {
  const B zero(0);
  return select<B>(w < zero || zero < w, w * j, zero);
}

}  // namespace gonio::inline GONIO_ARCH
