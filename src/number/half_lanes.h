#pragma once
/// \file
/// A register of halves, held as floats: Half (half.h) over a Batch<float>, so that every half there is
/// can be looked at.  Where the set has a conversion to binary16 that rounds, elsewhere by the rule of
/// half.h itself.
///
/// It raises no flags.  exp and log are those of one half, from a table of all.

#include <array>
#include <vector>

#include "number/batch.h"
#include "number/half.h"

namespace gonio::inline GONIO_ARCH {

/// Values of a function at every half, by the upper bits of the float that holds it; the lower are 0.
template <class Half, class Function>
class HalfTable {
 public:
  HalfTable() : values_(std::size_t{1} << (32 - lower)) {
    const auto flags = half_flags;
    for (std::uint32_t k = 0; k < values_.size(); ++k) {
      const auto x = std::bit_cast<float>(k << lower);
      const float size = std::abs(x);
      if (!(size > 0) || size >= 0x1p-24F) values_[k] = static_cast<float>(Half(Function::at(x)));
    }
    half_flags = flags;
  }
  float at(std::int32_t bits) const { return values_[static_cast<std::uint32_t>(bits) >> lower]; }

 private:
  static constexpr int lower = 13;
  std::vector<float> values_;
};

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
  /// A function of each lane, a half: there are so few of them that a table has all values.
  template <class Half, class Function>
  static Register looked_up(const Register& x) {
    static const HalfTable<Half, Function> table;
    alignas(64) std::array<std::int32_t, Register::size> bits;
    alignas(64) std::array<float, Register::size> value;
    of(x).store_aligned(bits.data());
    for (std::size_t k = 0; k < bits.size(); ++k) value[k] = table.at(bits[k]);
    return Register::load_aligned(value.data());
  }
};

template <HalfRules rules = HalfRules{}>
using HalfLanes = HalfOver<Batch<float>, rules>;

}  // namespace gonio::inline GONIO_ARCH
