#pragma once
/// \file
/// Keys that occur several times in a large list, told by their hashes: who sorts or maps these alone, and few others,
/// spares the most of a list in which hardly any does.

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/memory.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace gonio {

/// Angles in whole parts of a degree: what is one direction, or lies on one line, has one key.
template <std::size_t N>
using AngleKey = std::array<long, N>;

template <std::size_t N>
std::uint64_t hash_of(const AngleKey<N>& key) {
  std::uint64_t h = 0;
  for (const long part : key) {
    h = (h ^ static_cast<std::uint64_t>(part)) * 0x9e3779b97f4a7c15;
    h ^= h >> 29;
  }
  return h * 0xbf58476d1ce4e5b9;
}

using Hashes = std::vector<std::uint64_t, ArrayAllocator<std::uint64_t>>;

/// Hash of key(0), key(1) … key(n − 1).
template <class KeyOf>
Hashes hashes_of(std::size_t n, const KeyOf& key) {
  Hashes all(n);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, 1 << 14), [&](const auto& r) {
    for (std::size_t i = r.begin(); i < r.end(); ++i) all[i] = hash_of(key(i));
  });
  return all;
}

/// Counts of hashes, up to 255: never less than how often one occurs, and hardly ever more.
class KeyCounts {
 public:
  explicit KeyCounts(const Hashes& hashes)
      : shift_(64 - static_cast<int>(std::bit_width(4 * hashes.size() + 1))) {
    counts_.assign(std::size_t{1} << (64 - shift_), 0);
    for (const auto h : hashes) {
      auto& count = counts_[h >> shift_];
      count = static_cast<std::uint8_t>(count + (count < 255));
    }
  }
  /// Positions of the hashes that are counted `least` times or more.
  std::vector<std::size_t> among(const Hashes& hashes, std::size_t least) const {
    constexpr std::size_t block = 1024;
    std::vector<std::size_t> all;
    std::array<std::size_t, block> found;
    for (std::size_t from = 0; from < hashes.size(); from += block) {
      std::size_t n = 0;  // without a branch, which would wait for memory each time
      for (std::size_t i = from; i < std::min(from + block, hashes.size()); ++i) {
        found[n] = i;
        n += counts_[hashes[i] >> shift_] >= least;
      }
      all.insert(all.end(), found.begin(), found.begin() + static_cast<std::ptrdiff_t>(n));
    }
    return all;
  }

 private:
  int shift_;
  std::vector<std::uint8_t, ArrayAllocator<std::uint8_t>> counts_;
};

}  // namespace gonio
