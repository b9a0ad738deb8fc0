#pragma once
/// \file
/// A register of halves, held as floats: Half (half.h) over a Batch<float>, so that every half there is
/// can be looked at.  Where the set has a conversion to binary16 that rounds, elsewhere by the rule of
/// half.h itself.
///
/// It raises no flags.

#include <array>

#include "number/batch.h"
#include "number/half.h"

namespace gonio::inline GONIO_ARCH {

template <class Arch>
struct BitsOf<xsimd::batch<float, Arch>> {
  using Register = xsimd::batch<float, Arch>;
  using Type = xsimd::batch<std::int32_t, Arch>;
  static Type of(const Register& x) { return xsimd::bitwise_cast<Type>(x); }
  static Register as_float(const Type& bits) { return xsimd::bitwise_cast<Register>(bits); }
  static Type select(const xsimd::batch_bool<std::int32_t, Arch>& m, const Type& a, const Type& b) {
    return xsimd::select(m, a, b);
  }
#ifdef __AVX512F__
  static Register nearest_half(const Register& x) requires(Register::size == 16) {
    constexpr int nearest = 0;
    return Register(_mm512_cvtph_ps(_mm512_cvtps_ph(x, nearest)));
  }
#endif
  /// f of each lane, a float.
  static Register one_by_one(const Register& x, auto&& f) {
    alignas(64) std::array<float, Register::size> lane;
    x.store_aligned(lane.data());
    for (float& y : lane) y = f(y);
    return Register::load_aligned(lane.data());
  }
};

template <HalfRules rules = HalfRules{}>
using HalfLanes = HalfOver<Batch<float>, rules>;

}  // namespace gonio::inline GONIO_ARCH
