
#include "brdf/formula/ndf_anisotropic.h"
#include "brdf/terms.h"
#include "constants.h"
#include "integrate/rule/quadrature.h"

namespace gonio {
namespace {

using test::Parameters;
using test::text;

using test::eps;
using test::pi;

/// Distributions that stand for no other: normalised ones.  Isotropic, unless told otherwise.
std::vector<std::size_t> exact(bool anisotropic = false) {
  std::vector<std::size_t> terms;
  for (const auto t : test::terms_of(Role::ndf))
    if (catalogue()[t].about->reference().empty() && catalogue()[t].anisotropic == anisotropic)
      terms.push_back(t);
  return terms;
}

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
  for (double x = -30; x <= 30; x += step) at.push_back(half_vector(std::exp(x)));
  return at;
}

TEST(NdfRuler, MeasuresTheProjectedHemisphere) {
  const auto at = trapezoid();
  EXPECT_NEAR(projected_integral(std::vector<double>(at.size(), 1 / pi), at, step), 1, 1e-14);
}

TEST(Ndf, ProjectedAreaIsOne) {
  const auto at = trapezoid();
  for (const auto ndf : exact())
    for (const auto& p : grid(ndf)) {
      const double one = projected_integral(test::values_of(ndf, p, test::framed(at)), at, step);
      EXPECT_NEAR(one, 1, 1e-13) << catalogue()[ndf].about->id << text(p);
    }
}

TEST(Ndf, HasTheSteeperSlopesTheMoreRarely) {  // D cos⁴θ_h is the density of slopes
  const auto at = trapezoid();
  for (const auto ndf : exact()) {
    if (catalogue()[ndf].id() == "ndf.charlie") continue;  // fibres stand up
    for (const auto& p : grid(ndf)) {
      const auto d = test::values_of(ndf, p, test::framed(at));
      double before = d[0];
      for (std::size_t i = 0; i < d.size(); ++i) {
        const double slopes = d[i] * square(square(at[i].noh));
        EXPECT_GE(slopes, 0) << catalogue()[ndf].about->id << text(p);
        EXPECT_LE(slopes, before * (1 + 64 * eps)) << catalogue()[ndf].about->id << text(p);
        before = slopes;
      }
    }
  }
}

TEST(BeckmannNdf,
     PeaksOffTheNormalOnceAlphaExceedsRootHalf) {  // there e^(−x/α²) (1 + x)² has a maximum
  const auto d = [](double alpha, double tangent) {
    return test::value_of(find_term("ndf.beckmann"), {alpha}, half_vector(tangent));
  };
  EXPECT_LT(d(0.7, 0.1), d(0.7, 0));
  EXPECT_GT(d(0.72, 0.1), d(0.72, 0));
  EXPECT_GT(d(1, 1), d(1, 0.99));
  EXPECT_GT(d(1, 1), d(1, 1.01));  // x = 2 α² − 1
}

TEST(Ndf, HasItsFirstDerivativesIntegralZero) {  // ∂/∂p ∫ D cos θ dω = ∂1/∂p
  const auto at = trapezoid();
  for (const auto ndf : exact())
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
  const auto gtr = find_term("ndf.gtr"), gtr1 = find_term("ndf.gtr1");
  for (const double alpha : {1e-3, 0.1, 0.7})
    for (const auto& at : trapezoid()) {
      const double a2 = alpha * alpha, t = a2 * at.noh * at.noh + at.sin2_theta_h;
      const double berry = (a2 - 1) / (pi * std::log(a2) * t);
      EXPECT_NEAR(test::value_of(gtr, {alpha, 1}, at), berry, 64 * eps * berry);
      EXPECT_NEAR(test::value_of(gtr1, {alpha}, at), berry, 64 * eps * berry);
    }
  for (const auto& at : trapezoid()) EXPECT_NEAR(test::value_of(gtr1, {1}, at), 1 / pi, 4 * eps);
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

// ---- Blinn–Phong and Beckmann -------------------------------------------------------------------

TEST(BlinnPhongNdf, IsItsFormula) {
  const auto ndf = find_term("ndf.blinn_phong");
  for (const double alpha : {0.05, 0.3, 1.0})
    for (const double noh : {0.1, 0.5, 0.9, 1.0}) {
      const double p = 2 / (alpha * alpha) - 2, d = (p + 2) / (2 * pi) * std::pow(noh, p);
      EXPECT_NEAR(test::value_of(ndf, {alpha}, {1, 1, noh, 1, 1 - noh * noh}), d, 1e-12 * d);
    }
}

TEST(BeckmannNdf, IsItsFormula) {
  const auto ndf = find_term("ndf.beckmann");
  for (const double alpha : {0.1, 0.3, 1.0})
    for (const double noh : {0.2, 0.5, 0.9, 1.0}) {
      const double n2 = noh * noh, a2 = alpha * alpha;
      const double d = std::exp((n2 - 1) / (a2 * n2)) / (pi * a2 * n2 * n2);
      EXPECT_NEAR(test::value_of(ndf, {alpha}, {1, 1, noh, 1, 1 - noh * noh}), d, 1e-12 * d);
    }
}

TEST(BeckmannNdf, IsBlinnPhongsShapeWhereTheSurfaceIsSmooth) {  // cosᵖ θ → e^(−p tan²θ/2)
  const auto a = find_term("ndf.beckmann"), b = find_term("ndf.blinn_phong");
  for (const double alpha : {1e-4, 1e-3})
    for (const double x : {0.0, 0.5, 1.0, 2.0}) {
      const auto at = half_vector(x * alpha);
      const double d = test::value_of(a, {alpha}, at);
      EXPECT_NEAR(test::value_of(b, {alpha}, at), d, 10 * alpha * alpha * d);
    }
}

/// Σ over slopes along x: ∫ p² D(h) cos⁴θ_h dp dq, the variance of a slope, up to |tan θ_h| = most.
double slope_variance(std::size_t ndf, double alpha, double most) {
  double sum = 0;
  for (double x = -30; x <= std::log(most); x += step) {
    const double t = std::exp(x);
    const auto at = half_vector(t);
    sum += test::value_of(ndf, {alpha}, at) * std::pow(at.noh, 4) * t * t * t * t;
  }
  return pi * step * sum;
}

TEST(Ndf, AlphaIsRootTwoStandardDeviationsOfBeckmannsSlopesAndNoneOfGgxs) {
  for (const double alpha : {0.1, 0.5}) {
    EXPECT_NEAR(slope_variance(find_term("ndf.beckmann"), alpha, 1e3), alpha * alpha / 2, 1e-12);
    const auto ggx = find_term("ndf.ggx");  // grows by α² ln 10 a decade for ever
    EXPECT_NEAR(slope_variance(ggx, alpha, 1e6) - slope_variance(ggx, alpha, 1e4),
                alpha * alpha * std::log(100), 0.02 * alpha * alpha);
  }
}

// ---- GGX by way of its slopes -------------------------------------------------------------------

TEST(GgxNdf, IsTheDensityOfItsSlopesOverTheFourthPowerOfTheCosine) {
  for (const double alpha : {1e-3, 0.1, 0.5, 1.0})
    for (const double p : {0.0, 0.03, 0.4, 2.0})
      for (const double q : {0.0, 0.1, 1.0, 50.0}) {
        const double n = 1 / std::sqrt(p * p + q * q + 1), a2 = alpha * alpha;
        const double density = a2 / (pi * std::pow(p * p + q * q + a2, 2)),
                     d = density / (n * n * n * n);
        const Angles<double> at{1, 1, n, 1, (p * p + q * q) * n * n};
        EXPECT_NEAR(test::value_of(find_term("ndf.ggx"), {alpha}, at), d, 32 * eps * d);
      }
}

TEST(GgxNdf, HasNoCauchyDensityAlongAnAxisAndSeed000PrintsNone) {
  const auto nodes = gauss_legendre(64);
  for (const double scale : {0.1, 0.5, 2.0}) {
    const double s2 = scale * scale, x = 0.7 * scale, w = std::sqrt(s2 + x * x);
    double cauchy = 0, printed = 0, marginal = 0;
    for (const auto& node : nodes) {  // over all x = γ tan u, and over all q = w tan u
      const double u = pi * (node.x - 0.5), t = std::tan(u), dt = pi * node.weight * (1 + t * t);
      cauchy += scale / (pi * (s2 + s2 * t * t)) * scale * dt;
      printed += s2 / (pi * (s2 + s2 * t * t)) * scale * dt;
      marginal += s2 / (pi * square(w * w * (1 + t * t))) * w * dt;
    }
    EXPECT_NEAR(cauchy, 1, 1e-12);
    EXPECT_NEAR(printed, scale, 1e-12);                             // γ² stands where γ belongs
    EXPECT_NEAR(marginal, s2 / (2 * w * w * w), 1e-12 * marginal);  // γ/(π w²) if it were Cauchy's
  }
}

// ---- As shipped ---------------------------------------------------------------------------------

double projected_area(std::string_view id, const Parameters& p) {
  const auto at = trapezoid();
  return projected_integral(test::values_of(find_term(id), p, test::framed(at)), at, step);
}

TEST(GtrAsWritten, IsNormalisedAtGammaTwoAlone) {
  for (const double alpha : {0.05, 0.25, 0.7}) {
    const double a2 = alpha * alpha;
    EXPECT_NEAR(projected_area("ndf.gtr.as_written", {alpha, 2}), 1, 1e-9);
    EXPECT_NEAR(projected_area("ndf.gtr.as_written", {alpha, 1}), a2 * std::log(1 / a2) / (1 - a2),
                1e-9);
    // ∫ c dc/(1 + (α² − 1) c²)³ = (α⁻⁴ − 1)/(4 (1 − α²))
    EXPECT_NEAR(projected_area("ndf.gtr.as_written", {alpha, 3}) /
                    (a2 * (1 / (a2 * a2) - 1) / (2 * (1 - a2))),
                1, 1e-9);
  }
}

TEST(GgxMobile, IsPiTimesGgxUpToItsClamp) {
  const auto ggx = find_term("ndf.ggx");
  for (const auto* id : {"ndf.ggx.ue_mobile", "ndf.ggx.mobile", "ndf.ggx.mobile.cross"}) {
    const auto shipped = find_term(id);
    EXPECT_EQ(catalogue()[shipped].about->named_for, "ndf.ggx");
    for (const double alpha : {1e-3, 0.022, 0.023, 0.1, 0.5, 1.0})
      for (const double tangent : {0.0, 1e-3, 0.01, 0.1, 1.0, 10.0}) {
        const auto at = half_vector(tangent);
        const double d = std::min(pi * test::value_of(ggx, {alpha}, at), 2048.0);
        EXPECT_NEAR(test::value_of(shipped, {alpha}, at), d, 1e-8 * d) << id << alpha << text(at);
      }
  }
  // The peak 1/α² exceeds the clamp below α = 1/√2048, a roughness of 0.149.
  EXPECT_EQ(test::value_of(find_term("ndf.ggx.mobile"), {0.022}, half_vector(0)), 2048);
  EXPECT_LT(test::value_of(find_term("ndf.ggx.mobile"), {0.0221}, half_vector(0)), 2048);
}

TEST(GgxMobile, KeepsItsTailInFloatByTheCrossProductAlone) {
  const std::vector<Angles<double>> at{half_vector(1e-4)};
  const auto error = [&](const char* id) {
    const double f = test::values_of<float>(find_term(id), {0.03}, test::framed(at))[0];
    return std::abs(f / test::value_of(find_term(id), {0.03}, at[0]) - 1);
  };
  EXPECT_LT(error("ndf.ggx.mobile.cross"), 1e-6);
  EXPECT_GT(error("ndf.ggx.mobile"), 1e-5);
}

// ---- Anisotropy ---------------------------------------------------------------------------------

test::Row half_vector(double tangent, double azimuth) {
  test::Row row = test::framed(half_vector(tangent));
  const double sine = std::sqrt(row.sin2_theta_h);
  row.xoh = sine * std::cos(azimuth);
  row.yoh = sine * std::sin(azimuth);
  return row;
}

/// ∫ D cos θ_h dω over slopes up to e^most, by the trapezoidal rule in azimuth and in ln tan θ_h.
double projected_area(std::size_t ndf, const Parameters& p, int azimuths, double most) {
  std::vector<double> sum;
  for (int k = 0; k < azimuths; ++k) {
    std::vector<test::Row> rows;
    std::vector<Angles<double>> at;
    for (double x = -30; x <= most; x += step) {
      rows.push_back(half_vector(std::exp(x), 2 * pi * (k + 0.5) / azimuths));
      at.push_back(rows.back());
    }
    sum.push_back(projected_integral(test::values_of(ndf, p, rows), at, step));
  }
  double mean = 0;
  for (const double s : sum) mean += s / azimuths;
  return mean;
}

TEST(AnisotropicNdf, ProjectedAreaIsOne) {
  for (const auto ndf : exact(true))
    for (const double ax : {1e-4, 0.02, 0.3, 1.0})
      for (const double ratio : {1.0, 0.5, 0.05}) {
        const int azimuths = ratio < 0.1 ? 1024 : 64;
        for (const double gamma : {2.0, 2.5, 10.0, 100.0}) {
          Parameters p{ax, std::max(ax * ratio, 1e-4)};
          if (catalogue()[ndf].parameters.size() == 3) p.push_back(gamma);
          EXPECT_NEAR(projected_area(ndf, p, azimuths, 20), 1, 1e-12)
              << catalogue()[ndf].about->id << text(p);
        }
      }
}

TEST(AnisotropicNdf, IsTheIsotropicOneWhereItsWidthsAreEqual) {
  for (const auto& [id, isotropic] :
       {std::pair{"ndf.ggx_aniso", "ndf.ggx"}, {"ndf.beckmann_aniso", "ndf.beckmann"}})
    for (const double alpha : {1e-4, 0.1, 0.7})
      for (const double x : {0.0, 0.5, 3.0})
        for (const double azimuth : {0.0, 1.0, 4.0}) {
          const auto at = half_vector(x * alpha, azimuth);
          const double d = test::value_at(find_term(isotropic), {alpha}, at);
          EXPECT_NEAR(test::value_at(find_term(id), {alpha, alpha}, at), d, 64 * eps * d) << id;
        }
}

TEST(AnisotropicNdf, HasItsWidthsAlongItsAxes) {
  for (const auto& [id, isotropic] :
       {std::pair{"ndf.ggx_aniso", "ndf.ggx"}, {"ndf.beckmann_aniso", "ndf.beckmann"}})
    for (const double x : {0.0, 0.5, 3.0}) {
      const double ax = 0.4, ay = 0.1;
      const auto along = [&](double azimuth, double width) {
        const auto at = half_vector(x * width, azimuth);
        const double slopes = test::value_at(find_term(isotropic), {width}, at) * width * width;
        EXPECT_NEAR(test::value_at(find_term(id), {ax, ay}, at) * ax * ay, slopes, 1e-13 * slopes);
      };
      along(0, ax);
      along(pi / 2, ay);
    }
}

TEST(BeckmannAnisoAsWritten, DivergesAtTheHorizonTheMoreTheRougherItIs) {
  const auto ndf = find_term("ndf.beckmann_aniso.as_written");
  const auto area = [&](double alpha, double most) {
    return projected_area(ndf, {alpha, alpha}, 4, most);
  };
  for (const double alpha : {0.3, 0.5, 1.0})  // as NoH⁻², a hundredfold for every decade of slopes
    EXPECT_GT(area(alpha, std::log(1e4)) / area(alpha, std::log(1e3)), 50) << alpha;
  EXPECT_GT(area(0.3, std::log(1e3)), 100);
  EXPECT_NEAR(area(0.1, std::log(1e3)), 1.0206, 1e-4);  // smooth surfaces hide it
  // and near the peak it is Beckmann
  const auto at = half_vector(1e-3, 0.4);
  const double d = test::value_at(find_term("ndf.beckmann_aniso"), {0.2, 0.5}, at);
  EXPECT_NEAR(test::value_at(ndf, {0.2, 0.5}, at), d, 1e-9 * d);
}

// ---- Any shape ----------------------------------------------------------------------------------

template <Real T>
struct GgxShape {
  T log_g(const T& x2) const { return -2 * log(1 + x2) - log(pi_); }
  T pi_ = gonio::pi<T>();
};
template <Real T>
struct BeckmannShape {
  T log_g(const T& x2) const { return -x2 - log(pi_); }
  T pi_ = gonio::pi<T>();
};

template <template <class> class Shape>
void expect_makes(const char* isotropic, const char* anisotropic) {
  for (const double alpha : {1e-3, 0.2, 1.0})
    for (const double tangent : {0.0, 1e-4, 0.1, 1.0, 30.0})
      for (const double azimuth : {0.0, 0.8, 2.0}) {
        const auto at = half_vector(tangent, azimuth);
        const double a = test::value_at(find_term(isotropic), {alpha}, at);
        const ShapeInvariant<Shape, double> iso({}, alpha), aniso({}, alpha, alpha / 5);
        EXPECT_NEAR(iso(static_cast<const Angles<double>&>(at)), a, 1e-13 * a) << isotropic;
        EXPECT_NEAR(iso(at), a, 1e-12 * a) << isotropic;
        const double b = test::value_at(find_term(anisotropic), {alpha, alpha / 5}, at);
        EXPECT_NEAR(aniso(at), b, 1e-12 * b) << anisotropic;
      }
}

TEST(ShapeInvariant, MakesGgxAndBeckmannOfTheirShapes) {
  expect_makes<GgxShape>("ndf.ggx", "ndf.ggx_aniso");
  expect_makes<BeckmannShape>("ndf.beckmann", "ndf.beckmann_aniso");
}

TEST(ShapeInvariant, WithStudentsTIsGgxAtTwoAndBeckmannInTheLimit) {
  const auto student = find_term("ndf.shape_invariant");
  for (const double tangent : {0.0, 0.05, 0.3, 2.0})
    for (const double azimuth : {0.0, 0.8}) {
      const auto at = half_vector(tangent, azimuth);
      const double ggx = test::value_at(find_term("ndf.ggx_aniso"), {0.3, 0.5}, at);
      EXPECT_NEAR(test::value_at(student, {0.3, 0.5, 2}, at), ggx, 1e-13 * ggx);
      if (tangent > 1) continue;
      const double beckmann = test::value_at(find_term("ndf.beckmann_aniso"), {0.3, 0.5}, at);
      EXPECT_NEAR(test::value_at(student, {0.3, 0.5, 100}, at), beckmann, 0.02 * beckmann);
    }
}

TEST(StudentNdf, IsGgxAndBeckmannAtItsEndsAndTheShapeInvariantOneBetween) {
  const auto student = find_term("ndf.student_t");
  for (const double alpha : {1e-4, 0.05, 0.5, 1.0})
    for (const double x : {0.0, 1e-3, 0.3, 1.0, 2.5, 20.0}) {
      const auto at = half_vector(x * alpha, 0);
      const double ggx = test::value_at(find_term("ndf.ggx"), {alpha}, at);
      EXPECT_NEAR(test::value_at(student, {alpha, 1}, at), ggx, 1e-13 * ggx);
      const double beckmann = test::value_at(find_term("ndf.beckmann"), {alpha}, at);
      EXPECT_NEAR(test::value_at(student, {alpha, 0}, at), beckmann, 1e-12 * beckmann);
      for (const double tail : {0.05, 0.3, 0.8, 1.5}) {
        const double d =
            test::value_at(find_term("ndf.shape_invariant"), {alpha, alpha, 1 + 1 / tail}, at);
        EXPECT_NEAR(test::value_at(student, {alpha, tail}, at), d, 1e-12 * d) << tail;
      }
    }
}

TEST(CharlieNdf, IsItsFormulaAndLeavesTheNormalDark) {
  const auto charlie = find_term("ndf.charlie");
  for (const double alpha : {0.05, 0.3, 1.0})
    for (const double sine : {0.1, 0.5, 0.9, 1.0}) {
      const double d = (2 + 1 / alpha) / (2 * pi) * std::pow(sine, 1 / alpha);
      const double cosine = std::sqrt(1 - sine * sine);
      EXPECT_NEAR(test::value_of(charlie, {alpha}, {1, 1, cosine, 1, sine * sine}), d, 1e-13 * d);
    }
  EXPECT_LT(test::value_of(charlie, {0.3}, {1, 1, 1, 1, 0}), 1e-100);
}

/// How far D cos⁴θ_h α² is from a function of tan θ_h/α alone, at 1 over the widths 0.1 and 0.8.
double shape_changes(std::string_view id, Parameters p) {
  const auto g = [&](double alpha, double x) {
    p[0] = alpha;
    const auto at = half_vector(x * alpha);
    return test::value_of(find_term(id), p, at) * std::pow(at.noh, 4) * alpha * alpha;
  };
  double worst = 0;
  for (const double x : {0.0, 0.3, 1.0, 3.0})
    worst = std::max(worst, std::abs(g(0.8, x) / g(0.1, x) - 1));
  return worst;
}

TEST(ShapeInvariant, AreGgxAndBeckmannButNeitherGtrNorBlinnPhong) {
  EXPECT_LT(shape_changes("ndf.ggx", {0}), 1e-13);
  EXPECT_LT(shape_changes("ndf.beckmann", {0}), 1e-13);
  EXPECT_LT(shape_changes("ndf.gtr", {0, 2}), 1e-13);
  EXPECT_GT(shape_changes("ndf.gtr", {0, 1}), 0.5);
  EXPECT_GT(shape_changes("ndf.gtr", {0, 3}), 0.5);
  EXPECT_GT(shape_changes("ndf.blinn_phong", {0}), 0.5);
}

}  // namespace
}  // namespace gonio
