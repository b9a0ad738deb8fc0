// Masking alone, and with the distribution that it belongs to.
#include <numbers>

#include "brdf/terms.h"
#include "integrate/quadrature.h"

namespace gonio {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double eps = std::numeric_limits<double>::epsilon();

double visibility(std::size_t masking, double alpha, double nol, double nov) {
  return test::value_of(masking, {alpha}, {nol, nov, 0.5, 0.5, 0.75});
}
double g2(std::size_t masking, double alpha, double nol, double nov) {
  return 4 * nol * nov * visibility(masking, alpha, nol, nov);
}
double g1(std::size_t masking, double alpha, double nov) {
  return g2(masking, alpha, 1, nov);
}

const auto separable = [] { return find_term("masking.smith_ggx.separable"); };
const auto correlated = [] { return find_term("masking.smith_ggx.correlated"); };

constexpr double cosines[] = {1e-8, 1e-3, 0.05, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 1};
constexpr double alphas[] = {1e-4, 1e-2, 0.1, 0.25, 0.5, 0.9, 1};

TEST(Masking, IsReciprocal) {
  for (const auto m : test::terms_of(Role::masking))
    for (const double alpha : alphas)
      for (const double l : cosines)
        for (const double v : cosines)
          EXPECT_EQ(visibility(m, alpha, l, v), visibility(m, alpha, v, l))
              << catalogue()[m].about->id;
}

TEST(Masking, OfBothDirectionsIsNoLessThanOfEither) {
  for (const auto m : test::terms_of(Role::masking))
    for (const double alpha : alphas)
      for (const double l : cosines)
        for (const double v : cosines) {
          const double both = g2(m, alpha, l, v);
          const double least = std::min(g1(m, alpha, l), g1(m, alpha, v));
          EXPECT_GT(both, 0);
          EXPECT_LE(both, least * (1 + 8 * eps)) << catalogue()[m].about->id << " " << alpha;
          EXPECT_LE(least, 1 + 4 * eps);
        }
}

TEST(Masking, GrowsTowardsGrazingAndWithRoughness) {
  for (const auto m : test::terms_of(Role::masking))
    for (std::size_t a = 0; a < std::size(alphas); ++a)
      for (std::size_t c = 0; c < std::size(cosines); ++c) {
        const double g = g1(m, alphas[a], cosines[c]);
        if (c > 0) {
          EXPECT_GE(g * (1 + 4 * eps), g1(m, alphas[a], cosines[c - 1]))
              << catalogue()[m].about->id;
        }
        if (a > 0) {
          EXPECT_LE(g, g1(m, alphas[a - 1], cosines[c]) * (1 + 4 * eps))
              << catalogue()[m].about->id;
        }
      }
}

TEST(Masking, VanishesAtNormalIncidence) {
  for (const auto m : test::terms_of(Role::masking))
    for (const double alpha : alphas) EXPECT_NEAR(g2(m, alpha, 1, 1), 1, 4 * eps);
}

TEST(Masking, HasAFiniteVisibilityWhereOneDirectionGrazes) {
  for (const double alpha : alphas) {
    EXPECT_NEAR(visibility(correlated(), alpha, 0.5, 0) * alpha, 1, 8 * eps);  // 1 / (2 NoL α)
    const double root = std::sqrt(alpha * alpha + (1 - alpha * alpha) / 4);
    EXPECT_NEAR(visibility(separable(), alpha, 0.5, 0) * alpha * (0.5 + root), 1, 8 * eps);
  }
}

TEST(SmithGgx, HasItsClosedValues) {
  for (const auto m : {separable(), correlated()}) {
    EXPECT_NEAR(g1(m, 0.25, 0.1), 0.543, 5e-4);
    // tan²θ = 99, α² = 1/16:  2 / (1 + √(1 + 99/16))
    EXPECT_NEAR(g1(m, 0.25, 0.1), 2 / (1 + std::sqrt(1 + 99.0 / 16)), 4 * eps);
    for (const double c : cosines) EXPECT_NEAR(g1(m, 1, c), 2 * c / (1 + c), 4 * eps);  // α = 1
  }
}

TEST(SmithGgx, SeparableIsTheProductOfItsParts) {
  for (const double alpha : alphas)
    for (const double l : cosines)
      for (const double v : cosines) {
        const double product = g1(separable(), alpha, l) * g1(separable(), alpha, v);
        EXPECT_NEAR(g2(separable(), alpha, l, v), product, 16 * eps * product);
      }
}

TEST(SmithGgx, CorrelatedIsHeitzsEquation99) {
  for (const double alpha : alphas)
    for (const double l : cosines)
      for (const double v : cosines) {
        const auto lambda = [&](double c) { return 1 / g1(separable(), alpha, c) - 1; };
        const double g = 1 / (1 + lambda(l) + lambda(v));
        EXPECT_NEAR(g2(correlated(), alpha, l, v), g, 32 * eps * g);
        EXPECT_GE(g2(correlated(), alpha, l, v) * (1 + 16 * eps), g2(separable(), alpha, l, v));
      }
}

// ---- With the distribution ----------------------------------------------------------------------

/// ∫ D(h) max(v·h, 0) dω_h, the area of the facets that v sees if none hides another.  The azimuth
/// is integrated on paper:  ∫ max(A + B cos φ, 0) dφ = 2 (A φ₀ + B sin φ₀),  φ₀ = acos(−A/B).
/// Over θ_h by Gauss in x = ln tan θ_h on both sides of the kink where A = B, in x = kink ± s² so
/// that its half-integer powers become whole ones.
double visible_area(std::size_t ndf, const test::Parameters& p, double nov) {
  const double sin_v = std::sqrt((1 - nov) * (1 + nov));
  const auto nodes = gauss_legendre(256);
  const double kink = std::log(nov / std::max(sin_v, 0.01));  // none at nov = 1
  double area = 0;
  for (const double end : {-30.0, 25.0}) {
    const double range = std::sqrt(std::abs(end - kink));
    std::vector<Angles<double>> at;
    std::vector<double> weight;
    for (const auto& node : nodes) {
      const double s = range * node.x, t = std::exp(kink + (end < kink ? -s * s : s * s));
      const double cos_h = 1 / std::sqrt(1 + t * t), sin_h = t * cos_h;
      const double a = nov * cos_h, b = sin_v * sin_h;
      const double phi = a >= b ? pi : std::acos(-a / b);
      // dω = sin θ dθ dφ,  dθ = sin θ cos θ dx,  dx = 2 s ds
      at.push_back({0.5, 0.5, cos_h, 0.5, sin_h * sin_h});
      weight.push_back(2 * (a * phi + b * std::sin(phi)) * sin_h * sin_h * cos_h * 2 * s * range *
                       node.weight);
    }
    const auto d = test::values_of(ndf, p, test::framed(at));
    for (std::size_t i = 0; i < d.size(); ++i) area += d[i] * weight[i];
  }
  return area;
}

TEST(SmithGgx, LeavesAsMuchFacetAreaAsTheSurfaceShows) {  // [Heitz 2014, Eq. 23]: G₁ ∫ = cos θ_v
  for (const auto m : {separable(), correlated()})
    for (const double alpha : alphas)
      for (const double nov : {0.05, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 1.0})
        EXPECT_NEAR(g1(m, alpha, nov) * visible_area(find_term("ndf.ggx"), {alpha}, nov) / nov, 1,
                    1e-9)
            << alpha << " " << nov;
}

TEST(SmithGgx, BelongsToGtrOfGammaTwoAndToNoOther) {
  const auto shown = [](double gamma) {
    return g1(separable(), 0.5, 0.3) * visible_area(find_term("ndf.gtr"), {0.5, gamma}, 0.3) / 0.3;
  };
  EXPECT_NEAR(shown(2), 1, 1e-9);
  EXPECT_GT(std::abs(shown(1.5) - 1), 0.01);
  EXPECT_GT(std::abs(shown(3) - 1), 0.01);
}

/// Albedo of a lobe with F = 1, by the hemisphere of light directions.
double albedo(const std::string& spec, double alpha, double mu) {
  const auto model = bind_model(spec, {{"alpha", {alpha}}, {"f0", {1}}}, 1);
  const Direction v{std::sqrt(1 - mu * mu), 0, mu};
  const auto nodes = cosine_hemisphere(256, 64);
  std::vector<Angles<double>> at;
  for (const auto& node : nodes) at.push_back(angles(DirectionPair{node.direction, v}));
  const auto f = evaluate(model, at)[0];
  double sum = 0;
  for (std::size_t i = 0; i < f.size(); ++i) sum += nodes[i].weight * f[i];
  return sum;
}

TEST(SmithGgx, HasTheAlbedoOfAlphaOneInClosedForm) {  // D = 1/π
  for (const double mu : {0.1, 0.3, 0.5, 0.8, 1.0}) {
    EXPECT_NEAR(albedo("ggx/smith_ggx.correlated/schlick", 1, mu), 1 - mu * std::log(1 + 1 / mu),
                1e-6);
    EXPECT_NEAR(albedo("ggx/smith_ggx.separable/schlick", 1, mu), 2 * (1 - std::log(2)) / (1 + mu),
                1e-6);
  }
}

TEST(SmithGgx, ReflectsNoMoreThanArrivesAndLessTheRougher) {
  for (const std::string m : {"separable", "correlated"})
    for (const double mu : {0.3, 0.7, 1.0}) {
      double smoother = 1 + 1e-4;
      for (const double alpha : {0.2, 0.4, 0.7, 1.0}) {
        const double a = albedo("ggx/smith_ggx." + m + "/schlick", alpha, mu);
        EXPECT_LT(a, smoother) << m << " " << alpha << " " << mu;
        EXPECT_GT(a, 0.3);
        smoother = a;
      }
    }
}

}  // namespace
}  // namespace gonio
