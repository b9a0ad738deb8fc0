#include "number/counted.h"

#include <thread>

#include "number/half.h"
#include "number/quotient.h"

namespace gonio {
namespace {

using C = Counted<double>;
static_assert(Real<C> && Real<Counted<float>> && Real<Counted<Half>>);
static_assert(std::same_as<base_t<C>, double> && std::same_as<plain_t<C>, C>);

using O = Operation;

Operations operations(std::initializer_list<std::pair<Operation, std::size_t>> counts) {
  Operations all;
  for (const auto& [kind, n] : counts) all[kind] = n;
  return all;
}

TEST(Counted, CountsEachKindOfOperationApart) {
  const C x(4), y(3);
  const auto counted = [](auto&& work) { return count_operations(work); };
  EXPECT_EQ(counted([&] { return x + y; }), operations({{O::add, 1}}));
  EXPECT_EQ(counted([&] { return 1 - x; }), operations({{O::add, 1}}));
  EXPECT_EQ(counted([&] { return x * y; }), operations({{O::mul, 1}}));
  EXPECT_EQ(counted([&] { return 2 * x; }), operations({{O::mul, 1}}));
  EXPECT_EQ(counted([&] { return x / 2; }), operations({{O::div, 1}}));
  EXPECT_EQ(counted([&] { return sqrt(x); }), operations({{O::sqrt, 1}}));
  EXPECT_EQ(counted([&] { return exp(x); }), operations({{O::exp, 1}}));
  EXPECT_EQ(counted([&] { return log(x); }), operations({{O::log, 1}}));
  EXPECT_EQ(counted([&] { return x < y; }), operations({{O::compare, 1}}));
  EXPECT_EQ(counted([&] { return select<C>(true, x, y); }), operations({{O::select, 1}}));
}

TEST(Counted, CountsNeitherNegationsNorConstantsNorTheLogicOfMasks) {
  const C x(4);
  EXPECT_EQ(count_operations([&] { return -x; }), Operations{});
  EXPECT_EQ(count_operations([] { return pi<C>(); }), Operations{});
  const bool m = x < C(5);
  EXPECT_EQ(count_operations([&] { return (m && !m) || m; }), Operations{});
}

TEST(Counted, CountsBothSidesOfASelect) {
  const C x(4);
  EXPECT_EQ(count_operations([&] { return select<C>(x < C(0), -x, sqrt(x) * 3); }),
            operations({{O::sqrt, 1}, {O::mul, 1}, {O::compare, 1}, {O::select, 1}}));
  EXPECT_EQ(count_operations([&] { return max(x, C(1)); }),
            operations({{O::compare, 1}, {O::select, 1}}));
}

/// GGX as a shader writes it: a² / (π ((NoH a² − NoH) NoH + 1)²)
template <Real T>
T ggx(const T& a, const T& noh) {
  const T a2 = square(a), t = (noh * a2 - noh) * noh + 1;
  return as_value<T>(Quotient<T>{a2, pi<T>() * square(t)});
}

TEST(Counted, CountsAKnownFormulaAndComputesItsValue) {
  C d;
  const auto counts = count_operations([&] { d = ggx(C(0.3), C(0.9)); });
  EXPECT_EQ(counts, operations({{O::add, 2}, {O::mul, 5}, {O::div, 1}}));
  EXPECT_EQ(d.value(), ggx(0.3, 0.9));
}

TEST(Counted, ComputesInTheNumberUnderneath) {
  EXPECT_EQ(static_cast<double>(ggx(Counted<Half>(Half(0.3)), Counted<Half>(Half(0.9))).value()),
            static_cast<double>(ggx(Half(0.3), Half(0.9))));
}

TEST(Counted, NestedCountsAreOfTheirOwnWork) {
  const C x(2);
  Operations inner;
  const auto outer = count_operations([&] {
    const C y = x * x;
    inner = count_operations([&] { return y + y; });
    return y / x;
  });
  EXPECT_EQ(inner, operations({{O::add, 1}}));
  EXPECT_EQ(outer, operations({{O::add, 1}, {O::mul, 1}, {O::div, 1}}));
}

TEST(Counted, WhatAnotherThreadDoesDoesNotCountHere) {
  const C x(2);
  EXPECT_EQ(count_operations([&] { std::jthread([&] { sqrt(x); }); }), Operations{});
}

}  // namespace
}  // namespace gonio
