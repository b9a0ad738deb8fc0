// Smith masking for GTR against its integral, and the table that it is made from against the
// program that makes it.
#include "brdf/formula/smith_gtr.h"

#include <complex>
#include <cstdio>

#include "brdf/terms.h"
#include "constants.h"
#include "number/batch.h"
#include "number/dual.h"

namespace gonio {
namespace {

using Complex = std::complex<double>;

using test::eps;
using test::pi;

double expm1_of(double z) {
  return std::abs(z) < 1e-9 ? 1 + z / 2 : std::expm1(z) / z;
}

/// P(q) for every γ > 0 but 1: the integral over z of smith_gtr.h becomes 1/(2πi (γ − 1)) times that
/// of (−z)^(1−γ) z/(…) along a loop from +∞ about the origin, through −1/2, and back.  All
/// singularities are outside at z ≤ −1.  In z = sinh²s − 1/2 + i sinh s the trapezoidal rule
/// converges geometrically.
class Loop {
 public:
  Loop(double alpha, double gamma) : alpha_(alpha), gamma_(gamma) {
    constexpr double step = 0.05;
    double largest = 0;
    for (double s = step / 2; s < 80; s += step) {
      const double u = std::sinh(s);
      const Complex z(u * u - 0.5, u), root = std::sqrt(1.0 + alpha * alpha * z);
      const Complex weight = std::pow(-z, 1 - gamma) * z / ((z + 1.0) * root * root * root) *
                             Complex(2 * u, 1) * std::cosh(s) * step;
      if (!(std::abs(weight) > 1e-17 * largest)) break;
      largest = std::max(largest, std::abs(weight));
      z_.push_back(z);
      weight_.push_back(weight);
    }
  }

  /// Of the loop alone, at Q = q/α².
  double integral(double q) const {
    double sum = 0;
    for (std::size_t k = 0; k < z_.size(); ++k)
      sum += (weight_[k] / (std::sqrt(z_[k] + q) + std::sqrt(q))).imag();
    return sum / pi;
  }
  double r(double c) const {
    const double l = 2 * std::log(alpha_),
                 q = alpha_ * alpha_ + (1 - alpha_) * (1 + alpha_) * c * c;
    const double scale = alpha_ * expm1_of(l) / expm1_of((gamma_ - 1) * l) / (gamma_ - 1);
    const auto p = [&](double x) { return scale * integral(x / (alpha_ * alpha_)); };
    return std::sqrt(q) * (1 - p(1)) + p(q);
  }
  double g1(double c) const { return 2 * c / (c + r(c)); }

 private:
  double alpha_, gamma_;
  std::vector<Complex> z_, weight_;
};

template <class F>
double r(double alpha, double gamma, double c) {
  const std::array p{static_cast<F>(alpha), static_cast<F>(gamma)};
  return static_cast<double>(SmithGtrRoot<F>(p)(static_cast<F>(c))) / smith_scale;
}
template <class F = double>
double g1(double alpha, double gamma, double c) {
  return 2 * c / (c + r<F>(alpha, gamma, c));
}

constexpr double gtr_cosines[] = {1e-6, 1e-5, 5e-5, 1e-4, 2e-4, 5e-4, 1e-3, 3e-3,
                                  0.01, 0.02, 0.04, 0.07, 0.1,  0.15, 0.2,  0.3,
                                  0.4,  0.5,  0.6,  0.7,  0.8,  0.9,  0.98, 1};
const test::Parameters gtr_alphas = test::spread({1e-4, 1}, 18);
/// Dense where the coefficients change hands.
constexpr double gammas[] = {0.5, 0.6, 0.75, 0.9, 1.1,      1.3, 1.45, 1.5, 1.7, 1.9, 2,
                             2.2, 2.5, 2.7,  2.9, 3 - 1e-9, 3,   3.01, 3.2, 3.5, 4,   4.6,
                             5,   5.7, 6.4,  7,   7.7,      8.5, 9.2,  9.7, 10};

// ---- The value ----------------------------------------------------------------------------------

TEST(SmithGtrRuler, IsTheClosedFormOfGgxAndOfThree) {
  for (const double alpha : {1e-4, 0.03, 0.5, 0.9})
    for (const double c : gtr_cosines) {
      const double q = alpha * alpha + (1 - alpha) * (1 + alpha) * c * c, a2 = alpha * alpha;
      EXPECT_NEAR(Loop(alpha, 2).r(c) / std::sqrt(q), 1, 1e-13);
      const double three = std::sqrt(q) * (2 + 3 * a2 - a2 / q) / (2 + 2 * a2);
      EXPECT_NEAR(Loop(alpha, 3).r(c) / three, 1, 1e-13);
    }
}

TEST(SmithGtr, IsItsIntegralWithinHalfAMillionth) {
  double below = 0, above = 0;
  for (const double gamma : gammas)
    for (const double alpha : gtr_alphas) {
      const Loop truth(alpha, gamma);
      for (const double c : gtr_cosines) {
        const double error = std::abs(g1(alpha, gamma, c) - truth.g1(c));
        EXPECT_LT(error, gamma < 3 ? 5e-8 : 5e-7) << alpha << " " << gamma << " " << c;
        (gamma < 3 ? below : above) = std::max(gamma < 3 ? below : above, error);
      }
    }
  RecordProperty("worst below 3", std::to_string(below * 1e9) + "e-9");
  RecordProperty("worst from 3 on", std::to_string(above * 1e9) + "e-9");
}

TEST(SmithGtr, OfGammaOneIsTheClosedFormOfBerry) {
  // r = (1 − √q + c ln((c + √q)/(α (1 + c)))) / ln 1/α: Euler's integral, where the root is the
  // variable
  for (const double alpha : {1e-4, 1e-3, 0.01, 0.1, 0.3, 0.6, 0.9})
    for (const double c : gtr_cosines) {
      const double root = std::sqrt(alpha * alpha + (1 - alpha) * (1 + alpha) * c * c);
      const double berry =
          (1 - root + c * std::log((c + root) / (alpha * (1 + c)))) / -std::log(alpha);
      EXPECT_NEAR(g1(alpha, 1, c), 2 * c / (c + berry), 5e-8) << alpha << " " << c;
    }
}

TEST(SmithGtr, OfGammaTwoIsGgxToTheLastDigits) {
  for (const auto* form : {"separable", "correlated"})
    for (const double alpha : gtr_alphas)
      for (const double l : gtr_cosines)
        for (const double v : gtr_cosines) {
          const Angles<double> x{l, v, 0.5, 0.5, 0.75};
          const auto id = [&](const char* of) { return std::string("masking.smith_") + of + form; };
          const double ggx = test::value_of(find_term(id("ggx.")), {alpha}, x);
          EXPECT_NEAR(test::value_of(find_term(id("gtr.")), {alpha, 2}, x), ggx, 8 * eps * ggx);
        }
}

TEST(SmithGtr, OfAlphaOneIsTheUniformDistributions) {
  for (const double gamma : gammas)
    for (const double c : gtr_cosines) EXPECT_NEAR(g1(1, gamma, c), 2 * c / (1 + c), 5e-8) << gamma;
}

TEST(SmithGtr, StaysBetweenZeroAndOneAndGrowsWithTheCosine) {
  for (const double gamma : gammas)
    for (const double alpha : gtr_alphas) {
      double before = 0;
      for (double c = 1e-4; c <= 1; c += 1.0 / 512) {
        const double g = g1(alpha, gamma, c);
        EXPECT_GT(g, 0);
        EXPECT_LE(g, 1);
        EXPECT_GE(g, before - 3e-9) << alpha << " " << gamma << " " << c;
        before = g;
      }
      EXPECT_NEAR(r<double>(alpha, gamma, 1), 1, 4 * eps);
    }
}

TEST(SmithGtr, OfBothDirectionsIsNoMoreThanOfEither) {
  for (const auto* id : {"masking.smith_gtr.separable", "masking.smith_gtr.correlated"})
    for (const double gamma : {0.5, 1.0, 2.5, 3.0, 6.0, 10.0})
      for (const double alpha : {1e-4, 0.01, 0.3, 1.0})
        for (const double l : gtr_cosines)
          for (const double v : gtr_cosines) {
            const double g =
                4 * l * v * test::value_of(find_term(id), {alpha, gamma}, {l, v, 0.5, 0.5, 0.75});
            EXPECT_LE(g, std::min(g1(alpha, gamma, l), g1(alpha, gamma, v)) * (1 + 8 * eps)) << id;
            EXPECT_GT(g, 0);
          }
}

// ---- Derivatives --------------------------------------------------------------------------------

TEST(SmithGtr, HasTheDerivativesOfItsIntegral) {
  using T = Dual<double, 2>;
  double worst = 0;
  for (const double gamma : {0.51, 0.8, 1.2, 1.5, 2.0, 2.6, 2.99, 3.0, 3.02, 4.0, 7.0, 9.9})
    for (const double alpha : {1.01e-4, 1e-3, 0.01, 0.1, 0.4, 0.8, 0.98}) {
      const std::array p{T::variable(alpha, 0), T::variable(gamma, 1)};
      const SmithGtrRoot<T> root(p);
      constexpr double h = 1e-4;
      const Loop wider(alpha * (1 + h), gamma), narrower(alpha * (1 - h), gamma);
      const Loop steeper(alpha, gamma * (1 + h)), flatter(alpha, gamma * (1 - h));
      for (const double c : gtr_cosines) {
        const T g = 2 * c / (c + root(c) / smith_scale);
        for (const double error : {alpha * g.d[0] - (wider.g1(c) - narrower.g1(c)) / (2 * h),
                                   gamma * g.d[1] - (steeper.g1(c) - flatter.g1(c)) / (2 * h)}) {
          EXPECT_NEAR(error, 0, 2e-5) << alpha << " " << gamma << " " << c;
          worst = std::max(worst, std::abs(error));
        }
      }
    }
  RecordProperty("worst", std::to_string(worst * 1e6) + "e-6");
}

// ---- Other numbers ------------------------------------------------------------------------------

TEST(SmithGtr, KeepsTheDigitsOfFloat) {
  double worst = 0;
  for (const double gamma : gammas)
    for (const double alpha : gtr_alphas)
      for (const double c : gtr_cosines) {
        const double a = static_cast<float>(alpha), g = static_cast<float>(gamma);
        const double error = std::abs(g1<float>(a, g, static_cast<float>(c)) -
                                      g1(a, std::max(g, gamma), static_cast<float>(c)));
        EXPECT_LT(error, 2e-6) << alpha << " " << gamma << " " << c;
        worst = std::max(worst, error);
      }
  RecordProperty("worst", std::to_string(worst * 1e9) + "e-9");
}

TEST(SmithGtr, MayHaveAnotherGammaInEveryLane) {  // both ways of finding coefficients at once
  using B = Batch<double>;
  alignas(64) std::array<double, lanes<B>> gamma, out;
  for (std::size_t k = 0; k < gamma.size(); ++k) gamma[k] = k % 2 ? 6.5 : 1.5;
  const std::array p{B(0.2), load<B>(gamma.data())};
  const SmithGtrRoot<B> root(p);
  for (const double c : gtr_cosines) {
    store<B>(out.data(), root(B(c)));
    for (std::size_t k = 0; k < out.size(); ++k)
      EXPECT_NEAR(out[k] / smith_scale, r<double>(0.2, gamma[k], c), 64 * eps) << gamma[k];
  }
}

// ---- The table ----------------------------------------------------------------------------------

/// The Chebyshev coefficients of P (γ − 1)/(α C v) in v, α (both over [0, 1]) and ln γ over
/// [ln 3, ln 10], by interpolation.
struct Fit {
  static constexpr std::size_t in_v = 24, in_alpha = 22, in_gamma = 20;
  static constexpr double kept = 2e-8;
  std::vector<double> c = std::vector<double>(in_v * in_alpha * in_gamma);

  double& at(std::size_t n, std::size_t i, std::size_t j) {
    return c[(n * in_alpha + i) * in_gamma + j];
  }
  Fit() {
    const auto node = [](std::size_t k, std::size_t of) {
      return (1 + std::cos((static_cast<double>(k) + 0.5) * pi / static_cast<double>(of))) / 2;
    };
    for (std::size_t i = 0; i < in_alpha; ++i)
      for (std::size_t j = 0; j < in_gamma; ++j) {
        const Loop loop(node(i, in_alpha), 3 * std::pow(10 / 3.0, node(j, in_gamma)));
        for (std::size_t n = 0; n < in_v; ++n) {
          const double v = node(n, in_v);
          at(n, i, j) = loop.integral(1 / (v * v)) / v;
        }
      }
    transform(in_v, in_alpha * in_gamma);
    transform(in_alpha, in_gamma);
    transform(in_gamma, 1);
  }
  /// How many coefficients in α are kept with n of v and j of ln γ.
  std::size_t count(std::size_t n, std::size_t j) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < in_alpha; ++i)
      if (std::abs(at(n, i, j)) > kept) count = i + 1;
    return count;
  }

 private:
  void transform(std::size_t size, std::size_t stride) {
    std::vector<double> x(size);
    for (std::size_t start = 0; start < c.size(); ++start) {
      if (start / stride % size != 0) continue;
      for (std::size_t k = 0; k < size; ++k) x[k] = c[start + k * stride];
      for (std::size_t n = 0; n < size; ++n) {
        double sum = 0;
        for (std::size_t k = 0; k < size; ++k)
          sum += x[k] * std::cos(pi * static_cast<double>(n * (2 * k + 1)) /
                                 static_cast<double>(2 * size));
        c[start + n * stride] = sum * (n == 0 ? 1 : 2) / static_cast<double>(size);
      }
    }
  }
};

/// smith_gtr_table.inc
std::string text_of(Fit& fit) {
  std::size_t v = 0, alpha = 0, gamma = 0;
  for (std::size_t n = 0; n < Fit::in_v; ++n)
    for (std::size_t j = 0; j < Fit::in_gamma; ++j)
      if (const auto count = fit.count(n, j); count > 0) {
        v = n + 1;
        gamma = std::max(gamma, j + 1);
        alpha = std::max(alpha, count);
      }
  const auto number = [](std::size_t x) { return std::to_string(x); };
  std::string s =
      "// Of smith_gtr.h.  SmithGtrTable.IsItsFit (smith_gtr_test.cpp) makes this file: where it\n"
      "// differs, it prints what should stand here.\n"
      "inline constexpr std::size_t table_v = " +
      number(v) + ", table_alpha = " + number(alpha) + ", table_gamma = " + number(gamma) +
      ";\ninline constexpr std::size_t table_counts[table_v][table_gamma] = {\n";
  for (std::size_t n = 0; n < v; ++n) {
    s += "    {";
    for (std::size_t j = 0; j < gamma; ++j)
      s += number(fit.count(n, j)) + (j + 1 < gamma ? ", " : "},\n");
  }
  s += "};\ninline constexpr double table[] = {\n";
  for (std::size_t n = 0; n < v; ++n)
    for (std::size_t j = 0; j < gamma; ++j) {
      std::string line = "   ";
      for (std::size_t i = 0; i < fit.count(n, j); ++i) {
        char x[32];
        std::snprintf(x, sizeof x, " %.9e,", fit.at(n, i, j));
        if (line.size() + std::string(x).size() > 100) s += line + "\n", line = "   ";
        line += x;
      }
      if (line.size() > 3) s += line + "\n";
    }
  return s + "};\n";
}

TEST(SmithGtrTable, IsItsFit) {
  namespace table = smith_gtr::fixed;
  Fit fit;
  bool same = true;
  std::size_t at = 0;
  for (std::size_t n = 0; n < Fit::in_v; ++n)
    for (std::size_t j = 0; j < Fit::in_gamma; ++j) {
      const bool inside = n < table::table_v && j < table::table_gamma;
      const std::size_t count = inside ? table::table_counts[n][j] : 0;
      same = same && count == fit.count(n, j);
      for (std::size_t i = 0; i < count && at < std::size(table::table); ++i, ++at)
        same = same && std::abs(table::table[at] - fit.at(n, i, j)) <
                           1e-12 + 1e-9 * std::abs(fit.at(n, i, j));
    }
  EXPECT_TRUE(same && at == std::size(table::table)) << text_of(fit);
}

}  // namespace
}  // namespace gonio
