#include "base/random.h"

namespace gonio {
namespace {

constexpr int n = 100'000;

TEST(Draws, AreTheSameForTheSameKeysAndNoOthers) {
  const auto first = [](auto... keys) { return Draws(keys...).uniform(); };
  EXPECT_EQ(first(1U, 2, 3), first(1U, 2, 3));
  EXPECT_NE(first(1U, 2, 3), first(1U, 3, 2));
  EXPECT_NE(first(1U, 2, 3), first(2U, 2, 3));
  EXPECT_NE(first(1U, 2), first(1U, 2, 0));
}

TEST(Draws, AreUniformAlongAStreamAndAcrossKeys) {
  Draws draw(1);
  double along = 0, along2 = 0, across = 0, product = 0;
  for (int i = 0; i < n; ++i) {
    const double u = draw.uniform(), k = Draws(1, 7, i).uniform();
    ASSERT_GT(u, 0);
    ASSERT_LE(u, 1);
    along += u / n;
    along2 += u * u / n;
    across += k / n;
    product += (k - 0.5) * (Draws(1, 7, i + 1).uniform() - 0.5) / n;
  }
  // five standard errors: √(1/12), √(4/45) and 1/12 over √n
  EXPECT_NEAR(along, 0.5, 5 * 0.289 / std::sqrt(n));
  EXPECT_NEAR(along2, 1 / 3.0, 5 * 0.298 / std::sqrt(n));
  EXPECT_NEAR(across, 0.5, 5 * 0.289 / std::sqrt(n));
  EXPECT_NEAR(product, 0, 5 * 0.083 / std::sqrt(n));
}

TEST(Draws, AreNormalWithTheMomentsOfTheNormalDistribution) {
  Draws draw(2);
  double mean = 0, square = 0, fourth = 0;
  for (int i = 0; i < n; ++i) {
    const double x = draw.normal();
    mean += x / n;
    square += x * x / n;
    fourth += x * x * x * x / n;
  }
  EXPECT_NEAR(mean, 0, 5 / std::sqrt(n));
  EXPECT_NEAR(square, 1, 5 * std::sqrt(2.0 / n));
  EXPECT_NEAR(fourth, 3, 5 * std::sqrt(96.0 / n));
}

}  // namespace
}  // namespace gonio
