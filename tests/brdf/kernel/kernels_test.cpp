// The kernels that are no terms: columns with columns, residuals, normal equations.
#include "brdf/kernel/kernels.h"

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

TYPED_TEST(ColumnKernels, LinkIsTheLogarithmOrTheValueItself) {
  using F = TypeParam;
  const auto f = this->random_column(F(0.01), 300);
  Column<F> value(n), slope(n);
  const F offset(0.25);
  for (const auto& set : instruction_sets()) {
    const auto& link = kernels<F>(set).link;
    link[static_cast<std::size_t>(Link::log)](n, f.data(), offset, value.data(), slope.data());
    for (std::size_t i = 0; i < n; ++i) {
      EXPECT_NEAR(value[i], std::log(double(f[i]) + double(offset)), 6 * this->few) << set;
      EXPECT_NEAR(slope[i], 1 / (double(f[i]) + double(offset)), 4 * this->few) << set;
    }
    link[static_cast<std::size_t>(Link::identity)](n, f.data(), offset, value.data(), slope.data());
    for (std::size_t i = 0; i < n; ++i) {
      EXPECT_EQ(value[i], f[i] + offset) << set;
      EXPECT_EQ(slope[i], 1) << set;
    }
  }
}

TYPED_TEST(ColumnKernels, LogOfNothingIsTinyAndHasNoSlope) {
  using F = TypeParam;
  for (const F nothing : {F(0), F(-1), std::numeric_limits<F>::quiet_NaN()}) {
    const Column<F> f(n, nothing);
    for (const auto& set : instruction_sets()) {
      Column<F> value(n), slope(n, 9);
      kernels<F>(set).link[static_cast<std::size_t>(Link::log)](n, f.data(), 0, value.data(),
                                                                slope.data());
      for (std::size_t i = 0; i < n; ++i) {
        EXPECT_NEAR(value[i], std::log(F(1e-30)), F(1e-4));
        EXPECT_EQ(slope[i], 0);
      }
    }
  }
}

/// Huber's residual, as one would write it in double.
struct Huber {
  double rho, rho1;  // of r²
};
Huber huber_loss(double r, double h) {
  const double size = std::abs(r);
  return size <= h ? Huber{r * r, 1} : Huber{2 * h * size - h * h, h / size};
}

template <class F>
struct Residuals {
  Column<F> value, slope, target, weight;
  Column<F> r{n}, weighted_slope{n}, cost{padding, 0};
  F huber = F(0.3);

  void run(const typename Kernels<F>::Residual& kernel) {
    kernel(n, {value.data(), slope.data(), target.data(), weight.data(), huber, r.data(),
               weighted_slope.data(), cost.data()});
  }
};

TYPED_TEST(ColumnKernels, ResidualsAreThoseOfOneSampleAtATime) {
  using F = TypeParam;
  for (const auto& set : instruction_sets())
    for (const F huber : {F(0.01), F(0.3), std::numeric_limits<F>::max()}) {
      Residuals<F> x{this->random_column(0, 3), this->random_column(F(0.1), 9),
                     this->random_column(F(0.01), 3), this->random_column(F(0.1), 2)};
      x.huber = huber;
      x.value[5] = x.target[5];  // met exactly: r = 0
      x.cost[0] = 3;             // the sum goes on from what is there
      const auto& k = kernels<F>(set);
      x.run(k.residual);
      double cost = 3;
      for (std::size_t i = 0; i < n; ++i) {
        const double w = double(x.weight[i]), r = w * double(x.value[i] - x.target[i]);
        const double slope = w * double(x.slope[i]);
        const auto h = huber_loss(r, double(huber));
        EXPECT_NEAR(double(x.r[i]), std::sqrt(h.rho1) * r, double(this->few) * std::abs(r)) << set;
        EXPECT_NEAR(double(x.weighted_slope[i]), std::sqrt(h.rho1) * slope,
                    double(this->few) * slope)
            << set;
        cost += h.rho;
      }
      EXPECT_NEAR(double(std::accumulate(x.cost.data(), x.cost.data() + padding, F(0))), cost,
                  4 * double(this->few) * cost)
          << set;
      EXPECT_EQ(x.r[5], 0);

      x.run(k.influence);
      for (std::size_t i = 0; i < n; ++i) {
        const double w = double(x.weight[i]), r = w * double(x.value[i] - x.target[i]);
        const double slope = w * double(x.slope[i]);
        const double score = huber_loss(r, double(huber)).rho1 * r * slope;
        EXPECT_NEAR(double(x.r[i]), score, 2 * double(this->few) * std::abs(score)) << set;
        const bool near_the_edge = std::abs(std::abs(r) - double(huber)) < 1e-4;
        if (!near_the_edge) {
          const double expected = std::abs(r) > double(huber) ? 0 : slope;
          EXPECT_NEAR(double(x.weighted_slope[i]), expected, double(this->few) * expected) << set;
        }
      }
    }
}

TYPED_TEST(ColumnKernels, MaskedSamplesAreZeroWhateverStandsThere) {
  using F = TypeParam;
  const F nan = std::numeric_limits<F>::quiet_NaN(), infinite = std::numeric_limits<F>::infinity();
  struct Case {
    F value, slope, target, weight;
    bool masked;
  };
  const Case cases[] = {{1, 1, 3, 0, true},         {nan, 1, 3, 0, true},      {1, nan, 3, 0, true},
                        {1, 1, nan, 0, true},       {1, 1, 3, -1, true},       {1, 1, 3, nan, true},
                        {nan, nan, nan, nan, true}, {infinite, 1, 3, 0, true}, {1, 1, 3, 1, false}};
  for (const auto& set : instruction_sets())
    for (const auto kind : {0, 1}) {
      const auto& k = kernels<F>(set);
      for (const auto& c : cases) {
        Residuals<F> x{Column<F>(n, c.value), Column<F>(n, c.slope), Column<F>(n, c.target),
                       Column<F>(n, c.weight)};
        x.run(kind ? k.influence : k.residual);
        const F cost = std::accumulate(x.cost.data(), x.cost.data() + padding, F(0));
        for (std::size_t i = 0; i < n; ++i) {
          EXPECT_EQ(x.r[i] == 0, c.masked) << set << " " << c.value << " " << c.weight;
          EXPECT_TRUE(std::isfinite(x.r[i]) && std::isfinite(x.weighted_slope[i]));
          if (c.masked) {
            EXPECT_EQ(x.weighted_slope[i], 0);
          }
        }
        EXPECT_EQ(cost == 0, c.masked) << set;
        EXPECT_TRUE(std::isfinite(cost));
      }
    }
}

// ---- Normal equations ---------------------------------------------------------------------------

TYPED_TEST(ColumnKernels, GramIsTheNaiveSumOfProducts) {
  using F = TypeParam;
  for (const auto& set : instruction_sets())
    for (std::size_t columns = 1; columns <= most_columns; ++columns) {
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

TYPED_TEST(ColumnKernels, InfluenceIsThatOfEachOfTheSamplesThatAValueCountsAs) {
  using F = TypeParam;
  for (const auto& set : instruction_sets())
    for (std::size_t k = 1; k < most_columns; ++k) {
      const std::size_t rows = k + 2;
      auto score = this->random_column(), slope = this->random_column();
      const auto per_root = this->random_column(F(0.3), 1);
      std::vector<Column<F>> jacobian, seen;
      for (std::size_t i = 0; i < k; ++i) {
        jacobian.push_back(this->random_column());
        seen.push_back(this->random_column());
      }
      for (const std::size_t masked : {std::size_t{3}, n - 1}) {
        score[masked] = slope[masked] = 0;
        for (auto& c : jacobian) c[masked] = std::numeric_limits<F>::quiet_NaN();
      }
      score[5] = slope[6] = 0;  // alone neither masks
      std::vector<const F*> j;
      std::vector<F*> to;
      for (std::size_t i = 0; i < k; ++i) {
        j.push_back(jacobian[i].data());
        to.push_back(seen[i].data());
      }
      std::vector<F> product(k * k), beta(rows * k);
      for (F& x : product) x = this->draw(F(-0.002), F(0.002));
      for (F& x : beta) x = this->draw(-1, 1);
      Column<F> h(n), fourth(rows * padding, 0), moves(rows * padding, 0);
      const auto before = score.data();
      const std::vector<F> old(before, before + n);
      const InfluenceArguments<F> a{
          slope.data(), per_root.data(), j.data(), to.data(),     product,
          beta,         score.data(),    h.data(), fourth.data(), moves.data()};
      kernels<F>(set).leverage[k](n, a);
      kernels<F>(set).moves[k](n, a);
      std::vector<double> shares(rows), moved(rows);
      for (std::size_t i = 0; i < n; ++i) {
        const bool on = old[i] != 0 || slope[i] != 0;
        const double count = 1 / (double(per_root[i]) * double(per_root[i]));
        const auto at = [&](std::size_t p) { return on ? double(jacobian[p][i]) : 0; };
        double leverage = 0;
        for (std::size_t p = 0; p < k; ++p)
          for (std::size_t q = 0; q < k; ++q)
            leverage += double(product[p * k + q]) * at(p) * at(q);
        leverage *= double(slope[i]) * double(slope[i]) / count;
        EXPECT_NEAR(double(h[i]), leverage, double(this->few)) << set << " " << k;
        const double one = double(old[i]) / count / (1 - leverage);  // the score of one of them
        EXPECT_NEAR(double(score[i]) * double(score[i]), count * one * one,
                    double(this->few) * (1 + count * one * one));
        for (std::size_t r = 0; r < rows; ++r) {
          double move = 0;
          for (std::size_t p = 0; p < k; ++p) move += double(beta[r * k + p]) * at(p);
          shares[r] += count * std::pow(double(slope[i]) / std::sqrt(count) * move, 4);
          moved[r] += count * std::pow(one * move, 4);
        }
      }
      for (std::size_t r = 0; r < rows; ++r) {
        const auto sum = [&](const Column<F>& lanes) {
          return double(
              std::accumulate(lanes.data() + r * padding, lanes.data() + (r + 1) * padding, F(0)));
        };
        EXPECT_NEAR(sum(fourth) / shares[r], 1, 20 * double(this->few)) << set << " " << k;
        EXPECT_NEAR(sum(moves) / moved[r], 1, 20 * double(this->few)) << set << " " << k;
      }
    }
}

}  // namespace
}  // namespace gonio
