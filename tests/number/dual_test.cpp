// Dual against an independent implementation (ceres::Jet), against differences, and lane by lane.
#include "number/dual.h"

#include <random>
#include <string>

#include "constants.h"
#include "number/batch.h"

#include <ceres/jet.h>

namespace gonio {
namespace {

using D = Dual<double, 2>;
using Jet = ceres::Jet<double, 2>;
using DB = Dual<Batch<double>, 2>;
using test::eps;

/// One function of (a, b), as the sum over the list below sees it.
template <class Check>
void for_each_formula_of_one_type(Check&& check) {
  check("a + b", [](const auto& a, const auto& b) { return a + b; });
  check("a - b", [](const auto& a, const auto& b) { return a - b; });
  check("a * b", [](const auto& a, const auto& b) { return a * b; });
  check("a / b", [](const auto& a, const auto& b) { return a / b; });
  check("-a", [](const auto& a, const auto&) { return -a; });
  check("sqrt(a)", [](const auto& a, const auto&) { return sqrt(a); });
  check("exp(a)", [](const auto& a, const auto&) { return exp(a); });
  check("log(a)", [](const auto& a, const auto&) { return log(a); });
  check("a exp(-b log(a))", [](const auto& a, const auto& b) { return a * exp(-b * log(a)); });
  check("sqrt(a a + b b) / (a + b)",
        [](const auto& a, const auto& b) { return sqrt(a * a + b * b) / (a + b); });
}

/// Mixed with plain numbers, on either side; the base's numbers enter as T's own plain type does.
template <class Check>
void for_each_mixed_formula(Check&& check) {
  check("a + 2", [](const auto& a, const auto&) { return a + 2; });
  check("2 + a", [](const auto& a, const auto&) { return 2 + a; });
  check("a - 2", [](const auto& a, const auto&) { return a - 2; });
  check("2 - a", [](const auto& a, const auto&) { return 2 - a; });
  check("a * 2", [](const auto& a, const auto&) { return a * 2; });
  check("2 * a", [](const auto& a, const auto&) { return 2 * a; });
  check("a / 2", [](const auto& a, const auto&) { return a / 2; });
  check("2 / a", [](const auto& a, const auto&) { return 2 / a; });
  check("a + 0.3", [](const auto& a, const auto&) { return a + 0.3; });
  check("0.3 - a", [](const auto& a, const auto&) { return 0.3 - a; });
  check("a - 0.3", [](const auto& a, const auto&) { return a - 0.3; });
  check("0.3 * a * b", [](const auto& a, const auto& b) { return 0.3 * a * b; });
  check("a / 0.3", [](const auto& a, const auto&) { return a / 0.3; });
  check("0.3 / (a b)", [](const auto& a, const auto& b) { return 0.3 / (a * b); });
}

struct Points {
  std::mt19937_64 random{1};
  double draw() { return std::uniform_real_distribution(0.1, 3.0)(random); }
};

TEST(Dual, EqualsCeresJet) {
  Points points;
  for_each_formula_of_one_type([&](const std::string& name, auto formula) {
    for (int trial = 0; trial < 100; ++trial) {
      const double a = points.draw(), b = points.draw();
      const D d = formula(D::variable(a, 0), D::variable(b, 1));
      const Jet j = formula(Jet(a, 0), Jet(b, 1));
      EXPECT_NEAR(d.v, j.a, 2 * eps * std::abs(j.a)) << name;  // Jet divides by multiplying
      for (std::size_t i = 0; i < 2; ++i) {
        const double expected = j.v[static_cast<Eigen::Index>(i)];
        const double scale = std::abs(j.a) + std::abs(j.v[0]) + std::abs(j.v[1]);
        EXPECT_NEAR(d.d[i], expected, 8 * eps * scale) << name << " at " << a << ", " << b;
      }
    }
  });
}

TEST(Dual, AgreesWithCentralDifferences) {
  Points points;
  const auto check = [&](const std::string& name, auto formula) {
    for (int trial = 0; trial < 100; ++trial) {
      const double a = points.draw(), b = points.draw(), h = 1e-5;
      const D d = formula(D::variable(a, 0), D::variable(b, 1));
      const double da = (formula(a + h, b) - formula(a - h, b)) / (2 * h);
      const double db = (formula(a, b + h) - formula(a, b - h)) / (2 * h);
      EXPECT_NEAR(d.v, formula(a, b), 4 * eps * std::abs(d.v)) << name;
      EXPECT_NEAR(d.d[0], da, 1e-6 * (1 + std::abs(da))) << name << " at " << a << ", " << b;
      EXPECT_NEAR(d.d[1], db, 1e-6 * (1 + std::abs(db))) << name << " at " << a << ", " << b;
    }
  };
  for_each_formula_of_one_type(check);
  for_each_mixed_formula(check);
}

TEST(Dual, OfBatchesEqualsDualOfScalarsLaneByLane) {
  Points points;
  constexpr std::size_t n = lanes<Batch<double>>;
  const auto check = [&](const std::string& name, auto formula) {
    const bool exact = name.find("exp") == name.npos && name.find("log") == name.npos;
    alignas(64) std::array<double, n> a{}, b{};
    for (std::size_t i = 0; i < n; ++i) a[i] = points.draw(), b[i] = points.draw();
    const DB x = DB::variable(load<Batch<double>>(a.data()), 0);
    const DB y = DB::variable(load<Batch<double>>(b.data()), 1);
    const DB d = formula(x, y);
    for (std::size_t i = 0; i < n; ++i) {
      const D one = formula(D::variable(a[i], 0), D::variable(b[i], 1));
      const double tolerance =
          exact ? 0 : 16 * eps * (std::abs(one.v) + std::abs(one.d[0]) + std::abs(one.d[1]));
      EXPECT_NEAR(d.v.get(i), one.v, tolerance) << name;
      EXPECT_NEAR(d.d[0].get(i), one.d[0], tolerance) << name;
      EXPECT_NEAR(d.d[1].get(i), one.d[1], tolerance) << name;
    }
  };
  for_each_formula_of_one_type(check);
  for_each_mixed_formula(check);
}

TEST(Dual, SelectKeepsTheDerivativesOfTheChosenSideAlone) {
  const D good = D::variable(2, 0), bad(std::nan(""));
  D poisoned = bad;
  poisoned.d = {std::nan(""), std::nan("")};
  EXPECT_EQ((select<D>(true, good, poisoned).d), (std::array<double, 2>{1, 0}));
  EXPECT_EQ((select<D>(false, poisoned, good).d), (std::array<double, 2>{1, 0}));
  EXPECT_TRUE(std::isnan(select<D>(false, good, poisoned).d[1]));
}

TEST(Dual, SelectChoosesLaneByLane) {
  constexpr std::size_t n = lanes<Batch<double>>;
  alignas(64) std::array<double, n> a{}, b{};
  for (std::size_t i = 0; i < n; ++i) a[i] = static_cast<double>(i), b[i] = 0.5;
  const DB x = DB::variable(load<Batch<double>>(a.data()), 0);
  const DB y = DB::variable(load<Batch<double>>(b.data()), 1);
  const DB larger = select<DB>(y < x, x, y);
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_EQ(larger.v.get(i), std::max(a[i], b[i]));
    EXPECT_EQ(larger.d[0].get(i), b[i] < a[i] ? 1 : 0);
    EXPECT_EQ(larger.d[1].get(i), b[i] < a[i] ? 0 : 1);
  }
}

TEST(Dual, ComparesItsValueAlone) {
  const D a = D::variable(1, 0), b = D::variable(1, 1);
  EXPECT_FALSE(a < b);
  EXPECT_FALSE(b < a);
  EXPECT_TRUE(a < D(2));
}

}  // namespace
}  // namespace gonio
