// F0 and the index that has it, there and back.
#include "optics/f0.h"

#include <array>
#include <cmath>

namespace gonio {
namespace {

template <template <class> class Map>
auto map(std::same_as<double> auto... p) {
  const std::array a{p...};
  return Map<double>::apply(a);
}

TEST(F0FromIor, IsTheSquaredRatio) {
  EXPECT_DOUBLE_EQ(map<F0FromIor>(1.5, 1.0)[0], 0.04);
  EXPECT_DOUBLE_EQ(map<F0FromIor>(1.0, 1.5)[0], 0.04) << "the same from inside";
  EXPECT_DOUBLE_EQ(map<F0FromIor>(3.0, 2.0)[0], 0.04);
  EXPECT_EQ(map<F0FromIor>(1.33, 1.33)[0], 0);
}

TEST(F0FromIorAsWritten, LacksTheSquare) {
  EXPECT_DOUBLE_EQ(map<F0FromIorAsWritten>(1.5, 1.0)[0], 0.2);
  EXPECT_DOUBLE_EQ(map<F0FromIorAsWritten>(1.0, 1.5)[0], -0.2);
}

TEST(IorFromF0, UndoesF0FromIor) {
  EXPECT_EQ(map<IorFromF0>(0.0)[0], 1);
  EXPECT_DOUBLE_EQ(map<IorFromF0>(0.04)[0], 1.5);
  for (const double eta : {1.0, 1.001, 1.33, 2.42, 4.0, 9.0})
    EXPECT_NEAR(map<IorFromF0>(map<F0FromIor>(eta, 1.0)[0])[0], eta, 1e-14 * eta);
}

TEST(F0Metallic, IsFourPercentOfADielectricAndTheColourOfAMetal) {
  using Pair = std::array<double, 2>;
  EXPECT_EQ(map<F0Metallic>(0.7, 0.0), (Pair{0.04, 0.7}));
  EXPECT_EQ(map<F0Metallic>(0.7, 1.0), (Pair{0.7, 0}));
  const auto [f0, kd] = map<F0Metallic>(0.5, 0.25);
  EXPECT_DOUBLE_EQ(f0, 0.155);
  EXPECT_DOUBLE_EQ(kd, 0.375);
}

TEST(IndexFromEdgeTint, IsThePapersAtBothEnds) {
  const auto [n_max, k_0] = map<IndexFromEdgeTint>(0.25, 0.0);
  EXPECT_DOUBLE_EQ(n_max, 3);  // (1 + ½)/(1 − ½)
  EXPECT_EQ(k_0, 0);
  const auto [n_min, k_1] = map<IndexFromEdgeTint>(0.25, 1.0);
  EXPECT_DOUBLE_EQ(n_min, 0.6);  // (1 − ¼)/(1 + ¼)
  EXPECT_DOUBLE_EQ(k_1, 0.8);    // 2 ½/(1 + ¼)
}

TEST(IndexFromEdgeTint, IsUndoneByEdgeTintFromIndex) {
  for (const double f0 : {1e-6, 0.001, 0.04, 0.25, 0.6, 0.9, 0.999, 0.9999})
    for (const double g : {0.0, 0.01, 0.3, 0.5, 0.99, 1.0}) {
      const auto [eta, k] = map<IndexFromEdgeTint>(f0, g);
      const auto [r, back] = map<EdgeTintFromIndex>(eta, k);
      EXPECT_NEAR(r, f0, 1e-9 * f0) << f0 << " " << g;
      EXPECT_NEAR(back, g, 1e-9) << f0 << " " << g;
    }
}

TEST(EdgeTintFromIndex, IsUndoneByIndexFromEdgeTint) {
  for (const double n : {0.06, 0.42, 1.0, 1.5, 3.2})
    for (const double k : {1e-6, 0.1, 1.0, 3.6, 8.0}) {
      const auto [f0, g] = map<EdgeTintFromIndex>(n, k);
      if (g > 1) continue;  // absorbs too little for the paper's range
      const auto [eta, back] = map<IndexFromEdgeTint>(f0, g);
      EXPECT_NEAR(eta, n, 1e-9 * n) << n << " " << k;
      EXPECT_NEAR(back, k, 1e-9 * k) << n << " " << k;
    }
}

TEST(EdgeTintFromIndex, OfNothingIsNothing) {
  EXPECT_EQ(map<EdgeTintFromIndex>(1.0, 0.0), (std::array{0.0, 0.0}));
  EXPECT_EQ(map<EdgeTintFromIndex>(1.5, 0.0)[1], 0);
  EXPECT_GT(map<EdgeTintFromIndex>(0.5, 0.0)[1], 1) << "no tint of the paper gives n < 1 without k";
}

}  // namespace
}  // namespace gonio
