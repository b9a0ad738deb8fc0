#include "number/half.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace gonio {
namespace {

static_assert(Real<Half> && std::same_as<base_t<Half>, Half>);
static_assert(!std::convertible_to<float, Half> && !std::convertible_to<Half, float>);

constexpr double inf = std::numeric_limits<double>::infinity();

double value(Half x) {
  return static_cast<double>(x);
}

/// What the 16 bits say, read off the standard's definition.
double decoded(unsigned bits) {
  const int exponent = static_cast<int>(bits >> 10 & 31), fraction = static_cast<int>(bits & 1023);
  const double size = exponent == 31  ? (fraction ? std::nan("") : inf)
                      : exponent == 0 ? std::ldexp(fraction, -24)
                                      : std::ldexp(1024 + fraction, exponent - 25);
  return bits >> 15 ? -size : size;
}

/// 0, 2⁻²⁴, … 65504, 65536; the last stands for infinity.
const std::vector<double>& steps() {
  static const auto all = [] {
    std::vector<double> v;
    for (unsigned bits = 0; bits < 0x7c00; ++bits) v.push_back(decoded(bits));
    v.push_back(65536);
    return v;
  }();
  return all;
}

/// The half next to an exact x ≥ 0 that is known by comparison alone: `sign(c)` is that of x − c.  At
/// a tie the one with the even last bit, which is its place among the steps.
double nearest(auto&& sign) {
  const auto above =
      std::ranges::partition_point(steps(), [&](double step) { return sign(step) >= 0; });
  if (above == steps().end()) return inf;
  const auto k = static_cast<std::size_t>(above - steps().begin()) - 1;
  const double s = sign((steps()[k] + steps()[k + 1]) / 2);
  const double r = steps()[k + (s > 0 || (s == 0 && k % 2 == 1))];
  return r == 65536 ? inf : r;
}
double nearest(double x) {
  const double size = nearest([=](double c) { return std::abs(x) - c; });
  return std::copysign(size, x);
}

bool same(double a, double b) {
  return (std::isnan(a) && std::isnan(b)) ||
         std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

TEST(Half, HoldsEachOfThe65536ValuesAsItIs) {
  for (unsigned bits = 0; bits < 0x10000; ++bits) {
    const double x = decoded(bits);
    EXPECT_TRUE(same(value(Half(x)), x)) << bits;
    EXPECT_TRUE(same(value(Half(static_cast<float>(x))), x)) << bits;
    EXPECT_TRUE(same(value(Half(static_cast<long double>(x))), x)) << bits;
    EXPECT_TRUE(same(value(-Half(x)), -x)) << bits;
  }
}

TEST(Half, RoundsEachMidpointToEvenAndItsNeighboursToTheirSide) {
  for (std::size_t k = 0; k + 1 < steps().size(); ++k) {
    const double low = steps()[k], high = steps()[k + 1] == 65536 ? inf : steps()[k + 1];
    const double middle = (steps()[k] + steps()[k + 1]) / 2, even = k % 2 ? high : low;
    const auto check = [&]<class F>(F) {
      const F m = static_cast<F>(middle);
      ASSERT_EQ(static_cast<double>(m), middle);
      for (const F sign : {F(1), F(-1)}) {
        const double s = static_cast<double>(sign);
        ASSERT_EQ(value(Half(sign * m)), s * even) << middle;
        ASSERT_EQ(value(Half(sign * std::nextafter(m, F(0)))), s * low) << middle;
        ASSERT_EQ(value(Half(sign * std::nextafter(m, F(1e6)))), s * high) << middle;
      }
    };
    check(0.0F);
    check(0.0);
    check(0.0L);
  }
}

TEST(Half, TakesWhatLiesBeyondItsRangeToInfinityOrToZero) {
  EXPECT_EQ(value(Half(65519.996F)), 65504);
  EXPECT_EQ(value(Half(65520)), inf);
  EXPECT_EQ(value(Half(-65520)), -inf);
  EXPECT_EQ(value(Half(1 << 30)), inf);
  EXPECT_EQ(value(Half(std::numeric_limits<int>::min())), -inf);
  EXPECT_EQ(value(Half(1e300)), inf);
  EXPECT_EQ(value(Half(std::numeric_limits<long double>::max())), inf);
  EXPECT_EQ(value(Half(0x1p-25)), 0);
  EXPECT_EQ(value(Half(0x1.0000000000001p-25)), 0x1p-24);
  EXPECT_TRUE(same(value(Half(-1e-300)), -0.0));
  EXPECT_TRUE(std::isnan(value(Half(std::nan("")))));
}

TEST(Half, TakesConstantsFromLongDoubleInOneRounding) {
  // Above the tie 1 + 2⁻¹¹ by less than a float or a double can tell.
  EXPECT_EQ(value(constant<Half>(1 + 0x1p-11L + 0x1p-60L)), 1 + 0x1p-10);
  EXPECT_EQ(value(constant<Half>(1 + 0x1p-11L - 0x1p-60L)), 1);
  EXPECT_EQ(value(constant<Half>(1 + 0x1p-11L)), 1);
  EXPECT_EQ(value(pi<Half>()), 3.140625);
}

TEST(Half, HasTheLimitsOfBinary16) {
  using Limits = std::numeric_limits<Half>;
  EXPECT_EQ(value(Limits::max()), decoded(0x7bff));
  EXPECT_EQ(value(Limits::min()), decoded(0x0400));
  EXPECT_EQ(value(Limits::min()), std::ldexp(1, Limits::min_exponent - 1));
  EXPECT_EQ(value(Limits::epsilon()), decoded(0x3c01) - 1);
  EXPECT_EQ(value(Limits::epsilon()), std::ldexp(1, 1 - Limits::digits));
}

/// The sign of the exact a ÷ b − c and of √a − c, from products that a double holds exactly.
double quotient(double a, double b) {
  const double size = nearest([=](double c) { return std::abs(a) - c * std::abs(b); });
  return std::signbit(a) == std::signbit(b) ? size : -size;
}
double root(double a) {
  return nearest([=](double c) { return a - c * c; });
}

void expect_exact(double a, double b) {
  const Half x(a), y(b);
  // Sums and products of two halves are exact in double.
  ASSERT_TRUE(same(value(x + y), nearest(a + b))) << a << " + " << b;
  ASSERT_TRUE(same(value(x - y), nearest(a - b))) << a << " - " << b;
  ASSERT_TRUE(same(value(x * y), nearest(a * b))) << a << " * " << b;
  if (b != 0) {
    ASSERT_TRUE(same(value(x / y), quotient(a, b))) << a << " / " << b;
  }
}

TEST(Half, RoundsTheProductAndTheQuotientOfAnyTwoSignificandsOnceAlsoToSubnormals) {
  for (int a = 1024; a < 2048; ++a)
    for (int b = 1024; b < 2048; ++b) {
      const double x = a, y = std::ldexp(b, -10), small = std::ldexp(a, -24), less = y / 8,
                   more = 8 * y;
      ASSERT_EQ(value(Half(x) * Half(y)), nearest(x * y)) << a << " " << b;
      ASSERT_EQ(value(Half(x) / Half(y)), quotient(x, y)) << a << " " << b;
      ASSERT_EQ(value(Half(small) * Half(less)), nearest(small * less)) << a << " " << b;
      ASSERT_EQ(value(Half(small) / Half(more)), quotient(small, more)) << a << " " << b;
    }
}

TEST(Half, RoundsTheRootOfEveryValueOnce) {
  for (unsigned bits = 0; bits < 0x7c00; ++bits)
    ASSERT_EQ(value(sqrt(Half(decoded(bits)))), root(decoded(bits))) << decoded(bits);
  EXPECT_EQ(value(sqrt(Half(inf))), inf);
  EXPECT_TRUE(std::isnan(value(sqrt(Half(-1)))));
}

TEST(Half, RoundsEverySumDifferenceProductAndQuotientOfTwoMillionPairsOnce) {
  std::mt19937 random(1);
  // Any two of the values; and two of like size, where sums cancel and carry.
  for (int i = 0; i < 2'000'000; ++i) {
    const unsigned a = random() & 0xffff;
    unsigned b = random() & 0xffff;
    if (i % 2) b = (b & 0x8000) | ((a + (b & 0x1fff)) & 0x7fff);
    if ((a & 0x7c00) == 0x7c00 || (b & 0x7c00) == 0x7c00) continue;
    expect_exact(decoded(a), decoded(b));
    if (HasFatalFailure()) return;
  }
}

TEST(Half, RoundsSumsAmongTheSubnormalsAndAtTheEndsOnce) {
  std::vector<double> values;
  for (unsigned bits = 0; bits < 0x7c00; bits += bits < 0x440 || bits > 0x7bc0 ? 7 : 997) {
    values.push_back(decoded(bits));
    values.push_back(-decoded(bits));
  }
  for (const double a : values)
    for (const double b : values) {
      expect_exact(a, b);
      if (HasFatalFailure()) return;
    }
}

TEST(Half, ExpAndLogOfEveryValueAreTheExactOnesRoundedOnce) {
  for (unsigned bits = 0; bits < 0x10000; ++bits) {
    const double x = decoded(bits);
    if (std::isnan(x)) continue;
    const auto wide = static_cast<long double>(x);
    // long double tells the sides of every tie: none of the exact values comes within its last
    // digits
    const auto rounded = [](long double y) {
      if (std::isnan(y) || std::isinf(y) || y == 0) return static_cast<double>(y);
      const double size = nearest([s = std::abs(y)](double c) {
        return static_cast<double>(s - static_cast<long double>(c));
      });
      return y < 0 ? -size : size;
    };
    ASSERT_TRUE(same(value(exp(Half(x))), rounded(std::exp(wide)))) << x;
    ASSERT_TRUE(same(value(log(Half(x))), rounded(std::log(wide)))) << x;
  }
}

TEST(Half, RoundsAfterEveryOperationAndNotOnceAtTheEnd) {
  EXPECT_EQ(value(Half(2048) + 1 + 1), 2048);
  EXPECT_EQ(value(Half(2048) + (Half(1) + 1)), 2050);
  EXPECT_EQ(value(Half(300) * Half(300) / Half(300)), inf);
}

TEST(Half, RaisesAFlagWhereItsRangeEndsAndNowhereElse) {
  const auto flags = [](auto&& work) {
    half_flags = {};
    work();
    return std::pair(half_flags.overflow, half_flags.underflow);
  };
  constexpr std::pair none(false, false), overflow(true, false), underflow(false, true);
  const Half large(65504), small(0x1p-14), least(0x1p-24), infinite(inf);
  EXPECT_EQ(flags([&] { return large + Half(15); }), none);
  EXPECT_EQ(flags([&] { return large + Half(16); }), overflow);
  EXPECT_EQ(flags([&] { return large * large; }), overflow);
  EXPECT_EQ(flags([&] { return Half(1e300); }), overflow);
  EXPECT_EQ(flags([&] { return infinite * 2; }), none);
  EXPECT_EQ(flags([&] { return 1 / Half(0); }), none);
  EXPECT_EQ(flags([&] { return small / 2; }), none);  // still exact
  EXPECT_EQ(flags([&] { return small * Half(0.9); }), underflow);
  EXPECT_EQ(flags([&] { return least / 2; }), underflow);
  EXPECT_EQ(flags([&] { return small - least; }), none);
  EXPECT_EQ(flags([&] { return Half(1e-300); }), underflow);
  EXPECT_EQ(flags([&] { return exp(Half(-65504)); }), underflow);
  EXPECT_EQ(flags([&] { return exp(Half(65504)); }), overflow);
  EXPECT_EQ(flags([&] { return exp(Half(-5)) + log(least) + sqrt(least); }), none);
  EXPECT_EQ(flags([&] { return large * 0; }), none);
}

// ---- Liberties
// ------------------------------------------------------------------------------------

using Flushed = HalfOver<float, HalfRules{true, false}>;
using Contracted = HalfOver<float, HalfRules{false, true}>;

TEST(Half, FlushedIsZeroWhereItWouldBeSubnormalAndElseTheSame) {
  for (unsigned bits = 0; bits < 0x10000; ++bits) {
    const double x = decoded(bits), kept = std::abs(x) < 0x1p-14 ? std::copysign(0.0, x) : x;
    ASSERT_TRUE(same(static_cast<double>(Flushed(x)), kept)) << x;
    ASSERT_TRUE(same(static_cast<double>(Flushed(x) * 1), kept)) << x;
  }
  EXPECT_EQ(static_cast<double>(Flushed(0x1p-14) - Flushed(0x1.004p-14)), 0);
  EXPECT_EQ(static_cast<double>(Flushed(0x1p-14 - 0x1p-26)), 0x1p-14);  // rounded first
}

/// The sign of a b + c − x, exactly: a double holds a b as it does c − x.
double contracted(double a, double b, double c) {
  const double s = a * b < -c ? -1 : 1;
  return s * nearest([=](double x) { return s * a * b - (x - s * c); });
}

void expect_contracted(double a, double b, double c) {
  const Contracted x(a), y(b), z(c);
  const auto value = [](const Contracted& h) { return static_cast<double>(h); };
  ASSERT_EQ(value(x * y + z), contracted(a, b, c)) << a << " * " << b << " + " << c;
  ASSERT_EQ(value(z + x * y), contracted(a, b, c)) << a << " * " << b << " + " << c;
  ASSERT_EQ(value(x * y - z), contracted(a, b, -c)) << a << " * " << b << " - " << c;
  ASSERT_EQ(value(z - x * y), contracted(-a, b, c)) << c << " - " << a << " * " << b;
  ASSERT_EQ(value(-(x * y) + z), contracted(-a, b, c)) << c << " - " << a << " * " << b;
  ASSERT_TRUE(same(value(x * y), nearest(a * b))) << a << " * " << b;
}

TEST(Half, ContractedRoundsAProductAndASumOnceInAMillionPlaces) {
  std::mt19937 random(2);
  for (int i = 0; i < 1'000'000; ++i) {
    const double a = decoded(random() & 0xffff), b = decoded(random() & 0xffff);
    double c = decoded(random() & 0xffff);
    // beside the product, and where what is lost of the product decides
    if (i % 4 == 1) c = -value(Half(a * b));
    if (i % 4 == 2) c = std::ldexp(value(Half(a * b)), static_cast<int>(random() % 50) - 25);
    c = value(Half(c));
    if (!std::isfinite(a) || !std::isfinite(b) || !std::isfinite(c)) continue;
    expect_contracted(a, b, c);
    if (HasFatalFailure()) return;
  }
}

TEST(Half, ContractedRoundsTheSecondOfTwoProductsAndWhatWasSelected) {
  const Contracted x(1 + 0x1p-10), one(1), zero(0);
  const auto value = [](const Contracted& h) { return static_cast<double>(h); };
  const double square = value(x * x);
  EXPECT_EQ(square, 1 + 0x1p-9);
  EXPECT_EQ(value(x * x - Contracted(square) * one),
            0x1p-20);  // of the first the digits that a half has not
  EXPECT_EQ(value(one * one - x * x), 1 - square);
  EXPECT_EQ(value(select<Contracted>(true, x * x, one) - Contracted(square)), 0);
  EXPECT_EQ(value((x * x + zero) - Contracted(square)), 0);
}

TEST(Half, RoundsAnIntegerBeforeItIsUsed) {
  EXPECT_EQ(value(2049 - Half(2048)), 0);
  EXPECT_EQ(value(Half(1) * 2051), 2052);
  EXPECT_EQ(value(1 / Half(3)), 0.333251953125);
  EXPECT_EQ(value(Half(1) / 3), 0.333251953125);
  EXPECT_EQ(value(3 * Half(0.5) + 1), 2.5);
  EXPECT_EQ(value(1 + Half(0.5) - 2), -0.5);
}

}  // namespace
}  // namespace gonio
