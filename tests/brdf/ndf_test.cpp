#include <numbers>

#include "brdf/terms.h"
#include "integrate/quadrature.h"

namespace gonio {
namespace {

using test::Parameters;
using test::text;

constexpr double pi = std::numbers::pi;
constexpr double eps = std::numeric_limits<double>::epsilon();

std::vector<Parameters> grid(std::size_t ndf) {
  return test::legal_grid(catalogue()[ndf].parameters, 8);
}

/// The half vector whose θ_h has this tangent; nothing cancels at either end.
Angles<double> half_vector(double tangent) {
  const double t2 = tangent * tangent;
  return {0.5, 0.5, 1 / std::sqrt(1 + t2), 0.5, t2 / (1 + t2)};
}

/// ∫ f(θ_h) cos θ_h dω = 2π ∫ f sin²θ cos²θ dx with x = ln tan θ, in which a peak of any width is
/// as wide as any other, the integrand falls off exponentially at both ends and has no pole within
/// π/2 of the axis: the trapezoidal rule errs by e^(−π²/step), far below rounding.
double projected_integral(const std::vector<double>& f,
                          std::span<const Angles<double>> at,
                          double step) {
  double sum = 0;
  for (std::size_t i = 0; i < f.size(); ++i)
    sum += f[i] * at[i].sin2_theta_h * at[i].noh * at[i].noh;
  return 2 * pi * step * sum;
}
constexpr double step = 0.125;
std::vector<Angles<double>> trapezoid() {
  std::vector<Angles<double>> at;
  for (double x = -30; x <= 20; x += step) at.push_back(half_vector(std::exp(x)));
  return at;
}

TEST(NdfRuler, MeasuresTheProjectedHemisphere) {
  const auto at = trapezoid();
  EXPECT_NEAR(projected_integral(std::vector<double>(at.size(), 1 / pi), at, step), 1, 1e-14);
}

TEST(Ndf, ProjectedAreaIsOne) {
  const auto at = trapezoid();
  for (const auto ndf : test::terms_of(Role::ndf))
    for (const auto& p : grid(ndf)) {
      const double one = projected_integral(test::values_of(ndf, p, test::framed(at)), at, step);
      EXPECT_NEAR(one, 1, 1e-13) << catalogue()[ndf].about->id << text(p);
    }
}

TEST(Ndf, FallsFromThePeakToTheHorizon) {
  const auto at = trapezoid();
  for (const auto ndf : test::terms_of(Role::ndf))
    for (const auto& p : grid(ndf)) {
      const auto d = test::values_of(ndf, p, test::framed(at));
      for (std::size_t i = 1; i < d.size(); ++i) {
        EXPECT_GT(d[i], 0) << catalogue()[ndf].about->id << text(p);
        EXPECT_LE(d[i], d[i - 1] * (1 + 64 * eps)) << catalogue()[ndf].about->id << text(p);
      }
    }
}

TEST(Ndf, HasItsFirstDerivativesIntegralZero) {  // ∂/∂p ∫ D cos θ dω = ∂1/∂p
  const auto at = trapezoid();
  for (const auto ndf : test::terms_of(Role::ndf))
    for (const auto& p : grid(ndf)) {
      const auto d = test::derivatives_of(ndf, p, test::framed(at));
      for (std::size_t k = 0; k < p.size(); ++k)
        EXPECT_NEAR(p[k] * projected_integral(d[1 + k], at, step), 0, 1e-12)
            << catalogue()[ndf].about->id << text(p) << " by its parameter " << k;
    }
}

TEST(GgxNdf, IsItsFormula) {
  const auto ggx = find_term("ndf.ggx");
  for (const double alpha : {1e-4, 0.01, 0.3, 1.0})
    for (const double noh : {0.0, 0.2, 0.5, 0.9}) {
      const double t = noh * noh * (alpha * alpha - 1) + 1, d = alpha * alpha / (pi * t * t);
      EXPECT_NEAR(test::value_of(ggx, {alpha}, {1, 1, noh, 1, 1 - noh * noh}), d, 64 * eps * d);
    }
  EXPECT_NEAR(test::value_of(ggx, {0.25}, {1, 1, 1, 1, 0}), 1 / (pi * 0.0625), 8 * eps * 6);
}

TEST(GtrNdf, WithGammaTwoIsGgx) {
  const auto at = trapezoid();
  const auto gtr = find_term("ndf.gtr"), ggx = find_term("ndf.ggx");
  for (const double alpha : test::spread({1e-4, 1}, 16)) {
    const auto a = test::values_of(gtr, {alpha, 2}, test::framed(at)),
               b = test::values_of(ggx, {alpha}, test::framed(at));
    for (std::size_t i = 0; i < at.size(); ++i)
      EXPECT_NEAR(a[i], b[i], 2e-14 * b[i]) << alpha << " " << text(at[i]);
  }
}

TEST(GtrNdf, WithAlphaOneIsUniform) {
  const auto at = trapezoid();
  for (const double gamma : {0.5, 1.0, 2.0, 10.0})
    for (const double d : test::values_of(find_term("ndf.gtr"), {1, gamma}, test::framed(at)))
      EXPECT_NEAR(d, 1 / pi, 16 * eps);
}

TEST(GtrNdf, WithGammaOneIsBerry) {
  const auto gtr = find_term("ndf.gtr");
  for (const double alpha : {1e-3, 0.1, 0.7})
    for (const auto& at : trapezoid()) {
      const double a2 = alpha * alpha, t = a2 * at.noh * at.noh + at.sin2_theta_h;
      const double berry = (a2 - 1) / (pi * std::log(a2) * t);
      EXPECT_NEAR(test::value_of(gtr, {alpha, 1}, at), berry, 64 * eps * berry);
    }
}

TEST(GtrNdf, KeepsItsPeakInFloat) {
  const std::vector<Angles<double>> peak{half_vector(0), half_vector(1e-5), half_vector(1e-2)};
  const auto gtr = find_term("ndf.gtr");
  for (const double alpha : {1e-4, 1e-3, 1e-2, 0.5})
    for (const double gamma : {0.5, 1.0, 3.0, 10.0}) {
      const auto f = test::values_of<float>(gtr, {alpha, gamma}, test::framed(peak));
      const auto d = test::values_of<double>(gtr, {alpha, gamma}, test::framed(peak));
      for (std::size_t i = 0; i < peak.size(); ++i)
        EXPECT_NEAR(static_cast<double>(f[i]), d[i], 1e-4 * d[i] + 1e-28) << alpha << " " << gamma;
    }
}

}  // namespace
}  // namespace gonio
