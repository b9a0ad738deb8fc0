#include "number/batch.h"

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <random>

namespace gonio {
namespace {

template <class F>
class BatchOf : public testing::Test {
 protected:
  using B = Batch<F>;
  static constexpr std::size_t n = lanes<B>;
  using Lanes = std::array<F, n>;
  using Bits = std::conditional_t<sizeof(F) == 8, std::uint64_t, std::uint32_t>;

  Lanes draw() {
    Lanes x;
    for (auto& v : x) v = std::exp(std::uniform_real_distribution<F>(-8, 8)(random_));
    return x;
  }
  static B in(const Lanes& x) {
    alignas(64) Lanes aligned = x;
    return load<B>(aligned.data());
  }
  static Lanes out(const B& x) {
    alignas(64) Lanes aligned;
    store<B>(aligned.data(), x);
    return aligned;
  }
  void same_bits(auto formula, const char* name) {
    for (int trial = 0; trial < 200; ++trial) {
      const Lanes a = draw(), b = draw(), c = out(formula(in(a), in(b)));
      for (std::size_t i = 0; i < n; ++i)
        EXPECT_EQ(std::bit_cast<Bits>(c[i]), std::bit_cast<Bits>(F(formula(a[i], b[i])))) << name;
    }
  }

 private:
  std::mt19937_64 random_{2};
};
using Floats = testing::Types<float, double>;
TYPED_TEST_SUITE(BatchOf, Floats);

TYPED_TEST(BatchOf, MoreThanOneLane) {
  EXPECT_GT(this->n, 1U);
}

TYPED_TEST(BatchOf, ArithmeticEqualsTheScalarBitForBit) {
  this->same_bits([](const auto& a, const auto& b) { return a + b; }, "a + b");
  this->same_bits([](const auto& a, const auto& b) { return a - b; }, "a - b");
  this->same_bits([](const auto& a, const auto& b) { return a * b; }, "a * b");
  this->same_bits([](const auto& a, const auto& b) { return a / b; }, "a / b");
  this->same_bits([](const auto& a, const auto&) { return -a; }, "-a");
  this->same_bits([](const auto& a, const auto&) { return sqrt(a); }, "sqrt(a)");
  this->same_bits([](const auto& a, const auto& b) { return 1 - a * b / 2 + 3 * a; }, "with int");
  this->same_bits([]<class T>(const T& a, const T& b) { return max<T>(a, b) - min<T>(b, a); },
                  "max");
  this->same_bits([]<class T>(const T& a, const T& b) { return select<T>(a < b, a + b, a - b); },
                  "select");
}

TYPED_TEST(BatchOf, MaxAndMinTakeTheirFirstWhereNeitherIsLessAsTheScalarDoes) {
  using F = TypeParam;
  const auto bits = [](F x) { return std::bit_cast<typename TestFixture::Bits>(x); };
  const auto lanes_of = [](F x) { return typename TestFixture::B(x); };
  const F nan = std::numeric_limits<F>::quiet_NaN(), inf = std::numeric_limits<F>::infinity();
  for (const F a : {F(0), F(-0.0), F(1), -inf, inf, nan, -nan})
    for (const F b : {F(0), F(-0.0), F(1), -inf, inf, nan, -nan}) {
      const F high = this->out(max<typename TestFixture::B>(lanes_of(a), lanes_of(b)))[0];
      const F low = this->out(min<typename TestFixture::B>(lanes_of(a), lanes_of(b)))[0];
      EXPECT_EQ(bits(high), bits(max<F>(a, b))) << a << ", " << b;
      EXPECT_EQ(bits(low), bits(min<F>(a, b))) << a << ", " << b;
      EXPECT_EQ(bits(high), bits(a < b ? b : a));
      EXPECT_EQ(bits(low), bits(b < a ? b : a));
    }
}

TYPED_TEST(BatchOf, ExpAndLogAreWithinThreeEpsOfTheScalar) {
  using F = TypeParam;
  for (int trial = 0; trial < 500; ++trial) {
    const auto a = this->draw();
    const auto l = this->out(log(this->in(a)));
    const Batch<F> exponent = -log(this->in(a));
    const auto e = this->out(exp(exponent)), at = this->out(exponent);
    for (std::size_t i = 0; i < this->n; ++i) {
      constexpr F bound = 3 * std::numeric_limits<F>::epsilon();
      EXPECT_NEAR(l[i], std::log(a[i]), bound * std::abs(std::log(a[i])));
      EXPECT_NEAR(e[i], std::exp(at[i]), bound * std::exp(at[i]));
    }
  }
}

TYPED_TEST(BatchOf, ScalarIsABatchOfOne) {
  using F = TypeParam;
  EXPECT_EQ(lanes<F>, 1U);
  F x = 3;
  EXPECT_EQ(load<F>(&x), 3);
  store<F>(&x, F(4));
  EXPECT_EQ(x, 4);
}

}  // namespace
}  // namespace gonio
