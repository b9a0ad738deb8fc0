#pragma once
/// \file
/// Comparisons of enclosures (enclosure.h): their outcomes, and how values rise and fall with the inputs.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "number/real.h"

namespace gonio::inline GONIO_ARCH {

/// Inputs by which a value may rise and may fall, a bit each; neither: it does not depend on it.  By those of numbers
/// that have no bit it may do either.
struct Directions {
  static constexpr std::size_t most = 64;  ///< inputs that have a bit

  std::uint64_t up = 0, down = 0;

  static Directions rising(std::size_t input) {
    return {input < most ? std::uint64_t{1} << input : 0, 0};
  }
  Directions reversed() const { return {down, up}; }
  Directions unknown() const { return {up | down, up | down}; }
  /// Those of this times a factor between low and high.
  Directions times(double low, double high) const {
    return 0 <= low ? *this : high <= 0 ? reversed() : unknown();
  }
  friend Directions operator|(Directions a, Directions b) { return {a.up | b.up, a.down | b.down}; }
  bool rises(std::size_t input) const { return input < most && !(down >> input & 1); }
  bool falls(std::size_t input) const { return input < most && !(up >> input & 1); }
};

/// Outcomes that comparisons are given which have either, in the order in which they are asked for: a formula is then
/// evaluated once for every way through it.
class EnclosurePaths {
 public:
  bool next() {
    if (asked_ == outcomes_.size()) outcomes_.push_back(true);
    return outcomes_[asked_++];
  }
  /// To the next way; false after the last.
  bool advance() {
    asked_ = 0;
    while (!outcomes_.empty() && !outcomes_.back()) outcomes_.pop_back();
    if (outcomes_.empty()) return false;
    outcomes_.back() = false;
    return true;
  }

 private:
  std::vector<bool> outcomes_;
  std::size_t asked_ = 0;
};

/// This thread's, if a formula is evaluated way by way.
inline thread_local EnclosurePaths* enclosure_paths = nullptr;

/// Ways by which this thread's comparisons go, until it ends.
class EnclosurePathsScope {
 public:
  explicit EnclosurePathsScope(EnclosurePaths& paths) : before_(enclosure_paths) {
    enclosure_paths = &paths;
  }
  EnclosurePathsScope(const EnclosurePathsScope&) = delete;
  EnclosurePathsScope& operator=(const EnclosurePathsScope&) = delete;
  ~EnclosurePathsScope() { enclosure_paths = before_; }

 private:
  EnclosurePaths* before_;
};

/// Outcome of a comparison of enclosures, and what is then known of those compared.
class EnclosureMask {
 public:
  /// A bound of the value `id`, where the outcome is the one that it belongs to.
  struct Bound {
    std::int64_t id = 0;
    bool below = false;  ///< value ≤ x, else value ≥ x
    double x = 0;
  };
  using Bounds = std::array<Bound, 4>;  // those of id 0 say nothing

  EnclosureMask(bool can_hold, bool can_fail) : can_hold_(can_hold), can_fail_(can_fail) {}
  bool can_hold() const { return can_hold_; }
  bool can_fail() const { return can_fail_; }

  friend EnclosureMask operator!(EnclosureMask a) {
    std::swap(a.can_hold_, a.can_fail_);
    std::swap(a.held_, a.failed_);
    return a;
  }
  friend EnclosureMask operator&&(const EnclosureMask& a, const EnclosureMask& b) {
    EnclosureMask both(a.can_hold_ && b.can_hold_, a.can_fail_ || b.can_fail_);
    std::copy_n(a.held_.begin(), 2, both.held_.begin());
    std::copy_n(b.held_.begin(), 2, both.held_.begin() + 2);
    both.inputs_ = a.inputs_ | b.inputs_;
    return both;
  }
  friend EnclosureMask operator||(const EnclosureMask& a, const EnclosureMask& b) {
    return !(!a && !b);
  }

 private:
  template <class F>
  friend class Enclosure;

  bool can_hold_, can_fail_;
  Bounds held_, failed_;
  Directions inputs_;
};

}  // namespace gonio::inline GONIO_ARCH
