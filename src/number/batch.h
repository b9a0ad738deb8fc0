#pragma once
/// \file
/// A register full of numbers as a Real, and how numbers enter it from a column and leave it.
/// A scalar is a batch of one, so a loop over a column is written once.

#include "number/real.h"

#include <xsimd/xsimd.hpp>

namespace gonio::inline GONIO_ARCH {

/// F is float or double; the width is that of the instruction set the file is compiled for.
template <class F>
using Batch = xsimd::batch<F>;

template <class F, class Arch>
struct RealTraits<xsimd::batch<F, Arch>> {
  using Base = F;
  using Plain = xsimd::batch<F, Arch>;
  using Mask = xsimd::batch_bool<F, Arch>;
  static Plain select(const Mask& m, const Plain& a, const Plain& b) {
    return xsimd::select(m, a, b);
  }
#if defined(__x86_64__) || defined(_M_X64)  // returns its second operand where neither is less
  static Plain max(const Plain& a, const Plain& b) {
    return xsimd::max(b, a);
  }
  static Plain min(const Plain& a, const Plain& b) {
    return xsimd::min(b, a);
  }
#endif
};

template <class T>
inline constexpr std::size_t lanes = T::size;
template <std::floating_point T>
inline constexpr std::size_t lanes<T> = 1;

/// \param p  aligned to the register's size
template <class T>
T load(const base_t<T>* p) {
  if constexpr (std::floating_point<T>)
    return *p;
  else
    return T::load_aligned(p);
}
template <class T>
void store(base_t<T>* p, const T& x) {
  if constexpr (std::floating_point<T>)
    *p = x;
  else
    x.store_aligned(p);
}

}  // namespace gonio::inline GONIO_ARCH
