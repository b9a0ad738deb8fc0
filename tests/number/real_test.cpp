#include "number/real.h"

#include <array>
#include <numbers>

#include "number/archetype.h"
#include "number/batch.h"
#include "number/dual.h"
#include "number/parameter.h"
#include "number/quotient.h"

namespace gonio {
namespace {

static_assert(Real<double> && Real<float> && Real<Archetype>);
static_assert(Real<Batch<double>> && Real<Batch<float>>);
static_assert(Real<Dual<double, 3>> && Real<Dual<float, 1>>);
static_assert(Real<Dual<Batch<double>, 2>> && Real<Dual<Batch<float>, 2>>);
static_assert(!Real<int> && !Real<bool>);

static_assert(std::same_as<base_t<Dual<Batch<float>, 2>>, float>);
static_assert(std::same_as<plain_t<Dual<Batch<float>, 2>>, Batch<float>>);
static_assert(std::same_as<mask_t<Dual<Batch<float>, 2>>, mask_t<Batch<float>>>);
static_assert(std::same_as<mask_t<Dual<double, 2>>, bool>);

// What a formula may not do must not compile for the least of numbers.
template <class T>
concept BranchesOnMasks = requires(T a) {
  (a < a) ? a : a;
};
template <class T>
concept MixesWithDouble = requires(T a) {
  0.5 * a;
};
template <class T>
concept FallsBackToDouble = requires(T a) {
  std::sqrt(a);
};
template <class T>
concept ComesFromDoubleUnasked = std::convertible_to<double, T>;
static_assert(BranchesOnMasks<double> && MixesWithDouble<double> && FallsBackToDouble<double> &&
              ComesFromDoubleUnasked<double>);
static_assert(!BranchesOnMasks<Archetype> && !MixesWithDouble<Archetype> &&
              !FallsBackToDouble<Archetype> && !ComesFromDoubleUnasked<Archetype>);

// Unqualified functions keep the precision of their argument.
static_assert(std::same_as<decltype(sqrt(1.0F)), float> &&
              std::same_as<decltype(exp(1.0F)), float> && std::same_as<decltype(log(1.0F)), float>);

TEST(Constant, IsRoundedOnceToTheBaseType) {
  EXPECT_EQ(constant<double>(0.1L), 0.1);
  EXPECT_EQ(constant<float>(0.1L), 0.1F);
  EXPECT_EQ(constant<Archetype>(0.1L).value(), 0.1);
  EXPECT_EQ((constant<Dual<double, 2>>(0.1L).v), 0.1);
  EXPECT_EQ(pi<double>(), std::numbers::pi);
  EXPECT_EQ(pi<float>(), std::numbers::pi_v<float>);
}

TEST(Constant, OfADualOfBatchesIsNotTruncatedToAnInteger) {
  const auto half = constant<Dual<Batch<double>, 2>>(0.5L);
  for (std::size_t i = 0; i < lanes<Batch<double>>; ++i) {
    EXPECT_EQ(half.v.get(i), 0.5);
    EXPECT_EQ((Dual<Batch<float>, 2>(0.5).v.get(i)), 0.5F);
    EXPECT_EQ(half.d[0].get(i), 0);
    EXPECT_EQ(half.d[1].get(i), 0);
  }
}

TEST(MinAndMax, TakeTheirValueAndTheirDerivativesFromOneSide) {
  const auto a = Dual<double, 2>::variable(2, 0), b = Dual<double, 2>::variable(3, 1);
  EXPECT_EQ(max<double>(2, 3), 3);
  EXPECT_EQ(max<double>(3, 2), 3);
  EXPECT_EQ(min<double>(2, 3), 2);
  EXPECT_EQ(min<double>(3, 2), 2);
  EXPECT_EQ((max(a, b).d), (std::array<double, 2>{0, 1}));
  EXPECT_EQ((max(b, a).d), (std::array<double, 2>{0, 1}));
  EXPECT_EQ((min(a, b).d), (std::array<double, 2>{1, 0}));
  EXPECT_EQ((min(b, a).d), (std::array<double, 2>{1, 0}));
}

TEST(Quotient, DividesWhenAskedForItsValueAndNotBefore) {
  EXPECT_EQ(as_value<double>(Quotient<double>{1, 4}), 0.25);
  EXPECT_EQ(as_value<double>(3.0), 3);
  EXPECT_EQ(as_quotient<double>(3.0).num, 3);
  EXPECT_EQ(as_quotient<double>(3.0).den, 1);
  EXPECT_EQ(as_quotient<double>(Quotient<double>{1, 0}).num, 1);
  EXPECT_TRUE(as_quotient<double>(3.0).whole);
  EXPECT_FALSE((as_quotient<double>(Quotient<double>{3, 1}).whole));
}

TEST(Range, HoldsItsEndsAndNeverNaN) {
  constexpr Range r{1, 2};
  EXPECT_TRUE(r.holds(1));
  EXPECT_TRUE(r.holds(2));
  EXPECT_FALSE(r.holds(std::nextafter(2, 3)));
  EXPECT_FALSE(r.holds(std::nextafter(1, 0)));
  EXPECT_FALSE(r.holds(std::nan("")));
}

}  // namespace
}  // namespace gonio
