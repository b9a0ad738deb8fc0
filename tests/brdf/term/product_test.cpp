#include "brdf/term/product.h"

#include "number/dual.h"

namespace gonio {
namespace {

constexpr double base = 0.7, under = 0.4, weight = 0.3, dv = 2.5, fresnel = 0.2;

TEST(Product, IsTheLightThatALobeAddsLessWhatItTakesFromBelow) {
  EXPECT_EQ(lobe_on(Zero{}, Zero{}, One{}, dv, fresnel), dv * fresnel);
  EXPECT_EQ(lobe_on(base, Zero{}, One{}, dv, fresnel), base + dv * fresnel);
  EXPECT_EQ(lobe_on(base, under, One{}, dv, fresnel), base + (dv - under) * fresnel);
}

TEST(Product, LetsThroughWhatFresnelDoesNotReflect) {
  EXPECT_DOUBLE_EQ(lobe_on(under, under, One{}, dv, fresnel), fresnel * dv + (1 - fresnel) * under);
}

TEST(Product, WeighsALobeAsItsFresnel) {
  EXPECT_DOUBLE_EQ(lobe_on(base, under, weight, dv, fresnel),
                   lobe_on(base, under, One{}, dv, weight * fresnel));
}

TEST(Product, DividesFractionsOnce) {
  const Quotient<double> shape{3, 7}, f{2, 11};
  EXPECT_EQ(lobe_on(base, Zero{}, One{}, shape, f), base + 6.0 / 77.0);
  EXPECT_EQ(as_value<double>(lobe_on(Zero{}, Zero{}, One{}, shape, f)), 6.0 / 77.0);
}

TEST(Product, OfWhatIsNoFractionIsNone) {
  const auto shape = as_quotient<double>(2.5), f = as_quotient<double>(0.5);
  EXPECT_TRUE((shape * f).whole);
  EXPECT_FALSE((shape * Quotient<double>{0.5, 1}).whole);
  EXPECT_FALSE((Quotient<double>{2.5, 1} * f).whole);
  EXPECT_EQ((shape * f).value(), 1.25);
}

/// The rule's derivatives by all that it is given, by Dual, in the order weight, D V, F, what lies below.
Dual<double, 4> by_dual() {
  using T = Dual<double, 4>;
  const T below = T::variable(under, 3);
  return lobe_on(below + (base - under), below, T::variable(weight, 0), T::variable(dv, 1),
                 T::variable(fresnel, 2));
}

TEST(Product, HasThePartialDerivativesThatDualFinds) {
  const auto dual = by_dual();
  const Partials<double, Zero, Zero, Zero, One> sum{base, {}};
  const auto f =
      lobe_on(sum, input<3, 4>(under), input<0, 4>(weight), input<1, 4>(dv), input<2, 4>(fresnel));
  EXPECT_EQ(f.v, dual.v);
  EXPECT_EQ(std::get<0>(f.d), dual.d[0]);
  EXPECT_EQ(std::get<1>(f.d), dual.d[1]);
  EXPECT_EQ(std::get<2>(f.d), dual.d[2]);
  EXPECT_EQ(std::get<3>(f.d), dual.d[3]);
}

TEST(Product, KnowsWhenCompiledWhichDerivativesAreNone) {
  const auto f = lobe_on(Zero{}, Zero{}, One{}, input<0, 3>(dv), input<1, 3>(fresnel));
  EXPECT_EQ(std::get<0>(f.d), fresnel);
  EXPECT_EQ(std::get<1>(f.d), dv);
  static_assert(std::same_as<std::tuple_element_t<2, decltype(f.d)>, Zero>);
  const auto on_it =
      lobe_on(input<2, 3>(base), Zero{}, One{}, input<0, 3>(dv), input<1, 3>(fresnel));
  static_assert(std::same_as<std::tuple_element_t<2, decltype(on_it.d)>, One>);
}

}  // namespace
}  // namespace gonio
