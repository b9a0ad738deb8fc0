#pragma once
// The part of xsimd that the kernels use, on WebAssembly's 128-bit register by the compiler's vectors: xsimd 8 knows no such machine.
// exp, log and the like are libm's for each lane, so that a lane has a scalar's bits.
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace xsimd {

struct wasm {};

template <class F, class Arch = wasm>
struct batch_bool {
  using Bits = std::conditional_t<sizeof(F) == 8, std::int64_t, std::int32_t> __attribute__((vector_size(16)));
  Bits bits;
  batch_bool() = default;
  batch_bool(Bits b) : bits(b) {}
  friend batch_bool operator!(batch_bool a) { return ~a.bits; }
#define GONIO_MASK(op, by) \
  friend batch_bool operator op(batch_bool a, batch_bool b) { return a.bits by b.bits; }
  GONIO_MASK(&&, &)
  GONIO_MASK(||, |)
  GONIO_MASK(&, &)
  GONIO_MASK(|, |)
#undef GONIO_MASK
};

template <class F, class Arch = wasm>
struct batch {
  using value_type = F;
  using arch_type = Arch;
  using Register = F __attribute__((vector_size(16)));
  using Mask = batch_bool<F, Arch>;
  static constexpr std::size_t size = 16 / sizeof(F);
  Register lanes;

  batch() = default;
  batch(Register r) : lanes(r) {}
  batch(F x) : lanes(x - Register{}) {}  // less 0 keeps the sign of 0
  template <std::integral N>
  batch(N n) : batch(static_cast<F>(n)) {}
  template <std::floating_point N>
  explicit batch(N x) : batch(static_cast<F>(x)) {}

  static batch load_aligned(const F* p) { return *reinterpret_cast<const Register*>(p); }
  void store_aligned(F* p) const { *reinterpret_cast<Register*>(p) = lanes; }
  F get(std::size_t i) const { return lanes[i]; }

  friend batch operator-(batch a) { return -a.lanes; }
#define GONIO_ARITHMETIC(op)                                             \
  friend batch operator op(batch a, batch b) { return a.lanes op b.lanes; } \
  batch& operator op##=(batch b) { return *this = *this op b; }
  GONIO_ARITHMETIC(+)
  GONIO_ARITHMETIC(-)
  GONIO_ARITHMETIC(*)
  GONIO_ARITHMETIC(/)
#undef GONIO_ARITHMETIC
#define GONIO_COMPARISON(op) \
  friend Mask operator op(batch a, batch b) { return typename Mask::Bits(a.lanes op b.lanes); }
  GONIO_COMPARISON(<)
  GONIO_COMPARISON(<=)
  GONIO_COMPARISON(>)
  GONIO_COMPARISON(>=)
  GONIO_COMPARISON(==)
#undef GONIO_COMPARISON
};

template <class F, class A>
batch<F, A> select(batch_bool<F, A> m, batch<F, A> a, batch<F, A> b) {
  using Bits = typename batch_bool<F, A>::Bits;
  return reinterpret_cast<typename batch<F, A>::Register>((m.bits & reinterpret_cast<Bits>(a.lanes)) | (~m.bits & reinterpret_cast<Bits>(b.lanes)));
}
template <class F, class A>
batch<F, A> min(batch<F, A> a, batch<F, A> b) {
  return select(b < a, b, a);
}
template <class F, class A>
batch<F, A> max(batch<F, A> a, batch<F, A> b) {
  return select(a < b, b, a);
}
template <class F, class A>
batch<F, A> sqrt(batch<F, A> x) {
  return __builtin_elementwise_sqrt(x.lanes);
}
#define GONIO_LANE_BY_LANE(f)                                                     \
  template <class F, class A>                                                     \
  batch<F, A> f(batch<F, A> x) {                                                  \
    for (std::size_t i = 0; i < batch<F, A>::size; ++i) x.lanes[i] = std::f(x.lanes[i]); \
    return x;                                                                     \
  }
GONIO_LANE_BY_LANE(exp)
GONIO_LANE_BY_LANE(log)
#undef GONIO_LANE_BY_LANE
template <class F, class A>
F reduce_add(batch<F, A> x) {
  F sum = 0;
  for (std::size_t i = 0; i < batch<F, A>::size; ++i) sum += x.lanes[i];
  return sum;
}
template <class F, class A>
F hadd(batch<F, A> x) {
  return reduce_add(x);
}

}  // namespace xsimd
