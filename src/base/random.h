#pragma once
/// \file
/// Random numbers that depend on what they are drawn for alone, not on who drew before: the same
/// whatever the threads.

#include <cmath>
#include <concepts>
#include <cstdint>
#include <numbers>

namespace gonio {

/// The k-th draw is a hash of the keys and k: SplitMix64 and its finaliser.
///                                   [Steele, Lea & Flood 2014, Fast splittable pseudorandom numbers]
class Draws {
 public:
  explicit Draws(std::uint64_t seed, std::integral auto... keys) : state_(mix(seed)) {
    ((state_ = mix(state_ ^ static_cast<std::uint64_t>(keys))), ...);
  }
  /// uniform in (0, 1]
  double uniform() {
    state_ += 0x9e3779b97f4a7c15U;
    return (static_cast<double>(mix(state_) >> 11U) + 0.5) * 0x1p-53;
  }
  /// standard normal (Box–Muller)
  double normal() {
    const double radius = std::sqrt(-2 * std::log(uniform()));
    return radius * std::cos(2 * std::numbers::pi * uniform());
  }

 private:
  static std::uint64_t mix(std::uint64_t x) {
    x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
    return x ^ (x >> 31U);
  }
  std::uint64_t state_;
};

}  // namespace gonio
