// The laws of Fresnel reflectance.  How many digits the terms keep is judged by fifty-digit numbers
// in brdf/in_number/wide_test.cpp.
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <string>

#include "constants.h"
#include "number/dual.h"
#include "optics/fresnel_approximate.h"
#include "optics/reflectance.h"

namespace gonio {
namespace {

using test::eps;

double schlick(double f0, double c) {
  return reflectance<Schlick>(c, f0);
}
double dielectric(double eta, double c) {
  return reflectance<Dielectric>(c, eta);
}
double conductor(double eta, double k, double c) {
  return reflectance<Conductor>(c, eta, k);
}

/// The textbook's amplitudes in complex numbers, for a conductor and, with k = 0, a dielectric.
double textbook(double eta, double k, double c) {
  using Complex = std::complex<long double>;
  const Complex n(eta, k), cos(c),
      root = std::sqrt(n * n - Complex(1 - static_cast<long double>(c) * c));
  const Complex rs = (cos - root) / (cos + root);
  const Complex rp = (n * n * cos - root) / (n * n * cos + root);
  return static_cast<double>((std::norm(rs) + std::norm(rp)) / 2);
}

constexpr double cosines[] = {1e-8, 1e-3, 0.02, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 1};

TEST(Schlick, IsExactAtNormalIncidenceAndAtGrazing) {
  for (const double f0 : {0.0, 0.04, 0.1, 1.0 / 3, 0.999, 1.0}) {
    EXPECT_EQ(schlick(f0, 1), f0);
    EXPECT_EQ(schlick(f0, 0), 1);
  }
}

TEST(Schlick, IsItsFormula) {
  for (const double f0 : {0.0, 0.04, 0.5, 1.0})
    for (const double c : cosines)
      EXPECT_NEAR(schlick(f0, c), f0 + (1 - f0) * std::pow(1 - c, 5), 4 * eps);
}

TEST(Dielectric, ReflectsTheSquaredRatioAtNormalIncidence) {
  for (const double eta : {0.2, 0.5, 0.9, 1.0, 1.001, 1.33, 1.5, 2.42, 10.0}) {
    const double r = (eta - 1) / (eta + 1);
    EXPECT_NEAR(dielectric(eta, 1), r * r, 8 * eps * r * r);
  }
}

TEST(Dielectric, IsTheTextbook) {
  for (const double eta : {0.3, 0.7, 0.9, 1.1, 1.5, 3.0, 10.0})
    for (const double c : cosines)
      EXPECT_NEAR(dielectric(eta, c), textbook(eta, 0, c), 1e-14) << eta << " " << c;
}

TEST(Dielectric, ReflectsOnlySAtBrewstersAngle) {
  for (const double eta : {0.5, 1.2, 1.5, 2.42}) {
    const double c = 1 / std::sqrt(1 + eta * eta);  // tan θ = η: r_p = 0, r_s = (1 − η²)/(1 + η²)
    const double rs = (1 - eta * eta) / (1 + eta * eta);
    EXPECT_NEAR(dielectric(eta, c), rs * rs / 2, 8 * eps);
  }
}

TEST(Dielectric, ReflectsAllAtGrazing) {
  for (const double eta : {0.3, 0.99, 1.001, 1.5, 10.0})
    EXPECT_NEAR(dielectric(eta, 0), 1, 4 * eps);
}

TEST(Dielectric, ReflectsAllBeyondTheCriticalAngleFromInside) {
  for (const double eta : {0.3, 0.7, 0.99, 1 - 1e-10}) {
    const double critical = std::sqrt((1 - eta) * (1 + eta));
    for (const double part : {0.0, 1e-6, 0.5, 0.999999})
      EXPECT_EQ(dielectric(eta, part * critical), 1);
    EXPECT_LT(dielectric(eta, critical + (1 - critical) / 2), 0.5);
  }
}

TEST(Dielectric, IsTheSameFromBothSides) {
  for (const double eta : {1.1, 1.5, 3.0})
    for (const double c : cosines) {
      const double inside = std::sqrt(1 - (1 - c * c) / (eta * eta));  // Snell
      EXPECT_NEAR(dielectric(eta, c), dielectric(1 / eta, inside), 1e-13 / c);
    }
}

TEST(Dielectric, OfIndexOneIsNotThere) {
  EXPECT_EQ(dielectric(1, 0), 0);
  for (const double c : cosines) EXPECT_EQ(dielectric(1, c), 0);
}

TEST(Conductor, ReflectsTheSquaredRatioAtNormalIncidence) {
  for (const double eta : {0.001, 0.2, 1.0, 1.5, 20.0})
    for (const double k : {0.0, 1e-6, 0.1, 3.0, 1000.0}) {
      const double f = ((eta - 1) * (eta - 1) + k * k) / ((eta + 1) * (eta + 1) + k * k);
      EXPECT_NEAR(conductor(eta, k, 1), f, 16 * eps * f) << eta << " " << k;
    }
}

TEST(Conductor, IsTheTextbook) {
  for (const double eta : {0.001, 0.2, 0.7, 1.0, 1.5, 3.0, 20.0})
    for (const double k : {1e-6, 0.01, 0.5, 1.0, 3.0, 10.0, 1000.0})
      for (const double c : cosines)
        EXPECT_NEAR(conductor(eta, k, c), textbook(eta, k, c), 1e-14)
            << eta << " " << k << " " << c;
}

TEST(Conductor, WithoutAbsorptionIsTheDielectric) {
  // For η < 1 beyond the critical angle both are total reflection.
  for (const double eta : {0.3, 0.7, 0.99, 1.0, 1.001, 1.5, 3.0, 10.0})
    for (const double c : {0.0, 1e-8, 1e-3, 0.02, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 1.0})
      EXPECT_NEAR(conductor(eta, 0, c), dielectric(eta, c), 8 * eps) << eta << " " << c;
}

TEST(Conductor, WithAlmostNoAbsorptionIsAlmostTheDielectric) {
  for (const double eta : {0.3, 0.7, 1.5, 3.0})
    for (const double k : {1e-300, 1e-20, 1e-12})
      for (const double c : {0.0, 1e-8, 1e-3, 0.1, 0.5, 0.9, 1.0})
        EXPECT_NEAR(conductor(eta, k, c), dielectric(eta, c), 1e-11) << eta << " " << k << " " << c;
}

TEST(Conductor, ReflectsAllAtGrazing) {
  for (const double eta : {0.001, 0.3, 1.001, 1.5, 20.0})
    for (const double k : {0.0, 1e-20, 1e-6, 0.5, 3.0, 1000.0})
      EXPECT_NEAR(conductor(eta, k, 0), 1, 8 * eps) << eta << " " << k;
}

TEST(Conductor, OfIndexOneWithoutAbsorptionIsNotThere) {
  for (const double c : {0.0, 1e-200, 1e-8, 0.5, 1.0}) EXPECT_EQ(conductor(1, 0, c), 0) << c;
}

TEST(Conductor, IsTotalAtTheCriticalAngleItself) {
  // Exact in binary: η² − 1 + c² = 0 for η = 0.6, c = 0.8 but for rounding, on both sides of it.
  for (double c = 0.8 - 8 * eps; c < 0.8 + 8 * eps; c += eps / 2)
    EXPECT_NEAR(conductor(0.6, 0, c), 1, 1e-6) << c;
}

/// Value in [0, 1] and finite derivatives, in T, at all corners of the domain.
template <class T>
void check_corners() {
  using D1 = Dual<T, 1>;
  using D2 = Dual<T, 2>;
  const auto check = [](const auto& f, const std::string& where) {
    constexpr T slack = 8 * std::numeric_limits<T>::epsilon();
    EXPECT_TRUE(-slack <= f.v && f.v <= 1 + slack) << where << ": " << f.v;
    for (const T d : f.d) EXPECT_TRUE(std::isfinite(d)) << where;
  };
  for (const T c : {T(0), T(1e-30), T(1e-12), T(1e-8), T(1e-3), T(0.5), T(0.8), T(1)}) {
    const auto at = [&](auto... x) {
      return (... + (std::to_string(x) + " ")) + std::to_string(c);
    };
    for (const T f0 : {T(0), T(0.04), T(1)})
      check(reflectance<Schlick>(c, D1::variable(f0, 0)), at(f0));
    for (const T eta : {T(0.2), T(0.6), T(1 - 1e-7), T(1), T(1 + 1e-7), T(1.5), T(10)}) {
      check(reflectance<Dielectric>(c, D1::variable(eta, 0)), at(eta));
      for (const T k : {T(0), T(1e-30), T(1e-8), T(1e-3), T(1), T(1000)})
        check(reflectance<Conductor>(c, D2::variable(eta, 0), D2::variable(k, 1)), at(eta, k));
    }
  }
}

TEST(Fresnel, AndItsDerivativesAreFiniteAtTheEdgesOfTheDomain) {
  check_corners<double>();
  check_corners<float>();
}

TEST(Fresnel, DerivativesAreThoseOfDifferences) {
  using D1 = Dual<double, 1>;
  using D2 = Dual<double, 2>;
  const double h = 1e-6;
  for (const double c : {1e-3, 0.1, 0.5, 0.9, 1.0}) {
    for (const double eta : {0.3, 0.95, 1.0, 1.5, 3.0}) {
      const double critical = 1 - eta * eta - c * c;
      if (std::abs(critical) > 0.01) {
        EXPECT_NEAR(reflectance<Dielectric>(c, D1::variable(eta, 0)).d[0],
                    (dielectric(eta + h, c) - dielectric(eta - h, c)) / (2 * h), 1e-5 / c)
            << eta << " " << c;
      }
      for (const double k : {0.01, 0.5, 3.0}) {
        const auto f = reflectance<Conductor>(c, D2::variable(eta, 0), D2::variable(k, 1));
        EXPECT_NEAR(f.d[0], (conductor(eta + h, k, c) - conductor(eta - h, k, c)) / (2 * h),
                    1e-7 / c);
        EXPECT_NEAR(f.d[1], (conductor(eta, k + h, c) - conductor(eta, k - h, c)) / (2 * h),
                    1e-7 / c);
      }
    }
  }
}

TEST(Conductor, DoesNotFeelTheSignOfAbsorptionAtItsZero) {
  using D2 = Dual<double, 2>;
  for (const double eta : {1.2, 1.5, 3.0})
    for (const double c : cosines) {
      const auto f = reflectance<Conductor>(c, D2::variable(eta, 0), D2::variable(0, 1));
      EXPECT_EQ(f.d[1], 0) << "F is even in k";
      EXPECT_NEAR(f.d[0], reflectance<Dielectric>(c, Dual<double, 1>::variable(eta, 0)).d[0],
                  1e-13);
    }
}

}  // namespace
}  // namespace gonio
