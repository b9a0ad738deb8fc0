// Straight-line code: what is folded and what is not.
#include "foreign/program.h"

#include <cmath>
#include <limits>

#include "foreign/interpret.h"
#include "number/wide.h"

#include <gtest/gtest.h>

namespace gonio::foreign {
namespace {

TEST(Program, EqualNodesAreOneAndNothingIsRegrouped) {
  Program p;
  const Ref x = p.input(true, 0), y = p.input(false, 0);
  EXPECT_EQ(p(Op::add, x, y), p(Op::add, x, y));
  EXPECT_NE(p(Op::add, x, y), p(Op::add, y, x));
  EXPECT_EQ(p(Op::mul, x, p.constant(1)), x);
  EXPECT_NE(p(Op::mul, x, p.constant(0)), p.constant(0));  // it may be no number
  EXPECT_NE(p(Op::add, x, p.constant(0)), x);              // −0 + 0 is 0
  EXPECT_EQ(p(Op::add, p.frame_zero(), x), x);
  EXPECT_EQ(p(Op::mul, x, p.frame_zero()), p.frame_zero());
}

TEST(Program, MasksMeetAgain) {
  Program p;
  const Ref a = p(Op::less, p.input(true, 0), p.input(true, 1)),
            b = p(Op::less, p.input(true, 1), p.input(true, 2));
  const Ref not_b = p(Op::inverse, b);
  EXPECT_EQ(p(Op::either, p(Op::both, a, b), p(Op::both, a, not_b)), a);
  EXPECT_TRUE(p.is(p(Op::either, b, not_b), 1));
  EXPECT_TRUE(p.is(p(Op::both, b, not_b), 0));
  EXPECT_EQ(p(Op::inverse, not_b), b);
}

TEST(Program, AnInputThatIsReadLateKeepsItsValue) {
  Program p;
  const Ref x = p.input(true, 0), square = p(Op::mul, x, x), sum = p(Op::add, x, square);
  p.outputs = {p(Op::mul, sum, p.input(true, 1))};
  Interpreter<double> run(p);
  double value = 0;
  run.run(
      1, [](std::size_t index, std::size_t) { return index == 0 ? 2.0 : 10.0; },
      [&](std::size_t, std::size_t, double v) { value = v; });
  EXPECT_EQ(value, 60);
}

TEST(Functions, OfFiftyDigitsEndWhereTheExponentIsNoNumber) {
  const Wide none = std::numeric_limits<Wide>::quiet_NaN();
  for (const Wide& nan : {none, Wide(-3) * none}) {  // which has a sign, and negated keeps it
    EXPECT_TRUE(isnan(Functions<Wide>::call<Call::exp2>(nan, Wide(0))));
    EXPECT_TRUE(isnan(Functions<Wide>::call<Call::pow>(Wide(2), nan)));
  }
}

TEST(Program, TooManyOperationsAreRefused) {
  Program p;
  p.most_nodes = 100;
  p.line = 7;
  Ref x = p.input(true, 0);
  try {
    for (int k = 0; k < 1000; ++k) x = p(Op::add, x, p.constant(k + 0.5));
    FAIL();
  } catch (const Refused& r) {
    EXPECT_EQ(r.line, 7);
  }
}

TEST(Program, ChannelsInOneShareWhatTheyShare) {
  Program p;
  const Ref root = p(Op::sqrt, p.input(true, 0));
  p.outputs = {p(Op::mul, root, p.input(false, 0))};
  const Program whole =
      merged({&p, &p, &p}, [](std::size_t c, std::size_t k) { return k + 16 * c; });
  EXPECT_EQ(whole.outputs.size(), 3U);
  EXPECT_EQ(whole.nodes.size(), 1U + 1 + 3 + 3);
  Interpreter<double> run(whole);
  std::vector<double> parameters(48);
  parameters[0] = 2, parameters[16] = 3, parameters[32] = 5;
  run.set(parameters);
  std::vector<double> out;
  run.run(
      1, [](std::size_t, std::size_t) { return 4.0; },
      [&](std::size_t, std::size_t, double v) { out.push_back(v); });
  EXPECT_EQ(out, (std::vector<double>{4, 6, 10}));
}

}  // namespace
}  // namespace gonio::foreign
