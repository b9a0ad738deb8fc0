#include "brdf/function/functions.h"

#include <random>
#include <vector>

#include "brdf/catalogue/registry.h"
#include "brdf/in_number/number.h"
#include "number/enclosure.h"

namespace gonio {
namespace {

/// Boxes of legal parameters and of angles, of which some are points; each term's value at points in them.
template <class F>
void compare(Number number) {
  using E = Enclosure<F>;
  using Row = FrameAngles<double>;
  std::mt19937_64 random(31);
  const auto share = [&] { return std::ldexp(static_cast<double>(random() >> 11), -53); };
  std::size_t finite = 0;
  for (std::size_t term = 0; term < catalogue().size(); ++term) {
    const auto& entry = catalogue()[term];
    const auto f = term_function<E>(term);
    for (int box = 0; box < 30; ++box) {
      const double width = box % 3 == 0 ? 0 : std::ldexp(1.0, -static_cast<int>(random() % 12));
      const auto side = [&](double low, double high) {
        const double a = low + (high - low) * share(), b = a + (high - a) * width * share();
        return std::pair{static_cast<F>(a), static_cast<F>(b)};
      };
      std::vector<std::pair<F, F>> sides;
      std::vector<E> p;
      const auto add = [&](double low, double high) {
        sides.push_back(side(low, high));
        return E::between(sides.back().first, sides.back().second);
      };
      for (const auto& q : entry.parameters) p.push_back(add(q.fit.low, q.fit.high));
      std::vector<E> a;
      for (int k = 0; k < 5; ++k) a.push_back(add(0.01, 1));
      for (int k = 0; k < 6; ++k) a.push_back(add(-1, 1));
      const auto value =
          f(p, {{a[0], a[1], a[2], a[3], a[4]}, a[5], a[6], a[7], a[8], a[9], a[10]}).value();
      finite += value.is_finite();
      for (int point = 0; point < 20; ++point) {
        std::vector<double> x;
        for (const auto& [low, high] : sides) {
          const auto l = static_cast<double>(low), h = static_cast<double>(high);
          x.push_back(std::clamp(static_cast<double>(static_cast<F>(l + (h - l) * share())), l, h));
        }
        const auto* at = x.data() + entry.parameters.size();
        const Row row{
            {at[0], at[1], at[2], at[3], at[4]}, at[5], at[6], at[7], at[8], at[9], at[10]};
        const double y =
            values_in(number, term, std::span(x).first(entry.parameters.size()), {&row, 1})[0];
        ASSERT_TRUE(value.holds(y)) << entry.id() << ": " << y << " is not in [" << value.low()
                                    << ", " << value.high() << "]";
      }
    }
  }
  EXPECT_GT(finite, catalogue().size() * 15) << "most boxes are bounded";
}

TEST(TermFunctions, OfEnclosuresHoldEveryTermsValueInHalf) {
  compare<Half>(Number::half);
}
TEST(TermFunctions, OfEnclosuresHoldEveryTermsValueInFloat) {
  compare<float>(Number::float_);
}
TEST(TermFunctions, OfEnclosuresHoldEveryTermsValueInDouble) {
  compare<double>(Number::double_);
}

}  // namespace
}  // namespace gonio
