#pragma once
/// \file
/// A sample's part of the sandwich, where the lanes are texels.  Included by files compiled per instruction set alone.

#include "brdf/kernel/residual.h"
#include "fitting/lanes/lanes.h"

namespace gonio::inline GONIO_ARCH {

/// Sums that LaneKernels' worth describes.
template <class F, std::size_t K>
class WorthSums {
  using B = Lane<F>;

 public:
  WorthSums(const TexelArguments& a, std::size_t channel)
      : WorthSums(a.inverse[channel], a.sums[channel]) {}
  WorthSums(const F* inverse, const F* sums) : products_(sums) {
    for (std::size_t e = 0; e < inverse_.size(); ++e) inverse_[e] = load<B>(inverse + e * padding);
    for (std::size_t k = 0; k + 1 < K; ++k) {
      alone_[k] = load<B>(sums + (1 + k) * padding);
      for (std::size_t power = 0; power < 2; ++power)
        parts_[power][k] = load<B>(sums + of_parts(power, k) * padding);
    }
  }

  /// \param column  r and its derivatives
  void add(std::array<B, K> column) {
    std::array<B, K> b;  // B⁻¹ j, after the first
    B h(0);
    for (std::size_t k = 1; k < K; ++k) {
      b[k] = B(0);
      for (std::size_t l = 1; l < K; ++l) b[k] = b[k] + inverse_[entry(k, l)] * column[l];
      h = h + b[k] * column[k];
    }
    // One value that alone determines something leaves nothing to judge that by.
    const B most = constant<B>(0.999L), one(1);
    const auto alone = most < h;
    const B factor = column[0] / (one - min<B>(h, most));
    for (std::size_t k = 1; k < K; ++k) {
      alone_[k - 1] = alone_[k - 1] + select<B>(alone, b[k] * b[k], B(0));
      column[k] = factor * column[k];
      const B part = b[k] * factor * (b[k] * factor);
      parts_[0][k - 1] = parts_[0][k - 1] + part;
      parts_[1][k - 1] = parts_[1][k - 1] + part * part;
    }
    products_.add(column);
  }
  void store(const TexelArguments& a, std::size_t channel) const { store_to(a.sums[channel]); }
  void store_to(F* sums) const {
    products_.store_to(sums);
    for (std::size_t k = 0; k + 1 < K; ++k) {
      gonio::store<B>(sums + (1 + k) * padding, alone_[k]);
      for (std::size_t power = 0; power < 2; ++power)
        gonio::store<B>(sums + of_parts(power, k) * padding, parts_[power][k]);
    }
  }

 private:
  static constexpr std::size_t entry(std::size_t k, std::size_t l) {
    const std::size_t row = (k > l ? k : l) - 1, column = (k > l ? l : k) - 1;
    return row * (row + 1) / 2 + column;
  }
  static constexpr std::size_t of_parts(std::size_t power, std::size_t k) {
    return K * (K + 1) / 2 + power * (K - 1) + k;
  }
  Products<F, K> products_;
  std::array<B, K*(K - 1) / 2> inverse_;
  std::array<B, K - 1> alone_;
  std::array<std::array<B, K - 1>, 2> parts_;
};

}  // namespace gonio::inline GONIO_ARCH
