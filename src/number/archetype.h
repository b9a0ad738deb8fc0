#pragma once
/// \file
/// The least a Real may be.  A formula that compiles for Archetype compiles for every Real: its
/// construction is explicit, its mask is no bool, it mixes with int alone and knows no `std::`.

#include "number/real.h"

namespace gonio::inline GONIO_ARCH {

class ArchetypeMask {
 public:
  explicit constexpr ArchetypeMask(bool b) : b_(b) {}
  friend ArchetypeMask operator&&(ArchetypeMask a, ArchetypeMask b) {
    return ArchetypeMask(a.b_ && b.b_);
  }
  friend ArchetypeMask operator||(ArchetypeMask a, ArchetypeMask b) {
    return ArchetypeMask(a.b_ || b.b_);
  }
  friend ArchetypeMask operator!(ArchetypeMask a) { return ArchetypeMask(!a.b_); }

 private:
  friend struct RealTraits<class Archetype>;
  bool b_;
};

class Archetype {
 public:
  using A = Archetype;
  explicit Archetype(int x) : v_(x) {}
  explicit Archetype(double x) : v_(x) {}
  double value() const { return v_; }

  friend A operator+(const A& a, const A& b) { return A(a.v_ + b.v_); }
  friend A operator-(const A& a, const A& b) { return A(a.v_ - b.v_); }
  friend A operator*(const A& a, const A& b) { return A(a.v_ * b.v_); }
  friend A operator/(const A& a, const A& b) { return A(a.v_ / b.v_); }
  friend A operator-(const A& a) { return A(-a.v_); }
  friend A operator+(std::same_as<int> auto s, const A& a) { return A(s + a.v_); }
  friend A operator+(const A& a, std::same_as<int> auto s) { return A(a.v_ + s); }
  friend A operator-(std::same_as<int> auto s, const A& a) { return A(s - a.v_); }
  friend A operator-(const A& a, std::same_as<int> auto s) { return A(a.v_ - s); }
  friend A operator*(std::same_as<int> auto s, const A& a) { return A(s * a.v_); }
  friend A operator*(const A& a, std::same_as<int> auto s) { return A(a.v_ * s); }
  friend A operator/(std::same_as<int> auto s, const A& a) { return A(s / a.v_); }
  friend A operator/(const A& a, std::same_as<int> auto s) { return A(a.v_ / s); }
  friend ArchetypeMask operator<(const A& a, const A& b) { return ArchetypeMask(a.v_ < b.v_); }
  friend A sqrt(const A& a) { return A(std::sqrt(a.v_)); }
  friend A exp(const A& a) { return A(std::exp(a.v_)); }
  friend A log(const A& a) { return A(std::log(a.v_)); }

 private:
  double v_;
};

template <>
struct RealTraits<Archetype> {
  using Base = double;
  using Plain = Archetype;
  using Mask = ArchetypeMask;
  static Archetype select(Mask m, const Archetype& a, const Archetype& b) { return m.b_ ? a : b; }
};

}  // namespace gonio::inline GONIO_ARCH
