#include "stability/regroup.h"

#include <cmath>
#include <set>

#include "base/error.h"
#include "number/half.h"
#include "stability/subjects.h"
#include "stability/value_over.h"

#include <gtest/gtest.h>

namespace gonio::stability {
namespace {

/// Graph of a formula of three inputs.
template <class F>
Graph traced(auto&& formula) {
  Graph g;
  const Trace::Recording recording(g.trace);
  using T = Traced<F>;
  const T a = T::input("a"), b = T::input("b"), c = T::input("c");
  g.value = formula(a, b, c).node();
  return g;
}
template <class F>
F value(const Graph& g, F a, F b, F c) {
  return replay<F>(g.trace, {a, b, c})[static_cast<std::size_t>(g.value)];
}

TEST(Regroup, KeepsTheValueInExactArithmetic) {
  const auto g = traced<float>([](auto a, auto b, auto c) {
    const auto s = a - (b - c) + (a * b) / (c * c * a);
    return -s * s + (1 - (1 - c)) / (s * b) - sqrt(max(a * b * c, c - b));
  });
  const double as_written = value(g, 3.0, 0.7, 1.9);
  for (std::uint64_t seed = 1; seed <= 50; ++seed)
    EXPECT_NEAR(value(regrouped(g, seed), 3.0, 0.7, 1.9), as_written, 1e-13) << seed;
}

TEST(Regroup, MovesWhatCancelsAndTheOrderOfProducts) {
  const auto cancels = traced<float>([](auto a, auto b, auto c) { return a - (a - b) + (c - c); });
  std::set<float> values;
  for (std::uint64_t seed = 1; seed <= 50; ++seed)
    values.insert(value(regrouped(cancels, seed), 1.0F, 1e-9F, 0.0F));
  EXPECT_TRUE(values.contains(0)) << "1 − (1 − b)";
  EXPECT_TRUE(values.contains(1e-9F)) << "(1 − 1) + b";

  const auto product = traced<Half>([](auto a, auto b, auto c) { return a * b * c; });
  bool finite = false, overflows = false;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const auto x =
        static_cast<double>(value(regrouped(product, seed), Half(1000), Half(0.01), Half(1000)));
    (std::isfinite(x) ? finite : overflows) = true;
  }
  EXPECT_TRUE(finite && overflows) << "1000 · 1000 is more than a half holds";
}

TEST(Regroup, IsTheSameForASeed) {
  const auto g = traced<float>([](auto a, auto b, auto c) { return a * b / c + a + b + c; });
  const auto once = regrouped(g, 3), again = regrouped(g, 3);
  ASSERT_EQ(once.trace.nodes().size(), again.trace.nodes().size());
  for (std::size_t k = 0; k < once.trace.nodes().size(); ++k) {
    EXPECT_EQ(once.trace.nodes()[k].kind, again.trace.nodes()[k].kind);
    EXPECT_EQ(once.trace.nodes()[k].of, again.trace.nodes()[k].of);
  }
}

TEST(Regroup, CostsNothingWhereThereIsOneOrder) {
  // f0 in every direction.
  const auto r = regrouping(subject("fresnel.constant", Given::facet), Number::float_);
  ASSERT_TRUE(r);
  EXPECT_EQ(r->regrouped, r->written);
  EXPECT_EQ(r->lost, 0U);
}

TEST(Regroup, CostsTheDigitsThatADifferenceKept) {
  // Blinn's G takes 2 NoH NoL / VoH; the exact dielectric keeps what cancels in one order.
  const auto s =
      subject("ndf.ggx", Given::cross, {{"alpha", {0.01, 1}}, {"sin2_theta_h", {1e-4, 0.9}}});
  const auto r = regrouping(s, Number::float_);
  ASSERT_TRUE(r);
  EXPECT_GT(r->written, 0);
  EXPECT_LT(r->written, 1e-5);
  EXPECT_GE(r->regrouped, r->written);
  EXPECT_EQ(r->no_value, 0U);
  const auto again = regrouping(s, Number::float_);
  EXPECT_EQ(r->regrouped, again->regrouped);
  EXPECT_EQ(r->at, again->at);
}

TEST(Regroup, RefusesOtherNumbersAndFormulasThatAHalfDoesNotHold) {
  EXPECT_THROW(regrouping(subject("ndf.ggx", Given::cross), Number::double_), Error);
  EXPECT_FALSE(regrouping(subject("masking.smith_gtr.correlated", Given::cosines), Number::half));
}

}  // namespace
}  // namespace gonio::stability
