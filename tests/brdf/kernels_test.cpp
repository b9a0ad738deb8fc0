// The kernels that are no terms: columns with columns, residuals, normal equations.
#include "brdf/kernels.h"

#include <numeric>

#include "brdf/terms.h"

namespace gonio {
namespace {

constexpr std::size_t n = 64;

template <class F>
class ColumnKernels : public testing::Test {
 protected:
  static constexpr F few = 16 * std::numeric_limits<F>::epsilon();
  F draw(F low, F high) { return std::uniform_real_distribution<F>(low, high)(random_); }
  Column<F> random_column(F low = -2, F high = 2) {
    Column<F> c(n);
    for (std::size_t i = 0; i < n; ++i) c[i] = draw(low, high);
    return c;
  }
  std::mt19937_64 random_{41};
};
using Floats = testing::Types<float, double>;
TYPED_TEST_SUITE(ColumnKernels, Floats);

TYPED_TEST(ColumnKernels, MultiplyAndAdd) {
  using F = TypeParam;
  const auto a = this->random_column(), b = this->random_column(), c = this->random_column(),
             d = this->random_column();
  Column<F> out(n);
  for (const auto& set : instruction_sets()) {
    const auto& k = kernels<F>(set);
    k.product(n, a.data(), b.data(), out.data());
    for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(out[i], F(a[i] * b[i])) << set;
    k.product_sum(n, a.data(), b.data(), c.data(), d.data(), out.data());
    for (std::size_t i = 0; i < n; ++i)
      EXPECT_EQ(out[i], F(F(a[i] * b[i]) + F(c[i] * d[i]))) << set;
    k.add_product(n, a.data(), b.data(), c.data(), out.data());
    for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(out[i], F(a[i] + F(b[i] * c[i]))) << set;
  }
}

TYPED_TEST(ColumnKernels, MayWriteOverWhatTheyRead) {
  using F = TypeParam;
  const auto b = this->random_column();
  for (const auto& set : instruction_sets()) {
    auto a = this->random_column();
    const std::vector<F> before(a.data(), a.data() + n);
    kernels<F>(set).product(n, a.data(), b.data(), a.data());
    for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(a[i], F(before[i] * b[i])) << set;
  }
}

// ---- Residuals ----------------------------------------------------------------------------------

/// r(f), its slope, and what Huber makes of it, as one would write it for one sample in double.
struct Sample {
  double r = 0, slope = 0;
};
Sample metric(Metric m, double f, double y, double nol, double offset) {
  switch (m) {
    case Metric::log:
      return {std::log((f + offset) / (y + offset)), 1 / (f + offset)};
    case Metric::l2_cosine:
      return {(f - y) * nol, nol};
    case Metric::relative:
      return {(f - y) / (y + offset), 1 / (y + offset)};
  }
  return {};
}
struct Huber {
  double rho, rho1;  // of r²
};
Huber huber_loss(double r, double h) {
  const double size = std::abs(r);
  return size <= h ? Huber{r * r, 1} : Huber{2 * h * size - h * h, h / size};
}

constexpr Metric metrics[] = {Metric::log, Metric::l2_cosine, Metric::relative};

template <class F>
struct Residuals {
  Column<F> f, y, weight, nol, r, slope, cost;
  F offset = F(0.01), huber = F(0.3);

  void run(const typename Kernels<F>::Residual& kernel) {
    kernel(n, {f.data(), y.data(), weight.data(), nol.data(), offset, huber, r.data(), slope.data(),
               cost.data()});
  }
};

TYPED_TEST(ColumnKernels, ResidualsAreThoseOfOneSampleAtATime) {
  using F = TypeParam;
  for (const auto& set : instruction_sets())
    for (const Metric m : metrics)
      for (const F huber : {F(0.01), F(0.3), std::numeric_limits<F>::infinity()}) {
        Residuals<F> x{this->random_column(0, 3),
                       this->random_column(F(0.01), 3),
                       this->random_column(F(0.1), 2),
                       this->random_column(0, 1),
                       Column<F>(n),
                       Column<F>(n),
                       Column<F>(padding, 0)};
        x.huber = huber;
        x.f[5] = x.y[5];  // met exactly: r = 0
        x.cost[0] = 3;    // the sum goes on from what is there
        const auto& k = kernels<F>(set);
        const auto which = static_cast<std::size_t>(m);
        x.run(k.residual[which]);
        double cost = 3, parts = 0;
        for (std::size_t i = 0; i < n; ++i) {
          const double w = double(x.weight[i]);
          const auto s =
              metric(m, double(x.f[i]), double(x.y[i]), double(x.nol[i]), double(x.offset));
          const auto h = huber_loss(w * s.r, double(huber));
          // r cancels where f is near y; it is measured by what it cancels from
          const double tolerance =
              double(this->few) * (1 + std::abs(s.r) + s.slope * double(x.f[i])) * w;
          EXPECT_NEAR(double(x.r[i]), std::sqrt(h.rho1) * w * s.r, 2 * tolerance)
              << set << " " << i;
          EXPECT_NEAR(double(x.slope[i]), std::sqrt(h.rho1) * w * s.slope,
                      double(this->few) * w * s.slope + std::sqrt(h.rho1) * w * s.slope *
                                                            tolerance /
                                                            std::max(std::abs(w * s.r), 1e-3))
              << set << " " << i;
          cost += h.rho;
          parts += 2 * std::abs(w * s.r) * tolerance + tolerance * tolerance;
        }
        EXPECT_NEAR(double(std::accumulate(x.cost.data(), x.cost.data() + padding, F(0))), cost,
                    parts + double(this->few) * cost)
            << set;
        EXPECT_EQ(x.r[5], 0);

        x.run(k.influence[which]);
        for (std::size_t i = 0; i < n; ++i) {
          const double w = double(x.weight[i]);
          const auto s =
              metric(m, double(x.f[i]), double(x.y[i]), double(x.nol[i]), double(x.offset));
          const auto h = huber_loss(w * s.r, double(huber));
          const double tolerance = 2 * double(this->few) *
                                   (1 + std::abs(s.r) + s.slope * double(x.f[i])) * w * w * s.slope;
          EXPECT_NEAR(double(x.r[i]), h.rho1 * w * s.r * w * s.slope, tolerance) << set << " " << i;
          const bool near_the_edge = std::abs(std::abs(w * s.r) - double(huber)) < 1e-4;
          if (!near_the_edge) {
            const double expected = std::abs(w * s.r) > double(huber) ? 0 : w * s.slope;
            EXPECT_NEAR(double(x.slope[i]), expected, double(this->few) * expected)
                << set << " " << i;
          }
        }
      }
}

TYPED_TEST(ColumnKernels, MaskedSamplesAreZeroWhateverStandsThere) {
  using F = TypeParam;
  const F nan = std::numeric_limits<F>::quiet_NaN(), infinite = std::numeric_limits<F>::infinity();
  struct Case {
    F f, y, weight;
    bool masked;
  };
  const Case cases[] = {{1, -1, 1, true},        {nan, -1, 1, true}, {1, nan, 1, true},
                        {nan, nan, nan, true},   {1, 2, 0, true},    {nan, 2, 0, true},
                        {infinite, 2, 0, true},  {1, 2, -1, true},   {1, 2, nan, true},
                        {1, F(-1e-30), 1, true}, {1, 2, 1, false},   {1, 0, 1, false},
                        {0, 2, 1, false}};
  for (const auto& set : instruction_sets())
    for (const Metric m : metrics)
      for (const auto kind : {0, 1}) {
        const auto& k = kernels<F>(set);
        for (const auto& c : cases) {
          Residuals<F> x{Column<F>(n, c.f),    Column<F>(n, c.y), Column<F>(n, c.weight),
                         Column<F>(n, F(0.5)), Column<F>(n, 9),   Column<F>(n, 9),
                         Column<F>(padding, 0)};
          const auto which = static_cast<std::size_t>(m);
          x.run(kind ? k.influence[which] : k.residual[which]);
          const F cost = std::accumulate(x.cost.data(), x.cost.data() + padding, F(0));
          for (std::size_t i = 0; i < n; ++i) {
            EXPECT_EQ(x.r[i] == 0, c.masked) << set << " " << c.f << " " << c.y << " " << c.weight;
            EXPECT_TRUE(std::isfinite(x.r[i]) && std::isfinite(x.slope[i]));
            if (c.masked) {
              EXPECT_EQ(x.slope[i], 0);
            }
          }
          EXPECT_EQ(cost == 0, c.masked) << set;
          EXPECT_TRUE(std::isfinite(cost));
        }
      }
}

TYPED_TEST(ColumnKernels, LogOfNothingIsTinyAndHasNoSlope) {
  using F = TypeParam;
  for (const auto& set : instruction_sets()) {
    Residuals<F> x{Column<F>(n, 0), Column<F>(n, 1), Column<F>(n, 1),      Column<F>(n, F(0.5)),
                   Column<F>(n),    Column<F>(n, 9), Column<F>(padding, 0)};
    x.offset = 0;
    x.huber = std::numeric_limits<F>::infinity();
    x.run(kernels<F>(set).residual[static_cast<std::size_t>(Metric::log)]);
    for (std::size_t i = 0; i < n; ++i) {
      EXPECT_NEAR(x.r[i], std::log(F(1e-30)), F(1e-4));
      EXPECT_EQ(x.slope[i], 0);
    }
  }
}

TEST(Metrics, HaveTheOrderOfTheirNames) {
  EXPECT_EQ(metric_names[static_cast<std::size_t>(Metric::log)], "log");
  EXPECT_EQ(metric_names[static_cast<std::size_t>(Metric::l2_cosine)], "l2_cosine");
  EXPECT_EQ(metric_names[static_cast<std::size_t>(Metric::relative)], "relative");
}

// ---- Normal equations ---------------------------------------------------------------------------

TYPED_TEST(ColumnKernels, GramIsTheNaiveSumOfProducts) {
  using F = TypeParam;
  for (const auto& set : instruction_sets())
    for (std::size_t columns = 1; columns <= max_columns; ++columns) {
      auto r = this->random_column(), slope = this->random_column();
      std::vector<Column<F>> jacobian;
      std::vector<const F*> j;
      for (std::size_t k = 1; k < columns; ++k) jacobian.push_back(this->random_column());
      for (const std::size_t masked : {std::size_t{3}, std::size_t{17}, n - 1}) {
        r[masked] = slope[masked] = 0;
        for (auto& c : jacobian) c[masked] = std::numeric_limits<F>::quiet_NaN();
      }
      for (const auto& c : jacobian) j.push_back(c.data());
      const std::size_t entries = columns * (columns + 1) / 2;
      Column<F> sums(entries * padding, 0);
      sums[0] = 5;  // goes on from what is there
      kernels<F>(set).gram[columns](n, r.data(), slope.data(), j.data(), sums.data());

      const auto row = [&](std::size_t k, std::size_t i) {
        if (k == 0) return double(r[i]);
        return slope[i] == 0 ? 0 : double(slope[i]) * double(jacobian[k - 1][i]);
      };
      std::size_t e = 0;
      for (std::size_t a = 0; a < columns; ++a)
        for (std::size_t b = a; b < columns; ++b, ++e) {
          double expected = e == 0 ? 5 : 0, size = 5;
          for (std::size_t i = 0; i < n; ++i) {
            expected += row(a, i) * row(b, i);
            size += std::abs(row(a, i) * row(b, i));
          }
          const F* const lanes = sums.data() + e * padding;
          EXPECT_NEAR(double(std::accumulate(lanes, lanes + padding, F(0))), expected,
                      double(this->few) * size)
              << set << " " << columns << ": " << a << ", " << b;
        }
    }
}

}  // namespace
}  // namespace gonio
