#include "number/traced.h"

#include <cmath>

#include "number/dual.h"
#include "number/exact.h"
#include "number/half.h"

namespace gonio {
namespace {

static_assert(Real<Traced<float>> && Real<Traced<Half>>);
// The same sums of error terms are taken as in the number that constants are folded in.
static_assert(computes_as_base<Traced<Half>> && computes_as_base<Traced<float>>);

using T = Traced<float>;

TEST(Traced, FoldsWhatIsKnownAsTheNumberRoundsIt) {
  Trace trace;
  const Trace::Recording recording(trace);
  const T third = constant<T>(1) / constant<T>(3);
  EXPECT_EQ(third.known(), 1.0F / 3.0F);
  EXPECT_EQ(static_cast<double>((constant<Traced<Half>>(1) / constant<Traced<Half>>(3)).known()),
            0.333251953125);
  EXPECT_EQ(sqrt(constant<T>(2)).known(), std::sqrt(2.0F));
  EXPECT_TRUE((constant<T>(1) < constant<T>(2)).known());
  EXPECT_TRUE(trace.nodes().empty());
}

TEST(Traced, MakesOneNodeOfWhatIsComputedTwice) {
  Trace trace;
  const Trace::Recording recording(trace);
  const T x = T::input("x"), y = T::input("y");
  const T a = x * y + 3, b = y * x + 3;
  EXPECT_EQ(a.node(), b.node()) << "in either order";
  EXPECT_NE((x - y).node(), (y - x).node());
  EXPECT_NE((x / y).node(), (y / x).node());
}

TEST(Traced, KeepsAComparisonWhateverItsInputsAre) {
  Trace trace;
  const Trace::Recording recording(trace);
  const T x = T::input("x");
  const T chosen = select<T>(x < T(0), -x, x);
  EXPECT_EQ(trace[chosen.node()].kind, Trace::Kind::select);
  EXPECT_EQ((select<T>(x < T(0), x, x)).node(), x.node()) << "there is nothing to choose";
  EXPECT_EQ(trace[max<T>(x, T(0)).node()].kind, Trace::Kind::max);
}

TEST(Traced, ComputesNothingOfALiteralZero) {
  Trace trace;
  const Trace::Recording recording(trace);
  const T x = T::input("x");
  EXPECT_EQ((T(0) + x).node(), x.node());
  EXPECT_EQ((x * 1).node(), x.node());
  EXPECT_TRUE((T(0) * x).is_known());
  EXPECT_FALSE((constant<T>(0.0L) * x).is_known()) << "a constant that is 0 may meet an infinity";
}

TEST(Traced, DividesByAPowerOfTwoAsAProduct) {
  Trace trace;
  const Trace::Recording recording(trace);
  const T x = T::input("x");
  EXPECT_EQ(trace[(x / 4).node()].kind, Trace::Kind::multiply);
  EXPECT_EQ(trace[(x / 3).node()].kind, Trace::Kind::divide);
}

TEST(Traced, IsReplayedInAnotherNumber) {
  Trace trace;
  {
    const Trace::Recording recording(trace);
    const T x = T::input("x"), y = T::input("y");
    const auto far = y < x && !(x < T(0));
    select<T>(far || x < T(-5), sqrt(x) * exp(y) - log(x) / y, max<T>(x, min<T>(y, T(2))));
  }
  const auto at = [&](double x, double y) { return replay<double>(trace, {x, y}).back(); };
  EXPECT_EQ(at(3, 2), std::sqrt(3.0) * std::exp(2.0) - std::log(3.0) / 2);
  EXPECT_EQ(at(-1, 7), 2.0);
  EXPECT_TRUE(std::isnan(at(-6, 7)));
  using D = Dual<double, 1>;
  const auto slope = replay<D>(trace, {D::variable(3, 0), D(2.0)}).back().d[0];
  EXPECT_NEAR(slope, std::exp(2.0) / (2 * std::sqrt(3.0)) - 1.0 / 6, 1e-15);
}

}  // namespace
}  // namespace gonio
