// What each approximation of Fresnel reflectance is at the angles where it is known in closed form.
#include "optics/fresnel_approximate.h"

#include <array>
#include <cmath>
#include <limits>

#include "number/dual.h"
#include "number/mixed.h"
#include "optics/reflectance.h"

namespace gonio {
namespace {

constexpr double from_grazing[] = {0, 1e-8, 1e-3, 0.02, 0.1, 1.0 / 7, 0.3, 0.5, 0.7, 0.9, 0.99, 1};
constexpr double parts[] = {0, 0.04, 0.1, 1.0 / 3, 0.5, 0.95, 1};

template <template <class> class Term>
double f(double c, std::same_as<double> auto... p) {
  return reflectance<Term>(c, p...);
}

TEST(SchlicksForm, IsPrintedAsItIsComputed) {
  EXPECT_EQ(Schlick<double>::about.formula, "F = f0 (1 − w) + w, w = (1 − VoH)⁵")
      << "f0 + (1 − f0) w keeps less in half";
}

TEST(ConstantReflectance, IsTheSameAtEveryAngle) {
  for (const double c : from_grazing) EXPECT_EQ(f<ConstantReflectance>(c, 0.3), 0.3);
}

TEST(SchlickF90, RunsFromF0ToF90) {
  for (const double f0 : parts)
    for (const double f90 : parts) {
      EXPECT_EQ(f<SchlickF90>(1, f0, f90), f0);
      EXPECT_EQ(f<SchlickF90>(0, f0, f90), f90);
      EXPECT_NEAR(f<SchlickF90>(0.5, f0, f90), f0 + (f90 - f0) / 32,
                  2 * std::numeric_limits<double>::epsilon());
    }
}

TEST(SchlickF90, IsSchlickWhereAllIsReflectedAtGrazing) {
  for (const double f0 : parts)
    for (const double c : from_grazing)
      EXPECT_NEAR(f<SchlickF90>(c, f0, 1.0), f<Schlick>(c, f0),
                  4 * std::numeric_limits<double>::epsilon())
          << f0 << " " << c;
}

TEST(SchlickWeighted, IsItsPartOfSchlick) {
  for (const double c : from_grazing)
    EXPECT_DOUBLE_EQ(f<SchlickWeighted>(c, 0.04, 0.25), f<Schlick>(c, 0.04) / 4);
}

TEST(WeightedLayers, AreTheirPartsOfTheLayer) {
  for (const double c : {0.02, 0.3, 0.9, 1.0}) {
    EXPECT_DOUBLE_EQ(f<SchlickF90Weighted>(c, 0.04, 0.6, 0.25), f<SchlickF90>(c, 0.04, 0.6) / 4);
    EXPECT_DOUBLE_EQ(f<DielectricWeighted>(c, 1.5, 0.25), f<Dielectric>(c, 1.5) / 4);
    EXPECT_DOUBLE_EQ(f<ConductorWeighted>(c, 0.2, 3.0, 0.25), f<Conductor>(c, 0.2, 3.0) / 4);
  }
}

TEST(SchlickMetallic, RunsFromAFourPercentDielectricToTheColour) {
  for (const double c : {0.02, 0.3, 0.9, 1.0}) {
    EXPECT_DOUBLE_EQ(f<SchlickMetallic>(c, 0.7, 0.0), f<Schlick>(c, 0.04));
    EXPECT_DOUBLE_EQ(f<SchlickMetallic>(c, 0.7, 1.0), f<Schlick>(c, 0.7));
    EXPECT_DOUBLE_EQ(f<SchlickMetallic>(c, 0.5, 0.25), f<Schlick>(c, 0.155));
  }
}

TEST(SchlickReflectance, HasADielectricOf16PercentOfItsSquare) {
  for (const double c : {0.02, 0.3, 0.9, 1.0}) {
    EXPECT_DOUBLE_EQ(f<SchlickReflectance>(c, 0.7, 0.0, 1.0), f<Schlick>(c, 0.16));
    EXPECT_DOUBLE_EQ(f<SchlickReflectance>(c, 0.7, 0.3, 0.5), f<SchlickMetallic>(c, 0.7, 0.3));
  }
}

TEST(SchlickUe, IsSchlickWhereGreenReflectsTwoPercentOrMore) {
  for (const double green : {0.02, 0.04, 1.0})
    for (const double f0 : parts)
      for (const double c : from_grazing)
        EXPECT_DOUBLE_EQ(f<SchlickUe>(c, f0, green), f<Schlick>(c, f0)) << f0 << " " << c;
}

TEST(SchlickUe, LosesItsGrazingReflectionBelow) {
  EXPECT_EQ(f<SchlickUe>(0, 0.3, 0.0), 0);
  EXPECT_DOUBLE_EQ(f<SchlickUe>(0, 0.3, 0.01), 0.5);
  EXPECT_EQ(f<SchlickUe>(1, 0.3, 0.01), 0.3) << "none of it at normal incidence";
  EXPECT_DOUBLE_EQ(f<SchlickUe>(0.5, 0.016, 0.01), 0.5 / 32 + 0.016 * 31 / 32);
}

TEST(SchlickUe, ShipsItsColourInHalf) {
  const std::array p{Mixed(0.3), Mixed(0.004)};
  const SchlickUe<Mixed> term{std::span<const Mixed, 2>(p)};
  const auto at = [](double c) {
    return Angles<Mixed>{Mixed(c), Mixed(c), Mixed(1), Mixed(c), Mixed(0)};
  };
  const auto normal = term(at(1)), grazing = term(at(0));
  EXPECT_EQ(normal.precision(), Mixed::Precision::single);
  EXPECT_EQ(normal.value(), 0.300048828125) << "the half nearest to 0.3";
  EXPECT_EQ(grazing.value(), static_cast<double>(50 * static_cast<float>(Half(0.004))))
      << "the product is a float";
}

TEST(SchlickSphericalGaussian, IsItsFormula) {
  for (const double f0 : parts)
    for (const double c : from_grazing)
      EXPECT_NEAR(f<SchlickSphericalGaussian>(c, f0),
                  f0 + (1 - f0) * std::exp2((-5.55473 * c - 6.98316) * c),
                  8 * std::numeric_limits<double>::epsilon());
}

TEST(SchlickSphericalGaussian, MissesF0AndFollowsSchlickToFourPartsInAThousand) {
  EXPECT_NEAR(f<SchlickSphericalGaussian>(1, 0.0), std::exp2(-12.53789), 1e-17);
  EXPECT_EQ(f<SchlickSphericalGaussian>(0, 0.04), 1);
  double worst = 0;
  for (int i = 0; i <= 1000; ++i)
    worst = std::max(
        worst, std::abs(f<SchlickSphericalGaussian>(i / 1e3, 0.0) - f<Schlick>(i / 1e3, 0.0)));
  EXPECT_NEAR(worst, 0.00377, 1e-5);
}

TEST(LinearAsWritten, IsAStraightLine) {
  for (const double f0 : parts) {
    EXPECT_EQ(f<LinearAsWritten>(1, f0), f0);
    EXPECT_EQ(f<LinearAsWritten>(0, f0), 1);
    EXPECT_NEAR(f<LinearAsWritten>(0.25, f0), (f0 + 3) / 4, std::numeric_limits<double>::epsilon());
  }
}

TEST(Disney2015, IsExactBelowItsBoundAndSchlickAbove) {
  for (const double c : from_grazing) {
    for (const double eta : {0.2, 0.9, 1.0, 1.01, 1.2999})
      EXPECT_EQ(f<Disney2015>(c, eta), f<Dielectric>(c, eta)) << eta << " " << c;
    for (const double eta : {1.3, 1.5, 2.42})
      EXPECT_DOUBLE_EQ(f<Disney2015>(c, eta),
                       f<Schlick>(c, ((eta - 1) / (eta + 1)) * ((eta - 1) / (eta + 1))));
  }
}

TEST(Disney2015, JumpsByTheErrorOfSchlickAtItsBound) {
  double jump = 0;
  for (int i = 0; i <= 1000; ++i)
    jump = std::max(jump, std::abs(f<Disney2015>(i / 1e3, 1.3) -
                                   f<Disney2015>(i / 1e3, std::nextafter(1.3, 0))));
  EXPECT_NEAR(jump, 0.0683, 1e-4);
}

TEST(F82Tint, HitsItsTintAt82DegreesAndF0AtNormalIncidence) {
  for (const double f0 : parts)
    for (const double tint : parts) {
      EXPECT_NEAR(f<F82Tint>(1, f0, tint), f0, 2 * std::numeric_limits<double>::epsilon());
      EXPECT_NEAR(f<F82Tint>(0, f0, tint), 1, 4 * std::numeric_limits<double>::epsilon());
      EXPECT_NEAR(f<F82Tint>(1.0 / 7, f0, tint), tint * f<Schlick>(1.0 / 7, f0),
                  4 * std::numeric_limits<double>::epsilon())
          << f0 << " " << tint;
    }
}

TEST(F82Tint, IsItsFormula) {
  for (const double f0 : parts)
    for (const double tint : parts)
      for (const double c : from_grazing) {
        const double hump = c * std::pow(1 - c, 6) / (1.0 / 7 * std::pow(6.0 / 7, 6));
        const double whole = f<Schlick>(c, f0) - (1 - tint) * f<Schlick>(1.0 / 7, f0) * hump;
        EXPECT_NEAR(f<F82Tint>(c, f0, tint), std::max(whole, 0.0),
                    8 * std::numeric_limits<double>::epsilon())
            << f0 << tint << c;
      }
}

TEST(F82Tint, OfAWhiteTintIsSchlick) {
  for (const double f0 : parts)
    for (const double c : from_grazing) EXPECT_EQ(f<F82Tint>(c, f0, 1.0), f<Schlick>(c, f0));
}

TEST(F82Tint, IsKeptAboveZeroForDarkTints) {
  // 0.5⁵ − (6/7)⁵ 0.5⁷/(1/7 (6/7)⁶) = 0.5⁵ (1 − 49/24) < 0
  EXPECT_EQ(f<F82Tint>(0.5, 0.0, 0.0), 0);
  EXPECT_GT(f<F82Tint>(0.1, 0.0, 0.0), 0);
}

TEST(Lazanyi, UncorrectedIsExactAtNormalIncidenceAndAtGrazing) {
  for (const double eta : {0.05, 0.2, 1.0, 1.5, 3.0})
    for (const double k : {0.0, 0.5, 3.0, 8.0}) {
      EXPECT_NEAR(f<Lazanyi>(1, eta, k, 0.0, 6.0), f<Conductor>(1, eta, k),
                  4 * std::numeric_limits<double>::epsilon());
      EXPECT_NEAR(f<Lazanyi>(0, eta, k, 0.0, 6.0), 1, 4 * std::numeric_limits<double>::epsilon())
          << eta << " " << k;
    }
}

TEST(Lazanyi, UncorrectedIsSchlickOfItsF0) {
  for (const double c : from_grazing)
    EXPECT_NEAR(f<Lazanyi>(c, 0.2, 3.0, 0.0, 6.0), f<Schlick>(c, f<Conductor>(1, 0.2, 3.0)),
                4 * std::numeric_limits<double>::epsilon());
}

TEST(Lazanyi, CorrectsByAHumpThatVanishesAtBothEnds) {
  const double base = f<Lazanyi>(0.25, 1.5, 7.0, 0.0, 6.0);
  EXPECT_NEAR(base - f<Lazanyi>(0.25, 1.5, 7.0, 0.8, 6.0), 0.2 * std::pow(0.75, 6),
              4 * std::numeric_limits<double>::epsilon());
  EXPECT_NEAR(base - f<Lazanyi>(0.25, 1.5, 7.0, 0.8, 2.5), 0.2 * std::pow(0.75, 2.5),
              4 * std::numeric_limits<double>::epsilon());
  for (const double c : {0.0, 1.0})
    EXPECT_EQ(f<Lazanyi>(c, 1.5, 7.0, 0.8, 6.0), f<Lazanyi>(c, 1.5, 7.0, 0.0, 6.0));
}

TEST(Lazanyi, CorrectionHalvesTheErrorForAluminium) {
  const auto worst = [](double correction) {
    double w = 0;
    for (int i = 0; i <= 1000; ++i)
      w = std::max(w, std::abs(f<Lazanyi>(i / 1e3, 1.0152, 6.6273, correction, 6.0) -
                               f<Conductor>(i / 1e3, 1.0152, 6.6273)));
    return w;
  };
  EXPECT_GT(worst(0), 0.05);
  EXPECT_LT(worst(1), worst(0) / 2);
}

TEST(Gulbrandsen, ReflectsF0AtNormalIncidenceWhateverItsTint) {
  for (const double f0 : {0.0, 1e-9, 1e-6, 0.04, 0.5, 0.9, 0.9999, 1 - 1e-7, 1.0})
    for (const double g : parts)
      EXPECT_NEAR(f<Gulbrandsen>(1, f0, g), f0, 4e-15 * f0 + 1e-15 * (f0 > 0.5)) << f0 << " " << g;
}

TEST(Gulbrandsen, IsTheConductorOfItsIndex) {
  for (const double f0 : {0.04, 0.3, 0.7, 0.95})
    for (const double g : parts) {
      const std::array p{f0, g};
      const auto [eta, k] = IndexFromEdgeTint<double>::apply(p);
      for (const double c : from_grazing)
        EXPECT_NEAR(f<Gulbrandsen>(c, f0, g), f<Conductor>(c, eta, k), 1e-14)
            << f0 << " " << g << " " << c;
    }
}

TEST(Gulbrandsen, OfAMirrorReflectsAll) {
  for (const double g : parts)
    for (const double c : from_grazing) EXPECT_EQ(f<Gulbrandsen>(c, 1.0, g), 1);
}

TEST(Gulbrandsen, DerivativesAreThoseOfDifferencesFromItsLowestTintOn) {
  using D = Dual<double, 2>;
  const double h = 1e-6;
  for (const double f0 : {0.04, 0.5, 0.95})
    for (const double c : {0.05, 0.3, 0.8}) {
      const auto at_0 = reflectance<Gulbrandsen>(c, D::variable(f0, 0), D::variable(0, 1));
      EXPECT_NEAR(at_0.d[1],
                  (4 * f<Gulbrandsen>(c, f0, h) - f<Gulbrandsen>(c, f0, 2 * h) -
                   3 * f<Gulbrandsen>(c, f0, 0.0)) /
                      (2 * h),
                  2e-6 + 1e-6 * std::abs(at_0.d[1]))
          << f0 << " " << c;
      EXPECT_NEAR(at_0.d[0],
                  (f<Gulbrandsen>(c, f0 + h, 0.0) - f<Gulbrandsen>(c, f0 - h, 0.0)) / (2 * h),
                  1e-7);
    }
}

}  // namespace
}  // namespace gonio
