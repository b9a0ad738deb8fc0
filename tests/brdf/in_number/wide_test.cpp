// Terms and what they are made of against textbooks in fifty digits.
#include "number/wide.h"

#include "brdf/in_number/number.h"
#include "brdf/terms.h"
#include "number/dual.h"
#include "number/special.h"

namespace gonio {
namespace {

using test::Parameters;
using test::text;

/// |x/truth − 1|; 0 if both are 0.
double relative_error(double x, const Wide& truth) {
  if (truth == 0) return x == 0 ? 0 : 1;
  return static_cast<double>(abs((Wide(x) - truth) / truth));
}

TEST(Wide, HasPiToItsLastDigit) {
  // sin π = 0: what is left of the sine's series is the error of π
  const Wide x = pi<Wide>();
  Wide term = x, sine = x;
  for (int k = 1; k < 60; ++k) {
    term *= -x * x / ((2 * k) * (2 * k + 1));
    sine += term;
  }
  EXPECT_LT(static_cast<double>(abs(sine)), 1e-48);
}

TEST(Wide, ValuesOfTermsCarryThirtyDigits) {
  // D = 1/π at alpha = 1
  const Parameters alpha{1};
  const auto d = wide_value(find_term("ndf.ggx"), alpha, test::framed({0.5, 0.5, 1, 0.8, 0}));
  const Wide error = Wide(d.value) + d.rest - 1 / pi<Wide>();
  EXPECT_LT(static_cast<double>(abs(error)), 1e-32);
}

// ---- The functions that terms are made of -------------------------------------------------------

TEST(Ierfc, IsRightToTheLastDigitsOfEveryNumberAndSoIsItsDerivative) {
  using boost::math::erfc;
  const Wide root_pi = sqrt(pi<Wide>());
  for (const double a :
       {0.0, 1e-300, 1e-9, 1e-3, 0.1, 0.4, 1.0, 1.9, 3.0, 6.0, 6.6, 7.5, 20.0, 26.0}) {
    const Wide x = a, truth = ierfc<Wide>(x);
    // exp(−a²)/√π − a erfc(a) loses as many digits as it cancels; beyond a = 20 too many
    const Wide first = exp(-x * x) / root_pi, difference = first - x * erfc(x);
    EXPECT_LT(abs(truth - difference), Wide(1e-47) * first) << a;

    const double eps = std::numeric_limits<double>::epsilon();
    const double value = ierfc<double>(a);
    EXPECT_LT(relative_error(value, truth), 4 * eps * (1 + a * a)) << a;
    const auto dual = ierfc<Dual<double, 1>>(Dual<double, 1>::variable(a, 0));
    EXPECT_EQ(dual.v, value);
    EXPECT_LT(relative_error(dual.d[0], -erfc(x)), 64 * eps * (1 + a * a)) << a;
    if (a > 0 && a < 9) {
      const float f = static_cast<float>(a);
      EXPECT_LT(relative_error(static_cast<double>(ierfc<float>(f)), ierfc<Wide>(Wide(f))),
                4e-7 * (1 + a * a))
          << a;
    }
  }
}

TEST(Ierfc, KeepsTwentyDigitsOfAWideNumberWhereTheDifferenceHasNone) {
  // ierfc(a) → e^(−a²)/(2 √π a²) (1 − 3/(2 a²)·… ): the asymptotic series Σ (−1)ᵏ (2k+1)!!/(2a²)ᵏ
  for (const double a : {12.0, 20.0, 40.0}) {
    const Wide x = a, two_a2 = 2 * x * x;
    Wide sum = 0, term = 1;
    for (int k = 1; abs(term) > 1e-52 && k < 140; ++k)
      sum += term, term *= -Wide(2 * k + 1) / two_a2;
    const Wide truth = exp(-x * x) / (sqrt(pi<Wide>()) * two_a2) * sum;
    EXPECT_LT(abs(ierfc<Wide>(x) / truth - 1), 1e-46) << a;
  }
}

TEST(LogNearOne, KeepsItsDigitsAndItsDerivativeBesideOne) {
  const double eps = std::numeric_limits<double>::epsilon();
  for (const double y :
       {-0.9, -0.49, -1e-3, -1e-9, -1e-17, 0.0, 1e-300, 1e-16, 1e-8, 0.3, 0.7, 50.0}) {
    const Wide truth = log(Wide(1) + Wide(y));
    const Wide exact = abs(y) < 1e-30 ? Wide(y) : truth;
    EXPECT_LE(relative_error(log_near_one<double>(1 + y, y), exact), 4 * eps) << y;
    const auto x = Dual<double, 1>::variable(y, 0);
    EXPECT_LE(relative_error(log_near_one<Dual<double, 1>>(1 + x, x).d[0], 1 / (1 + Wide(y))),
              8 * eps)
        << y;
  }
}

TEST(Log1pOver, KeepsItsDigitsAndItsSlopeThroughZero) {
  const double eps = std::numeric_limits<double>::epsilon();
  for (const double x : {1e-30, 1e-12, 1e-3, 0.3, 0.5, 0.500001, 1.0, 40.0, 1e20}) {
    const Wide truth = log(1 + Wide(x)) / x;
    const Wide near = 1 - Wide(x) / 2 + Wide(x) * x / 3;  // 1 + x has not all of x
    EXPECT_LE(relative_error(log1p_over<double>(x), x < 1e-11 ? near : truth), 4 * eps) << x;
    if (x > 1e-4) {
      EXPECT_LT(abs(log1p_over<Wide>(Wide(x)) / truth - 1), Wide(1e-44)) << x;
    }
  }
  EXPECT_EQ(log1p_over<double>(0), 1);
  EXPECT_NEAR((log1p_over<Dual<double, 1>>(Dual<double, 1>::variable(0, 0)).d[0]), -0.5, eps);
}

TEST(Arcsin, KeepsItsDigitsFromZeroToAQuarterTurn) {
  const double eps = std::numeric_limits<double>::epsilon();
  for (const double x : {1e-300, 1e-9, 0.01, 0.4, 0.9, 0.999999, 1.0}) {
    const Wide c = sqrt((1 - Wide(x)) * (1 + Wide(x))),
               truth = boost::multiprecision::asin(Wide(x));
    EXPECT_LE(relative_error(arcsin<double>(x, static_cast<double>(c)), truth), 6 * eps) << x;
    EXPECT_LT(abs(arcsin<Wide>(Wide(x), c) / truth - 1), Wide(1e-45)) << x;
  }
  EXPECT_EQ(arcsin<double>(0, 1), 0);
}

// ---- Fresnel against the textbook ---------------------------------------------------------------

/// The amplitudes of Born & Wolf with the complex root written out.
Wide fresnel(const Wide& eta, const Wide& k, const Wide& c) {
  const Wide s2 = 1 - c * c, re = eta * eta - k * k, im = 2 * eta * k;
  const Wide x = re - s2, length = sqrt(x * x + im * im);
  if (length == 0) return eta == 1 ? 0 : 1;
  // a + ib = √(N² − s²) by its larger part
  const Wide larger = sqrt((length + abs(x)) / 2), smaller = im / (2 * larger);
  const Wide a = x > 0 ? larger : smaller, b = x > 0 ? smaller : larger;
  const auto norm = [](const Wide& u, const Wide& v) { return u * u + v * v; };
  const Wide rs = norm(c - a, b) / norm(c + a, b);
  const Wide rp = norm(re * c - a, im * c - b) / norm(re * c + a, im * c + b);
  return (rs + rp) / 2;
}

constexpr double hard_eta[] = {0.3, 0.7, 1 - 1e-10, 1, 1 + 1e-10, 1.001, 1.5, 3, 10};
constexpr double hard_c[] = {0,    1e-8, 1e-6, 1e-5, 1e-4, 1e-3, 0.01,  0.02, 0.05,
                             0.1,  0.2,  0.3,  0.4,  0.5,  0.55, 0.6,   0.7,  0.72,
                             0.75, 0.8,  0.9,  0.95, 0.96, 0.99, 0.999, 1};

TEST(Dielectric, KeepsFourteenDigitsOverTheHardGrid) {
  const auto term = find_term("fresnel.dielectric");
  double worst = 0;
  for (const double eta : hard_eta)
    for (const double c : hard_c) {
      const double f = test::value_of(term, {eta}, {c, c, 1, c, 0});
      const double error = relative_error(f, fresnel(eta, 0, c));
      EXPECT_LT(error, 1e-14) << eta << " " << c << ": " << f;
      worst = std::max(worst, error);
    }
  RecordProperty("worst", std::to_string(worst / 2.2e-16) + " eps");
}

TEST(Conductor, KeepsFourteenDigitsOverTheHardGrid) {
  const auto term = find_term("fresnel.conductor");
  Parameters etas{0.001, 0.01, 0.1, 20};
  etas.insert(etas.end(), std::begin(hard_eta), std::end(hard_eta));
  double worst = 0;
  for (const double eta : etas)
    for (const double k :
         {0.0, 1e-20, 1e-12, 1e-8, 1e-4, 0.01, 0.1, 0.5, 1.0, 1.5, 3.0, 10.0, 100.0, 1000.0})
      for (const double c : hard_c) {
        const double f = test::value_of(term, {eta, k}, {c, c, 1, c, 0});
        const double error = relative_error(f, fresnel(eta, k, c));
        EXPECT_LT(error, 1e-14) << eta << " " << k << " " << c << ": " << f;
        worst = std::max(worst, error);
      }
  RecordProperty("worst", std::to_string(worst / 2.2e-16) + " eps");
}

/// Cosines about √(1 − η² + k²), where total reflection begins: it and those beside it, to the last
/// digit.
std::vector<double> critical_cosines(double eta, double k) {
  const double c = std::sqrt((1 - eta) * (1 + eta) + k * k);
  std::vector<double> all{c, std::nextafter(c, 0), std::nextafter(c, 1)};
  for (double part = 1e-15; part < 0.3; part *= 10) {
    all.push_back(c * (1 - part));
    all.push_back(c * (1 + part));
  }
  std::erase_if(all, [](double x) { return x > 1; });
  return all;
}

TEST(Dielectric, KeepsThirteenDigitsAtTheCriticalAngleItself) {
  const auto term = find_term("fresnel.dielectric");
  for (const double eta : {0.21, 0.3, 0.6, 1 / 1.5, 1 / 1.33, 0.99, 1 - 1e-6, 1 - 1e-10})
    for (const double c : critical_cosines(eta, 0)) {
      const double f = test::value_of(term, {eta}, {c, c, 1, c, 0});
      EXPECT_LT(relative_error(f, fresnel(eta, 0, c)), 1e-13) << eta << " " << c << ": " << f;
    }
}

TEST(Conductor, KeepsThirteenDigitsAtTheCriticalAngleItself) {
  const auto term = find_term("fresnel.conductor");
  for (const double eta : {0.01, 0.21, 0.6, 1 / 1.5, 1 / 1.33, 0.99, 1 - 1e-6, 1 - 1e-10, 1.2})
    for (const double k : {0.0, 1e-20, 1e-14, 1e-10, 1e-8, 1e-6, 1e-4, 0.01, 0.5, 0.7})
      for (const double c : critical_cosines(eta, k)) {
        if (!(c > 0)) continue;
        const double f = test::value_of(term, {eta, k}, {c, c, 1, c, 0});
        EXPECT_LT(relative_error(f, fresnel(eta, k, c)), 1e-13)
            << eta << " " << k << " " << c << ": " << f;
      }
}

// ---- GTR against Burley -------------------------------------------------------------------------

/// N / t^γ with Burley's normalisation as printed, and its limits.
Wide burley(const Wide& alpha, const Wide& gamma, const Angles<double>& x) {
  const Wide pi = boost::math::constants::pi<Wide>(), a2 = alpha * alpha;
  const Wide t = a2 * Wide(x.noh) * x.noh + x.sin2_theta_h;
  if (alpha == 1) return 1 / pi / pow(t, gamma);
  if (gamma == 1) return (a2 - 1) / (pi * log(a2) * t);
  return (gamma - 1) * (a2 - 1) / (pi * (1 - pow(a2, 1 - gamma)) * pow(t, gamma));
}

TEST(GtrNdf, KeepsThirteenDigitsThroughTheHolesOfItsPrintedForm) {
  const auto gtr = find_term("ndf.gtr");
  double worst = 0;
  for (const double gamma : {0.5, 1 - 1e-3, 1 - 1e-9, 1.0, 1 + 1e-9, 1 + 1e-3, 1.5, 2.0, 5.0, 10.0})
    for (const double alpha : {1e-4, 1e-2, 0.3, 0.77, 0.78, 0.9, 1 - 1e-3, 1 - 1e-9, 1.0})
      for (const double tangent : {0.0, 1e-6, 1e-3, 0.1, 1.0, 30.0, 1e6}) {
        const double t2 = tangent * tangent;
        const Angles<double> x{1, 1, 1 / std::sqrt(1 + t2), 1, t2 / (1 + t2)};
        const double error =
            relative_error(test::value_of(gtr, {alpha, gamma}, x), burley(alpha, gamma, x));
        EXPECT_LT(error, 2e-14) << alpha << " " << gamma << " " << tangent;
        worst = std::max(worst, error);
      }
  RecordProperty("worst", std::to_string(worst / 2.2e-16) + " eps");
}

}  // namespace
}  // namespace gonio
