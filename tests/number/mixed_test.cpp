#include "number/mixed.h"

#include <cmath>

namespace gonio {
namespace {

static_assert(Real<Mixed> && std::same_as<plain_t<Mixed>, Mixed>);

using Precision = Mixed::Precision;

Mixed half(double x) {
  return Mixed(Half(x));
}
Mixed single(double x) {
  return Mixed(static_cast<float>(x));
}
double rounded(double x) {
  return static_cast<double>(Half(x));
}

TEST(Mixed, OfTwoHalvesIsTheHalf) {
  const Mixed sum = half(2048) + half(1), root = sqrt(half(2));
  EXPECT_EQ(sum.precision(), Precision::half);
  EXPECT_EQ(sum.value(), 2048);
  EXPECT_EQ(root.value(), rounded(std::sqrt(2.0)));
  EXPECT_EQ(exp(half(1)).value(), rounded(std::exp(1.0)));
  EXPECT_EQ(log(half(3)).value(), rounded(std::log(3.0)));
  EXPECT_EQ((-half(0.1)).value(), -rounded(0.1));
  EXPECT_TRUE(std::isinf((half(300) * half(300)).value()));
}

TEST(Mixed, OfAHalfAndAFloatIsTheFloat) {
  for (const Mixed& product : {half(0.1) * single(3.3), single(3.3) * half(0.1)}) {
    EXPECT_EQ(product.precision(), Precision::single);
    EXPECT_EQ(product.value(), static_cast<double>(static_cast<float>(rounded(0.1)) * 3.3F));
  }
  EXPECT_EQ((single(2048) + half(1)).value(), 2049);
}

TEST(Mixed, OfALiteralTakesTheOthersPrecision) {
  const Mixed tenth = constant<Mixed>(0.1L);
  EXPECT_EQ(tenth.precision(), Precision::literal);
  EXPECT_EQ((tenth * half(1)).value(), rounded(0.1));
  EXPECT_EQ((tenth * half(1)).precision(), Precision::half);
  EXPECT_EQ((tenth * single(1)).value(), static_cast<double>(0.1F));
  EXPECT_EQ((tenth * single(1)).precision(), Precision::single);
  EXPECT_EQ((half(2048) + 1).value(), 2048);
  EXPECT_EQ((2049 - half(2048)).value(), 0);
  EXPECT_EQ((single(2048) + 1).value(), 2049);
}

TEST(Mixed, OfTwoLiteralsIsFoldedInDouble) {
  const Mixed third = Mixed(1) / Mixed(3);
  EXPECT_EQ(third.precision(), Precision::literal);
  EXPECT_EQ(third.value(), 1.0 / 3);
  EXPECT_EQ((third * half(1)).value(), rounded(1.0 / 3));
}

TEST(Mixed, ComparesAndSelectsInTheHigherPrecisionOfItsSides) {
  EXPECT_TRUE(single(0.1) < half(0.3));
  EXPECT_FALSE(constant<Mixed>(2048.5L) < half(2048));
  EXPECT_FALSE(half(2048) < constant<Mixed>(2048.5L));  // the literal is 2048 there
  EXPECT_TRUE(single(2048) < constant<Mixed>(2048.5L));
  const Mixed chosen = max(half(0.1), single(0.01));
  EXPECT_EQ(chosen.value(), rounded(0.1));
  EXPECT_EQ(chosen.precision(), Precision::single);
  EXPECT_EQ(min(half(70), constant<Mixed>(0.1L)).value(), rounded(0.1));
}

TEST(Mixed, IsRoundedOrWidenedWhereAVariableIsDeclared) {
  const Mixed narrow = in_half(single(0.1)), wide = in_float(half(0.1));
  EXPECT_EQ(narrow.value(), static_cast<double>(Half(0.1F)));
  EXPECT_EQ(narrow.precision(), Precision::half);
  EXPECT_EQ(wide.value(), rounded(0.1));
  EXPECT_EQ(wide.precision(), Precision::single);
  EXPECT_EQ(in_half(0.1), 0.1);
  EXPECT_EQ(in_float(0.1), 0.1);
}

/// float D_GGX_R2(half a, float NoH), as a mobile renderer ships it.
template <Real T>
T d_ggx_r2(const T& a, const T& noh) {
  const T a2 = a * a;
  const T d = (noh * a2 - noh) * noh + 1;
  return min<T>(a2 / (d * d), T(2048));
}

TEST(Mixed, ComputesAShippedFormulaAsItsDeclarationsSay) {
  for (const double alpha : {0.02, 0.1, 0.3, 0.77, 1.0})
    for (const double noh : {0.1, 0.9, 0.999, 0.99999, 1.0}) {
      const Half a(alpha);
      const auto c = static_cast<float>(noh);
      const auto a2 = static_cast<float>(a * a);
      const float d = (c * a2 - c) * c + 1.0F;
      const Mixed mixed = d_ggx_r2(Mixed(a), Mixed(c));
      EXPECT_EQ(mixed.value(), static_cast<double>(std::min(a2 / (d * d), 2048.0F)))
          << alpha << noh;
      EXPECT_EQ(mixed.precision(), Precision::single);
    }
}

}  // namespace
}  // namespace gonio
