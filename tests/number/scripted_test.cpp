#include "number/scripted.h"

#include "number/exact.h"
#include "number/quotient.h"

namespace gonio {
namespace {

static_assert(Real<Scripted<Half>> && Real<Scripted<float>> && Real<Scripted<double>>);

// The same sums of error terms are taken as in the number that is written down.
static_assert(computes_as_base<Scripted<Half>> && computes_as_base<Scripted<float>> &&
              computes_as_base<Scripted<double>>);

using S = Scripted<float>;

TEST(Scripted, WritesEachOperationRoundedAndExact) {
  Script script;
  const S x = S::input("x0", 1, 2), root = sqrt(x * x + 3), rest = 1 - x;
  EXPECT_EQ(script.text(),
            "r1 = rnd(x0 * x0); e1 = x0 * x0;\n"
            "r2 = rnd(r1 + 0xcp-2); e2 = e1 + 0xcp-2;\n"
            "r3 = rnd(sqrt(r2)); e3 = sqrt(e2);\n"
            "r4 = rnd(0x8p-3 - x0); e4 = 0x8p-3 - x0;\n");
  root / rest;
  EXPECT_EQ(script.refused(), "a value that is not proved to be finite") << "1 − x may be 0";
}

TEST(Scripted, RoundsAConstantInOneOfTheTwo) {
  Script script;
  const S third = S::input("x0", 1, 2) * constant<S>(1.0L / 3);
  EXPECT_NE(third.rounded(), third.exact());
  EXPECT_EQ(script.text(), "r1 = rnd(x0 * 0xa.aaaabp-5); e1 = x0 * 0xa.aaaaaaaaaaaaaabp-5;\n");
}

TEST(Scripted, DecidesWhatAllInputsDecideAlike) {
  Script script;
  const S x = S::input("x0", 1, 2);
  EXPECT_EQ((max<S>(1 - x, S(0))).rounded(), S(0).rounded()) << "they touch at 0";
  EXPECT_EQ((select<S>(S(0) < x, x, S(7))).rounded(), "x0");
  EXPECT_EQ(script.refused(), "");
  min<S>(x, constant<S>(1.5L));
  EXPECT_EQ(script.refused(), "a choice that inputs of the domain make differently");
}

TEST(Scripted, WritesTheTermsOfAProductsError) {
  Script script;
  const S x = S::input("x0", 1, 2), error = product_error<S>(x, x, x * x);
  EXPECT_NE(error.rounded(), S(0).rounded());
  EXPECT_NE(script.text().find(" = rnd(x0 * 0x8.008p+9);"), std::string::npos) << script.text();
}

TEST(Scripted, KnowsThatASquareIsNotBelowZero) {
  Script script;
  const S x = S::input("x0", -1, 1), s = x * x;
  EXPECT_EQ((max<S>(s, S(0))).rounded(), s.rounded());
  EXPECT_EQ(script.refused(), "");
  max<S>(x * -x, S(0));
  EXPECT_NE(script.refused(), "");
}

TEST(Scripted, RefusesAChoiceThatTheExactFormulaMakesDifferently) {
  // 0.7 is below 0.7L in float, so the least x is: but not below the constant as it is rounded.
  const float low = 0.7F;
  ASSERT_LT(low, 0.7L);
  const auto refused = [&](auto&& formula) {
    Script script;
    formula(S::input("x0", low, 2));
    return script.refused();
  };
  const auto c = [] { return constant<S>(0.7L); };
  const std::string other = "a choice that inputs of the domain make differently";
  EXPECT_EQ(refused([&](const S& x) { select<S>(x < c(), x, 2 * x); }), other);
  EXPECT_EQ(refused([&](const S& x) { select<S>(!(c() < x) && x < S(3), x, 2 * x); }), other);
  EXPECT_EQ(refused([&](const S& x) { max<S>(x, c()); }), other);
  EXPECT_EQ(refused([&](const S& x) { min<S>(c(), x); }), other);
  EXPECT_EQ(refused([&](const S& x) { select<S>(x < constant<S>(0.6L), x, 2 * x); }), "");
  EXPECT_EQ(refused([&](const S& x) { max<S>(x, constant<S>(0.6L)); }), "");
  EXPECT_EQ(refused([&](const S& x) { min<S>(x, S(2)); }), "") << "they touch, and do so exactly";
}

TEST(Scripted, DividesByWhatHappensToBeOne) {
  Script script;
  const S x = S::input("x0", 1, 2), same = x / select<S>(x < S(3), S(1), x);
  EXPECT_NE(same.rounded(), "x0");
  EXPECT_EQ(as_quotient<S>(x).value().rounded(), "x0");
}

TEST(Scripted, RefusesAConstantThatMayBeFlushed) {
  const RoundingScope scope(Rounding::vulkan());
  Script script;
  constant<S>(1e-30L);
  EXPECT_EQ(script.refused(), "");
  constant<Scripted<Half>>(1e-5L);
  EXPECT_EQ(script.refused(), "a constant that may be flushed");
}

TEST(Scripted, OfAnyGpuBoundsEachOperationByItself) {
  const RoundingScope scope(Rounding::vulkan());
  Script script;
  const S x = S::input("x0", 1, 2);
  sqrt(x * x) / x;
  EXPECT_EQ(script.text(),
            "r1 = mul_rel<23>(x0, x0); e1 = x0 * x0;\n"
            "q2 = sqrt(r1);\nr2 = mul_rel<20>(1, q2); e2 = sqrt(e1);\n"
            "q3 = r2 / x0;\nr3 = mul_rel<21>(1, q3); e3 = e2 / x0;\n");
  EXPECT_EQ(script.hints(), "1 * q2 -> q2;\n1 * q3 -> q3;\n");
}

TEST(Scripted, KnowsThatADifferenceOfNormalNumbersIsNotSubnormal) {
  const RoundingScope scope(Rounding{.flushed = true});
  Script normal;
  1 - S::input("x0", 0.001F, 1);
  EXPECT_EQ(normal.refused(), "");
  Script subnormal;
  const S small = S::input("x0", 1e-30F, 1);
  small* small;
  EXPECT_EQ(subnormal.refused(), "a value that may be subnormal");
}

TEST(Scripted, KnowsHowSmallADifferenceMayBe) {
  const RoundingScope scope(Rounding{.flushed = true});
  Script script;
  const S x = S::input("x0", 1, 2), y = S::input("x1", 1, 2), difference = x - y;  // 0 or 2⁻²⁴
  const S fifth = difference * difference * difference * difference * difference;
  EXPECT_EQ(script.refused(), "");
  fifth* difference;
  EXPECT_EQ(script.refused(), "a value that may be subnormal");
}

}  // namespace
}  // namespace gonio
