#include "number/shaken.h"

#include <array>
#include <cfenv>
#include <set>
#include <vector>

#include "number/batch.h"
#include "number/dual.h"
#include "number/exact.h"

namespace gonio {
namespace {

template <class T>
concept ComesFromDoubleUnasked = std::convertible_to<double, T>;
template <class T>
concept MixesWithDouble = requires(T a) {
  0.5 * a;
};
template <class T>
concept FallsBackToDouble = requires(T a) {
  std::sqrt(a);
};
static_assert(Real<Shaken<double>> && Real<Shaken<float>> && Real<Dual<Shaken<double>, 3>>);
static_assert(std::same_as<base_t<Dual<Shaken<float>, 2>>, float> &&
              std::same_as<plain_t<Dual<Shaken<float>, 2>>, Shaken<float>>);
static_assert(!ComesFromDoubleUnasked<Shaken<double>> && !MixesWithDouble<Shaken<double>> &&
              !FallsBackToDouble<Shaken<double>>);
static_assert(lanes<Shaken<double>> == 1);

/// Seed of the choices until the end of a test.
class Seed {
 public:
  explicit Seed(std::uint64_t seed) { set(seed); }
  Seed(const Seed&) = delete;
  Seed& operator=(const Seed&) = delete;
  ~Seed() { set(0); }
  static void set(std::uint64_t seed) { shaken_seed = seed; }
};

/// An operation that IEEE 754 rounds correctly.
enum class Exact { sum, difference, product, quotient, root };
constexpr std::array all_exact{Exact::sum, Exact::difference, Exact::product, Exact::quotient,
                               Exact::root};

template <class T>
T apply(Exact operation, const T& a, const T& b) {
  switch (operation) {
    case Exact::sum:
      return a + b;
    case Exact::difference:
      return a - b;
    case Exact::product:
      return a * b;
    case Exact::quotient:
      return a / b;
    case Exact::root:
      return sqrt(a);
  }
  return a;
}

/// The processor's result, rounded as FE_DOWNWARD and its like say.
template <class F>
F rounded(int direction, Exact operation, F x, F y) {
  volatile F a = x, b = y;
  const int before = std::fegetround();
  std::fesetround(direction);
  const volatile F result = apply<F>(operation, F(a), F(b));
  std::fesetround(before);
  return result;
}

/// Numbers of all magnitudes, those near which something ends among them, of both signs.
template <class F>
std::vector<F> numbers() {
  using Limits = std::numeric_limits<F>;
  std::vector<F> all{0, Limits::infinity(), Limits::max(), Limits::min(), Limits::denorm_min()};
  all.push_back(std::nextafter(Limits::min(), F(0)));
  all.push_back(std::nextafter(F(1), F(0)));
  for (const F x : {F(1), F(2), F(3), F(0.1), F(1) / 3, F(1e7)}) all.push_back(x);
  constexpr int step = Limits::max_exponent / 24;
  for (int e = Limits::min_exponent - Limits::digits; e < Limits::max_exponent; e += step) {
    const F x = std::ldexp(1 + F(std::abs(e) % 37) / 37, e);
    if (std::isfinite(x)) all.push_back(x);
  }
  for (std::size_t k = all.size(); k-- > 0;) all.push_back(-all[k]);
  all.push_back(Limits::quiet_NaN());
  return all;
}

template <class F>
class ShakenOver : public testing::Test {};
using Bases = testing::Types<float, double>;
TYPED_TEST_SUITE(ShakenOver, Bases);

TYPED_TEST(ShakenOver, RoundsAsTheProcessorDoesUpOrDown) {
  using F = TypeParam;
  const Seed seed(0);
  const auto all = numbers<F>();
  std::size_t both = 0, wrong = 0;
  for (const auto operation : all_exact)
    for (const F a : all)
      for (const F b : all) {
        const F low = rounded(FE_DOWNWARD, operation, a, b),
                high = rounded(FE_UPWARD, operation, a, b);
        bool is_low = false, is_high = false;
        for (std::uint64_t s = 0; s < (low < high ? 40 : 2); ++s) {
          Seed::set(s);
          const F x = apply(operation, Shaken<F>(a), Shaken<F>(b)).value();
          const bool same_low = x == low || (std::isnan(x) && std::isnan(low)),
                     same_high = x == high;
          is_low = is_low || same_low;
          is_high = is_high || same_high;
          if (!same_low && !same_high && ++wrong < 10)
            ADD_FAILURE() << static_cast<int>(operation) << ": " << a << ", " << b << " gave " << x
                          << ", not " << low << " or " << high;
        }
        if (low < high && !(is_low && is_high) && ++wrong < 10)
          ADD_FAILURE() << static_cast<int>(operation) << ": " << a << ", " << b
                        << " was rounded one way alone";
        both += low < high;
      }
  EXPECT_EQ(wrong, 0U);
  EXPECT_GT(both, all.size() * all.size());
}

TYPED_TEST(ShakenOver, RoundsUpHalfTheTime) {
  using F = TypeParam;
  const Seed seed(7);
  for (const auto operation : all_exact) {
    std::size_t inexact = 0, up = 0;
    for (int i = 1; i <= 20000; ++i) {
      const F a = std::sqrt(F(i)), b = F(i) / 7 + 1;
      const F low = rounded(FE_DOWNWARD, operation, a, b),
              high = rounded(FE_UPWARD, operation, a, b);
      inexact += low < high;
      up += low < high && apply(operation, Shaken<F>(a), Shaken<F>(b)).value() == high;
    }
    const auto n = static_cast<double>(inexact);
    EXPECT_GT(inexact, 2000U) << static_cast<int>(operation);
    EXPECT_NEAR(static_cast<double>(up) / n, 0.5, 2 / std::sqrt(n)) << static_cast<int>(operation);
  }
}

TYPED_TEST(ShakenOver, MovesTheLibrarysFunctionsByOneUlpOrNotAtAll) {
  using F = TypeParam;
  const Seed seed(0);
  for (const F x : {F(0.3), F(-1.7), F(11), F(-0x1p-30)}) {
    std::set<F> exps, logs;
    for (std::uint64_t s = 0; s < 60; ++s) {
      Seed::set(s);
      exps.insert(exp(Shaken<F>(x)).value());
      logs.insert(log(Shaken<F>(std::abs(x))).value());
    }
    const auto around = [](F y) {
      return std::set<F>{std::nextafter(y, F(-1e9)), y, std::nextafter(y, F(1e9))};
    };
    auto of_exp = around(std::exp(x));
    if (x < 0) of_exp.erase(of_exp.upper_bound(F(1)), of_exp.end());
    EXPECT_EQ(exps, of_exp) << x;
    EXPECT_EQ(logs, around(std::log(std::abs(x)))) << x;
  }
}

TYPED_TEST(ShakenOver, LeavesTheEndsOfTheLibrarysFunctions) {
  using F = TypeParam;
  using Limits = std::numeric_limits<F>;
  const Seed seed(0);
  for (std::uint64_t s = 0; s < 20; ++s) {
    Seed::set(s);
    const auto exp_of = [](F x) { return exp(Shaken<F>(x)).value(); };
    const auto log_of = [](F x) { return log(Shaken<F>(x)).value(); };
    EXPECT_EQ(exp_of(0), 1);
    EXPECT_EQ(exp_of(-Limits::infinity()), 0);
    EXPECT_EQ(exp_of(Limits::infinity()), Limits::infinity());
    EXPECT_EQ(exp_of(Limits::max()), Limits::infinity());
    EXPECT_GE(exp_of(Limits::lowest()), 0);
    EXPECT_EQ(log_of(1), 0);
    EXPECT_EQ(log_of(0), -Limits::infinity());
    EXPECT_EQ(log_of(Limits::infinity()), Limits::infinity());
    EXPECT_TRUE(std::isnan(log_of(-1)) && std::isnan(exp_of(Limits::quiet_NaN())));
  }
}

TYPED_TEST(ShakenOver, DependsOnTheSeedAndTheOperandsAlone) {
  using F = TypeParam;
  const Seed seed(0);
  const auto run = [](std::uint64_t s) {
    Seed::set(s);
    std::vector<F> results;
    Shaken<F> x(F(0.7));
    for (int i = 0; i < 100; ++i) {
      x = sqrt(x * x / 3 + exp(-x) + 1 / (2 + x));
      results.push_back(x.value());
    }
    return results;
  };
  const auto once = run(1), other = run(2);
  EXPECT_NE(once, other);
  EXPECT_EQ(once, run(1));
}

TYPED_TEST(ShakenOver, AddsAndMultipliesInEitherOrderAlike) {
  using F = TypeParam;
  const Seed seed(3);
  for (int i = 1; i < 200; ++i) {
    const Shaken<F> a(std::sqrt(F(i))), b(F(-1) / F(i + 2));
    EXPECT_EQ((a + b).value(), (b + a).value());
    EXPECT_EQ((a * b).value(), (b * a).value());
  }
}

TYPED_TEST(ShakenOver, LeavesIntegersComparisonsAndChoicesAsTheyAre) {
  using F = TypeParam;
  using S = Shaken<F>;
  const Seed seed(5);
  const S a(F(0.1)), b(F(0.3));
  EXPECT_EQ((S(3) * 7 - 1).value(), 20);
  EXPECT_EQ((-a).value(), F(-0.1));
  EXPECT_TRUE(a < b && a <= b && a <= a && !(b < a) && !(a < a));
  EXPECT_EQ((select<S>(a < b, a, b).value()), F(0.1));
  EXPECT_EQ((max<S>(a, b).value()), F(0.3));
}

/// Rounding errors found in it, to within what the number allows.
TYPED_TEST(ShakenOver, StillFindsTheErrorsOfSumsAndProducts) {
  using F = TypeParam;
  using S = Shaken<F>;
  const Seed seed(0);
  const F eps = std::numeric_limits<F>::epsilon();
  for (std::uint64_t s = 0; s < 8; ++s) {
    Seed::set(s);
    for (int i = 1; i < 500; ++i) {
      const F a = std::sqrt(F(i)), b = F(100) / F(i);
      const S sum = S(a) + S(b), product = S(a) * S(b);
      const auto exact_sum = static_cast<long double>(a) + b - sum.value();
      const F exact_product = std::fma(a, b, -product.value());
      const auto allowed = [&](auto of, F value) {
        return 4 * eps * std::abs(static_cast<F>(of)) + 4 * eps * eps * std::abs(value);
      };
      EXPECT_NEAR(static_cast<double>(sum_error(S(a), S(b), sum).value()),
                  static_cast<double>(exact_sum),
                  static_cast<double>(allowed(exact_sum, sum.value())));
      EXPECT_NEAR(static_cast<double>(product_error(S(a), S(b), product).value()),
                  static_cast<double>(exact_product),
                  static_cast<double>(allowed(exact_product, product.value())));
    }
  }
}

}  // namespace
}  // namespace gonio
