#include "number/half_lanes.h"

#include <bit>
#include <cstdint>
#include <random>
#include <vector>

#include "number/special.h"

namespace gonio {
namespace {

static_assert(Real<HalfLanes<>> && std::same_as<base_t<HalfLanes<>>, Half>);
static_assert(sizeof(HalfLanes<>) == sizeof(Batch<float>));

constexpr std::size_t width = Batch<float>::size;

template <HalfRules rules>
std::array<float, width> floats(const HalfLanes<rules>& x) {
  alignas(64) std::array<float, width> a;
  x.as_floats().store_aligned(a.data());
  return a;
}

/// Expects each lane of f over lanes to equal f over single halves, bit for bit; NaN is NaN.
template <HalfRules rules, std::size_t n>
void expect_same(const std::array<std::array<float, width>, n>& in, auto&& f, const char* name) {
  using Lanes = HalfLanes<rules>;
  using One = typename Lanes::One;
  const auto over = [&]<class T>(auto&& at) {
    return [&]<std::size_t... K>(std::index_sequence<K...>) {
      return f(T(at(K))...);
    }
    (std::make_index_sequence<n>{});
  };
  alignas(64) std::array<std::array<float, width>, n> aligned = in;
  const auto lanes = floats(over.template operator()<Lanes>(
      [&](auto k) { return Batch<float>::load_unaligned(aligned[k].data()); }));
  for (std::size_t i = 0; i < width; ++i) {
    const auto one =
        static_cast<float>(over.template operator()<One>([&](auto k) { return in[k][i]; }));
    if (std::isnan(one) && std::isnan(lanes[i])) continue;
    if (std::bit_cast<std::uint32_t>(lanes[i]) == std::bit_cast<std::uint32_t>(one)) continue;
    std::string at;
    for (const auto& column : in) at += " " + std::to_string(column[i]);
    FAIL() << name << at << ": " << lanes[i] << ", expected " << one;
  }
}

template <HalfRules rules>
void expect_operations_same(const std::array<float, width>& a,
                            const std::array<float, width>& b,
                            const std::array<float, width>& c) {
  const std::array pair{a, b};
  const std::array three{a, b, c};
  expect_same<rules>(
      pair, [](auto x, auto y) { return x + y; }, "+");
  expect_same<rules>(
      pair, [](auto x, auto y) { return x - y; }, "-");
  expect_same<rules>(
      pair, [](auto x, auto y) { return x * y; }, "*");
  expect_same<rules>(
      pair, [](auto x, auto y) { return x / y; }, "/");
  expect_same<rules>(
      pair, [](auto x, auto y) { return select<decltype(x)>(x < y, -x, y); }, "select");
  expect_same<rules>(
      pair, []<class T>(T x, T y) { return max<T>(x, 1 - y) * min<T>(2 / x, y); }, "max");
  expect_same<rules>(
      three, [](auto x, auto y, auto z) { return x * y + z; }, "a b + c");
  expect_same<rules>(
      three, [](auto x, auto y, auto z) { return z - x * y; }, "c - a b");
  expect_same<rules>(
      three, [](auto x, auto y, auto z) { return x * y - z * x; }, "a b - c a");
}

template <HalfRules rules>
void expect_functions_same(const std::array<float, width>& a) {
  const std::array<std::array<float, width>, 1> one{a};
  expect_same<rules>(
      one, [](auto x) { return sqrt(x); }, "sqrt");
  expect_same<rules>(
      one, [](auto x) { return exp(x); }, "exp");
  expect_same<rules>(
      one, [](auto x) { return log(x); }, "log");
  expect_same<rules>(
      one, []<class T>(T x) { return expm1_over<T>(x) * constant<T>(0.3L); }, "E");
}

/// f of every rules that there are.
void in_every_mode(auto&& f) {
  f.template operator()<HalfRules{}>();
  f.template operator()<HalfRules{true, false}>();
  f.template operator()<HalfRules{false, true}>();
  f.template operator()<HalfRules{true, true}>();
}

float half(unsigned bits) {
  const int exponent = static_cast<int>(bits >> 10 & 31), fraction = static_cast<int>(bits & 1023);
  const float size = exponent == 31 ? (fraction ? NAN : INFINITY)
                     : exponent == 0
                         ? std::ldexp(static_cast<float>(fraction), -24)
                         : std::ldexp(static_cast<float>(1024 + fraction), exponent - 25);
  return bits >> 15 ? -size : size;
}

/// Both signs of every power of two, of its neighbours, and of some between; what is largest, infinite, no number.
std::vector<float> broad() {
  std::vector<float> all;
  for (unsigned exponent = 0; exponent < 32; ++exponent)
    for (const unsigned fraction : {0U, 1U, 2U, 341U, 511U, 512U, 682U, 1022U, 1023U})
      for (const unsigned sign : {0U, 0x8000U})
        all.push_back(half(sign | exponent << 10 | fraction));
  return all;
}

TEST(HalfLanes, EqualTheSingleHalfOverAllPairsOfABroadSet) {
  const auto values = broad();
  in_every_mode([&]<HalfRules rules>() {
    std::array<float, width> a, b, c;
    std::size_t lane = 0, third = 0;
    for (const float x : values)
      for (const float y : values) {
        a[lane] = x, b[lane] = y, c[lane] = values[third++ % values.size()];
        if (++lane < width) continue;
        lane = 0;
        expect_operations_same<rules>(a, b, c);
        if (testing::Test::HasFatalFailure()) return;
      }
  });
}

TEST(HalfLanes, EqualTheSingleHalfAtAHundredThousandRandomInputs) {
  in_every_mode([&]<HalfRules rules>() {
    std::mt19937 random(1);
    std::array<std::array<float, width>, 3> in;
    for (std::size_t i = 0; i < 100'000 / width; ++i) {
      for (auto& column : in)
        for (float& x : column) x = half(random() & 0xffff);
      // the third beside the product of the others, where what is lost decides
      for (std::size_t k = 0; k < width; k += 2)
        in[2][k] = -static_cast<float>(Half(in[0][k] * in[1][k]));
      expect_operations_same<rules>(in[0], in[1], in[2]);
      if (testing::Test::HasFatalFailure()) return;
    }
  });
}

TEST(HalfLanes, HaveTheRootExpAndLogOfTheSingleHalfAtEveryHalf) {
  in_every_mode([&]<HalfRules rules>() {
    for (unsigned bits = 0; bits < 0x10000; bits += width) {
      std::array<float, width> a;
      for (unsigned k = 0; k < width; ++k) a[k] = half(bits + k);
      expect_functions_same<rules>(a);
      if (testing::Test::HasFatalFailure()) return;
    }
  });
}

TEST(HalfLanes, RoundFloatsThatEnterThem) {
  for (const float x : {1 + 0x1p-11F, 1 + 0x1.01p-11F, 65519.99F, 65520.0F, 0x1p-25F, 0x1.01p-25F})
    for (const float y : {x, -x}) {
      EXPECT_EQ(floats(HalfLanes<>(Batch<float>(y)))[0], static_cast<float>(Half(y))) << y;
      EXPECT_EQ(floats(HalfLanes<>(y))[0], static_cast<float>(Half(y))) << y;
    }
  EXPECT_EQ(floats(pi<HalfLanes<>>())[width - 1], 3.140625F);
}

}  // namespace
}  // namespace gonio
