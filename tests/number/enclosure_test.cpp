#include "number/enclosure.h"

#include <bit>
#include <random>
#include <string>
#include <vector>

#include "any_machine.h"
#include "many_fits.h"
#include "number/quotient.h"
#include "number/special.h"

namespace gonio {
namespace {

static_assert(Real<Enclosure<Half>> && Real<Enclosure<float>> && Real<Enclosure<double>>);
static_assert(Real<test::AnyMachine<float>>);
// The same sums of error terms are taken as in the number that is enclosed.
static_assert(std::same_as<base_t<Enclosure<Half>>, Half> &&
              std::same_as<base_t<Enclosure<float>>, float>);

using test::AnyMachine;
using test::stepped;

template <class F>
double in_double(F x) {
  return static_cast<double>(x);
}

const std::vector<std::pair<std::string, Rounding>>& rules() {
  static const std::vector<std::pair<std::string, Rounding>> all{
      {"IEEE 754", {}},
      {"flushed", {.flushed = true}},
      {"contracted", {.contracted = true}},
      {"flushed and contracted", {.contracted = true, .flushed = true}},
      {"any GPU", Rounding::vulkan()},
      {"any GPU, infinities kept", {.flushed = true, .any_gpu = true}},
      {"any GPU, contracted",
       {.contracted = true, .flushed = true, .any_gpu = true, .infinities = false}}};
  return all;
}

/// Values at which arithmetic changes its ways, and some between.
template <class F>
F drawn(std::mt19937_64& random) {
  using L = std::numeric_limits<F>;
  const double least = in_double(L::min()), step = std::ldexp(least, 1 - L::digits);
  const double edges[] = {0,
                          step,
                          least,
                          least - step,
                          1,
                          1 - std::ldexp(1.0, -L::digits),
                          2,
                          3,
                          0.5,
                          1e-3,
                          in_double(L::max()),
                          std::sqrt(in_double(L::max())),
                          std::sqrt(least),
                          1.5,
                          0.1};
  double size = edges[random() % std::size(edges)];
  if (random() % 3 == 0)
    size = std::ldexp(1 + std::ldexp(static_cast<double>(random() >> 12), -52),
                      static_cast<int>(random() % 40) - 20);
  F x = static_cast<F>(random() % 4 ? size : -size);
  x = stepped(x, static_cast<int>(random() % 5) - 2);
  return std::isinf(in_double(x)) && random() % 8 ? F(1.0F) : x;
}

/// An interval and values in it, its ends among them.
template <class F>
struct Box {
  F low, high;

  explicit Box(std::mt19937_64& random) : low(drawn<F>(random)), high(drawn<F>(random)) {
    if (random() % 3 == 0) high = stepped(low, static_cast<int>(random() % 4));
    if (in_double(high) < in_double(low)) std::swap(low, high);
  }
  F inside(std::mt19937_64& random) const {
    const double a = in_double(low), b = in_double(high);
    double x = 0;
    switch (random() % 6) {
      case 0:
        return low;
      case 1:
        return high;
      case 2:
        x = in_double(stepped(low, 1 + static_cast<int>(random() % 3)));
        break;
      case 3:
        x = in_double(stepped(high, -1 - static_cast<int>(random() % 3)));
        break;
      case 4:
        x = std::isinf(a) || std::isinf(b) ? in_double(drawn<F>(random)) : a / 2 + b / 2;
        break;
      default:
        x = in_double(drawn<F>(random));
    }
    x = std::clamp(x, a, b);
    if (x == 0) x = a == 0 ? a : b == 0 ? b : x;  // of a zero that is an end the sign is given, too
    return static_cast<F>(x);
  }
};

/// Everything that a formula may ask of its number, two inputs, and uses of one value more than once.
template <class T>
std::vector<T> operations(const T& a, const T& b, const T& c) {
  const auto positive = T(0) < a;
  const auto order = a < b;
  const T product = a * b, guarded = select<T>(positive, a, T(1));
  return {a + b,
          a - b,
          product,
          a / b,
          -a,
          1 - a,
          a * 2,
          3 / b,
          square(a),
          a - a,
          a + a,
          sqrt(a),
          exp(a),
          log(a),
          sqrt(guarded),
          1 / guarded,
          log(select<T>(!order && T(0) < b, b, T(2))),
          select<T>(order, a, b),
          select<T>(order || positive, a, b),
          select<T>(!(b < a), b - a, c),
          max<T>(a, b),
          min<T>(a, b),
          max<T>(a, -a),
          product + c,
          c - product,
          product - product,
          a * b + b * c,
          square(a) + c,
          1 - a * a,
          max<T>(product, c) + a,
          1 / square(a),
          1 / product,
          1 / (a / b),
          1 / max<T>(a, b),
          1 / (a + b),
          select<T>(order, c, a),
          select<T>(a < sqrt(b), c, a),
          select<T>(sqrt(a) < b, b, c),
          min<T>(c / square(a - b), T(2048)),
          -(a * b) + c,
          square(a * b + c)};
}

template <class F>
void attack() {
  const std::size_t boxes = test::few(2500, 150);
  const int points = 24;
  std::mt19937_64 random(20);
  for (const auto& [name, rule] : rules()) {
    const RoundingScope scope(rule);
    for (std::size_t k = 0; k < boxes; ++k) {
      const Box<F> box[3] = {Box<F>(random), Box<F>(random), Box<F>(random)};
      const auto in = [&](int i) { return Enclosure<F>::between(box[i].low, box[i].high); };
      const auto all = operations(in(0), in(1), in(2));
      for (int p = 0; p < points; ++p) {
        F x[3];
        for (int i = 0; i < 3; ++i) x[i] = box[i].inside(random);
        const auto values =
            operations(AnyMachine<F>(x[0]), AnyMachine<F>(x[1]), AnyMachine<F>(x[2]));
        for (std::size_t i = 0; i < all.size(); ++i)
          ASSERT_TRUE(all[i].holds(values[i].in_double()))
              << std::hexfloat << name << ", operation " << i << " of " << in_double(x[0]) << " "
              << in_double(x[1]) << " " << in_double(x[2]) << " in [" << in(0).low() << ", "
              << in(0).high() << "] [" << in(1).low() << ", " << in(1).high() << "] ["
              << in(2).low() << ", " << in(2).high() << "]: " << values[i].in_double()
              << " is not in [" << all[i].low() << ", " << all[i].high() << "], NaN "
              << all[i].may_be_nan();
      }
    }
  }
}

TEST(Enclosure, HoldsWhatAnyMachineOfItsRuleComputesInHalf) {
  attack<Half>();
}
TEST(Enclosure, HoldsWhatAnyMachineOfItsRuleComputesInFloat) {
  attack<float>();
}
TEST(Enclosure, HoldsWhatAnyMachineOfItsRuleComputesInDouble) {
  attack<double>();
}

/// Operations that rise or fall with an input do so value by value, rounding included.
template <class F>
void climb() {
  const std::size_t boxes = test::few(4000, 300);
  const int pairs = 24;
  std::mt19937_64 random(21);
  std::size_t directed = 0;
  for (std::size_t k = 0; k < boxes; ++k) {
    const Box<F> box[3] = {Box<F>(random), Box<F>(random), Box<F>(random)};
    const auto in = [&](std::size_t i) { return Enclosure<F>::input(box[i].low, box[i].high, i); };
    const auto all = operations(in(0), in(1), in(2));
    for (int p = 0; p < pairs; ++p) {
      F x[3];
      for (int i = 0; i < 3; ++i) x[i] = box[i].inside(random);
      const auto moved = static_cast<std::size_t>(p % 3);
      const auto evaluate = [&] {
        return operations(AnyMachine<F>(x[0]), AnyMachine<F>(x[1]), AnyMachine<F>(x[2]));
      };
      const auto before = evaluate();
      const double from = in_double(x[moved]);
      x[moved] = box[moved].inside(random);
      const double sign = in_double(x[moved]) < from ? -1 : 1;
      const auto after = evaluate();
      for (std::size_t i = 0; i < all.size(); ++i) {
        if (all[i].may_be_nan()) continue;
        const double change = sign * (after[i].in_double() - before[i].in_double());
        const auto& by = all[i].directions();
        directed += by.rises(moved) != by.falls(moved);
        ASSERT_FALSE(by.rises(moved) && change < 0) << "operation " << i << ", input " << moved;
        ASSERT_FALSE(by.falls(moved) && change > 0) << "operation " << i << ", input " << moved;
      }
    }
  }
  EXPECT_GT(directed, boxes * pairs);
}

TEST(Enclosure, KnowsByWhichInputsAValueRisesAndFalls) {
  climb<Half>();
  climb<float>();
}

using E = Enclosure<float>;

TEST(Enclosure, OfADifferenceFromItselfIsZero) {
  const auto x = E::between(-3, 5), copy = x, other = E::between(-3, 5);
  EXPECT_EQ((x - copy).high(), 0);
  EXPECT_EQ((x - copy).low(), 0);
  EXPECT_EQ((x - other).high(), 8);
  EXPECT_TRUE((E::between(1, std::numeric_limits<float>::infinity()) - 1).holds(0));
  const auto endless = E::between(1, std::numeric_limits<float>::infinity());
  EXPECT_TRUE((endless - endless).may_be_nan());
}

TEST(Enclosure, OfASquareIsNotBelowZeroHoweverItIsWritten) {
  const auto x = E::between(-3, 2);
  for (const auto& s : {square(x), x * x, x * E(x), -x * -x}) {
    EXPECT_EQ(s.low(), 0);
    EXPECT_EQ(s.high(), 9);
  }
  EXPECT_EQ((x * -x).low(), -9);
  EXPECT_EQ((x * E::between(-3, 2)).low(), -6);
  EXPECT_EQ((1 / square(x)).low(), static_cast<double>(1 / 9.0F));  // no minus infinity of a zero
  EXPECT_FALSE((1 / square(x)).may_be_nan());
}

TEST(Enclosure, OfAGuardedDivisionIsFinite) {
  const auto x = E::between(-3, 2);
  const auto guarded = [&](const auto& mask, const E& otherwise) {
    return 1 / select<E>(mask, x, otherwise);
  };
  const E least = gonio::least<E>();
  EXPECT_TRUE(guarded(least < x, least).is_finite());
  EXPECT_TRUE(guarded(!(x < least), least).is_finite());
  EXPECT_TRUE(guarded(least < x && x < E(1), least).is_finite());
  EXPECT_FALSE(guarded(x < least, least).is_finite());
  EXPECT_FALSE(guarded(least < x || x < E(1), least).is_finite());
  // The guard of a result comes too late.
  EXPECT_FALSE((select<E>(least < x, 1 / x, least)).is_finite());
}

TEST(Enclosure, RemembersWhatMayBeNoNumber) {
  const auto zero = E::between(0, 1),
             endless = E::between(1, std::numeric_limits<float>::infinity());
  EXPECT_TRUE((zero * endless).may_be_nan());
  EXPECT_TRUE((endless - endless).may_be_nan());
  EXPECT_TRUE((zero / zero).may_be_nan());
  EXPECT_TRUE((endless / endless).may_be_nan());
  EXPECT_TRUE(sqrt(E::between(-1, 1)).may_be_nan());
  EXPECT_TRUE(log(E::between(-1, 1)).may_be_nan());
  EXPECT_TRUE((sqrt(E::between(-1, 1)) + 1).may_be_nan());
  EXPECT_FALSE((zero * 3 + endless).may_be_nan());
  const auto root = sqrt(E::between(-1, 1));
  const auto less = root < E(2);
  EXPECT_TRUE(less.can_hold() && less.can_fail());
  EXPECT_FALSE((select<E>(less, root, E(0))).may_be_nan()) << "what compares as less is a number";
}

TEST(Enclosure, BeyondTheLargestValueIsInfinite) {
  const auto product = Enclosure<Half>::between(Half(1), Half(256)) * 256;
  EXPECT_EQ(product.high(), std::numeric_limits<double>::infinity());
  EXPECT_FALSE(product.is_finite());
  EXPECT_EQ((Enclosure<Half>::between(Half(1), Half(255)) * 256).high(), 65280);
}

TEST(Enclosure, OfAnyGpuGivesNeighboursWhereThatIsAllowedAndTheValueItselfWhereItIsExact) {
  const RoundingScope scope(Rounding::vulkan());
  EXPECT_EQ((E(1) - E(0.25F)).low(), 0.75);
  EXPECT_EQ((E(1) - E(0.25F)).high(), 0.75);
  const E sum = E(1) + E(0x1p-30F), quotient = E(3) / E(3), root = sqrt(E(1)), power = exp(E(2));
  EXPECT_EQ(sum.low(), 1);
  EXPECT_EQ(sum.high(), 1 + 0x1p-23);
  EXPECT_NEAR(quotient.high(), 1 + 3 * 0x1p-23, 0x1p-24);
  EXPECT_NEAR(root.high(), 1 + 5 * 0x1p-23, 0x1p-24);
  EXPECT_NEAR(power.high() / std::exp(2.0), 1 + 7 * 0x1p-23, 0x1.2p-23);
  EXPECT_TRUE((E(1) / E(0x1p127F)).may_be_nan()) << "no bound for such divisors";
  EXPECT_TRUE((E(3e38F) * 2).may_be_nan()) << "infinities need not be preserved";
  EXPECT_EQ(E(1e-39F).low(), static_cast<double>(1e-39F));
  EXPECT_EQ((E(1e-39F) * 1).low(), 0) << "subnormals may be flushed";
}

TEST(Enclosure, OfADivisionByOneErrsAsAnyOtherWhileWhatIsNoFractionIsNotDivided) {
  {
    const RoundingScope scope(Rounding::vulkan());
    const E by_1 = E(3) / E(1), by_2 = E(3) / E(2);
    EXPECT_EQ(by_1.high(), 2 * by_2.high());
    EXPECT_EQ(by_1.low(), 2 * by_2.low());
    EXPECT_LT(by_1.low(), 3);
    EXPECT_EQ(as_quotient<E>(E(3)).value().high(), 3);
  }
  const RoundingScope scope(Rounding{.flushed = true});
  EXPECT_EQ((E::between(1e-39F, 1e-38F) / E(1)).low(), 0) << "a subnormal is flushed as it is read";
}

TEST(Enclosure, ForgetsTheWaysOfAFormulaThatThrows) {
  const E x = E::between(0, 2);
  const auto throws = [&]() -> E {
    const auto less = x < E(1);
    throw less.can_hold();
  };
  EXPECT_THROW(E::over_all_ways(throws), bool);
  EXPECT_EQ(enclosure_paths, nullptr);
  const auto less = x < E(1);
  EXPECT_TRUE(less.can_hold() && less.can_fail());
}

TEST(Directions, AreKnownOfTheFirstInputsAndOfOthersEither) {
  for (const std::size_t input : {0, 31, 32, 40, 63, 64, 70, 1000}) {
    const auto by = Directions::rising(input);
    for (std::size_t other = 0; other < 100; ++other) {
      const bool numbered = other < Directions::most;
      EXPECT_EQ(by.rises(other), numbered) << input << " " << other;
      EXPECT_EQ(by.falls(other), numbered && other != input) << input << " " << other;
    }
  }
}

TEST(Enclosure, ServesAsBaseOfFunctionsThatAreMadeOfIts) {
  for (int k = 0; k < 400; ++k) {
    const auto x = static_cast<float>(k) / 64;
    const auto all = ierfc<E>(E::between(x, x + 1.0F / 64));
    for (const float at : {x, x + 1.0F / 128, x + 1.0F / 64})
      EXPECT_TRUE(all.holds(static_cast<double>(ierfc<float>(at)))) << at;
  }
  EXPECT_EQ(small<E>().low(), static_cast<double>(small<float>()));
  EXPECT_EQ(constant<Enclosure<Half>>(0.1L).high(), static_cast<double>(Half(0.1)));
  EXPECT_EQ(pi<Enclosure<double>>().low(), pi<double>());
}

}  // namespace
}  // namespace gonio
