#include "number/interval.h"

#include <random>

#include "many_fits.h"
#include "number/wide.h"

namespace gonio {
namespace {

/// End of an interval, of all sizes, and often a short number.
double drawn(std::mt19937_64& random) {
  const int digits = random() % 2 ? 3 : 53;
  const double size = std::ldexp(static_cast<double>(random() >> (64 - digits)),
                                 static_cast<int>(random() % 80) - 60);
  return random() % 2 ? size : -size;
}

TEST(Interval, HoldsWhatAnExactFormulaGives) {
  std::mt19937_64 random(5);
  const auto holds = [](const Interval& i, const Wide& x) { return i.low <= x && x <= i.high; };
  for (std::size_t k = 0; k < test::few(20'000, 1'000); ++k) {
    double ends[4];
    for (double& end : ends) end = drawn(random);
    if (k % 5 == 0) ends[1] = ends[0], ends[3] = ends[2];
    const Interval a{std::min(ends[0], ends[1]), std::max(ends[0], ends[1])},
        b{std::min(ends[2], ends[3]), std::max(ends[2], ends[3])};
    for (const double x : {a.low, a.high})
      for (const double y : {b.low, b.high}) {
        const Wide u(x), v(y);
        ASSERT_TRUE(holds(a + b, u + v)) << x << " " << y;
        ASSERT_TRUE(holds(a - b, u - v)) << x << " " << y;
        ASSERT_TRUE(holds(a * b, u * v)) << x << " " << y;
        if (y != 0) {
          ASSERT_TRUE(holds(a / b, u / v)) << x << " " << y;
        }
        if (x >= 0) {
          ASSERT_TRUE(holds(sqrt(a), sqrt(u))) << x;
        }
      }
  }
}

TEST(Interval, OfWhatIsExactIsThat) {
  const Interval x{0.25, 1}, one{1, 1};
  EXPECT_EQ((one - x).low, 0);
  EXPECT_EQ((one - x).high, 0.75);
  EXPECT_EQ((x * x).low, 0.0625);
  EXPECT_EQ((one / x).high, 4);
  EXPECT_EQ(sqrt(x).low, 0.5);
  EXPECT_EQ((x * Interval{0, 0}).high, 0);
  EXPECT_EQ(Interval::holding(0.5L).low, 0.5);
}

TEST(Interval, OfASquareIsNotBelowZero) {
  EXPECT_EQ((square(Interval{-3, 2}).low), 0);
  EXPECT_EQ((square(Interval{-3, 2}).high), 9);
  EXPECT_EQ((square(Interval{-3, -2}).low), 4);
}

TEST(Interval, OfWhatIsNotExactIsTheNumbersAroundIt) {
  const auto narrow = [](const Interval& i) {
    EXPECT_LT(i.low, i.high);
    EXPECT_LE(i.high, std::nextafter(std::nextafter(i.low, 9), 9));
  };
  const Interval one{1, 1}, three{3, 3};
  narrow(Interval::holding(0.7L));
  narrow(one / three);
  narrow(sqrt(three));
  narrow(one + Interval{0x1p-80, 0x1p-80});
  narrow(Interval{0x1.8p-540, 0x1.8p-540} * Interval{0x1p-540, 0x1p-540});
  EXPECT_EQ((Interval{1e300, 1e300} * Interval{1e300, 1e300}).high, Interval::infinity);
  EXPECT_LT((Interval{1e300, 1e300} * Interval{1e300, 1e300}).low, Interval::infinity);
}

TEST(Interval, OfWhatIsNoNumberIsAny) {
  for (const auto& any :
       {sqrt(Interval{-1, 1}), Interval{1, 1} / Interval{-1, 1}, Interval{1, 1} / Interval{0, 1},
        Interval{} - Interval{}, Interval{0, 0} * Interval{}}) {
    EXPECT_EQ(any.low, -Interval::infinity);
    EXPECT_EQ(any.high, Interval::infinity);
  }
}

}  // namespace
}  // namespace gonio
