// Masking alone, and with the distribution that it belongs to.

#include "brdf/terms.h"
#include "constants.h"
#include "integrate/rule/quadrature.h"

namespace gonio {
namespace {

using test::eps;
using test::pi;

/// The same width along both axes, where a term has two.
test::Parameters of_alpha(std::size_t masking, double alpha) {
  test::Parameters p;
  for (const auto& q : catalogue()[masking].parameters)
    p.push_back(q.name.starts_with("alpha") ? alpha : q.start);
  return p;
}
/// Light over the tangent, the view at another azimuth.
DirectionPair directions(double nol, double nov, double azimuth) {
  const auto sine = [](double c) { return std::sqrt((1 - c) * (1 + c)); };
  return {{sine(nol), 0, nol}, {sine(nov) * std::cos(azimuth), sine(nov) * std::sin(azimuth), nov}};
}
double visibility(std::size_t masking, double alpha, double nol, double nov, double azimuth = 1.9) {
  return test::value_at(masking, of_alpha(masking, alpha),
                        frame_angles(directions(nol, nov, azimuth)));
}
double g2(std::size_t masking, double alpha, double nol, double nov) {
  return 4 * nol * nov * visibility(masking, alpha, nol, nov);
}
double g1(std::size_t masking, double alpha, double nov) {
  return g2(masking, alpha, 1, nov);
}

const auto separable = [] { return find_term("masking.smith_ggx.separable"); };
const auto correlated = [] { return find_term("masking.smith_ggx.correlated"); };

constexpr double masking_cosines[] = {1e-8, 1e-3, 0.05, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 1};
constexpr double masking_alphas[] = {1e-4, 1e-2, 0.1, 0.25, 0.5, 0.9, 1};

/// Smith's and what stands for it with the same monotony: G₁ from 0 at the horizon to 1 at the normal.
constexpr std::string_view smithlike[] = {"masking.smith_ggx.separable",
                                          "masking.smith_ggx.correlated",
                                          "masking.smith_ggx_aniso.separable",
                                          "masking.smith_ggx_aniso.correlated",
                                          "masking.smith_student_t.separable",
                                          "masking.smith_student_t.correlated",
                                          "masking.smith_beckmann.separable",
                                          "masking.smith_beckmann.correlated",
                                          "masking.smith_beckmann_aniso.correlated",
                                          "masking.smith_gtr.separable",
                                          "masking.smith_gtr.correlated",
                                          "masking.schlick_ggx.half_alpha",
                                          "masking.schlick_ggx.direct",
                                          "masking.schlick_ggx.half_roughness",
                                          "masking.schlick_beckmann",
                                          "masking.ue_joint",
                                          "masking.hammon",
                                          "masking.disney_remap",
                                          "masking.disney_coat"};

TEST(Masking, IsReciprocalButForTheMobilePortsClamp) {
  for (const auto m : test::terms_of(Role::masking)) {
    bool reciprocal = true;
    for (const double alpha : masking_alphas)
      for (const double l : masking_cosines)
        for (const double v : masking_cosines) {
          const auto [wi, wo] = directions(l, v, 1.9);
          const auto p = of_alpha(m, alpha);
          reciprocal = reciprocal && test::value_at(m, p, frame_angles({wi, wo})) ==
                                         test::value_at(m, p, frame_angles({wo, wi}));
        }
    EXPECT_EQ(reciprocal, catalogue()[m].about->id != "masking.ue_joint.clamped")
        << catalogue()[m].about->id;
  }
}

TEST(Masking, OfBothDirectionsIsNoMoreThanOfEither) {
  for (const auto id : smithlike)
    for (const double alpha : masking_alphas)
      for (const double l : masking_cosines)
        for (const double v : masking_cosines) {
          const auto m = find_term(id);
          const double both = g2(m, alpha, l, v);
          const double least = std::min(g1(m, alpha, l), g1(m, alpha, v));
          EXPECT_GT(both, 0);
          EXPECT_LE(both, least * (1 + 8 * eps)) << id << " " << alpha;
          EXPECT_LE(least, 1 + 4 * eps);
        }
}

TEST(Masking, GrowsTowardsGrazingAndWithRoughness) {
  for (const auto id : smithlike)
    for (std::size_t a = 0; a < std::size(masking_alphas); ++a)
      for (std::size_t c = 0; c < std::size(masking_cosines); ++c) {
        const auto m = find_term(id);
        const double g = g1(m, masking_alphas[a], masking_cosines[c]);
        if (c > 0) {
          EXPECT_GE(g * (1 + 4 * eps), g1(m, masking_alphas[a], masking_cosines[c - 1])) << id;
        }
        if (a > 0) {
          EXPECT_LE(g, g1(m, masking_alphas[a - 1], masking_cosines[c]) * (1 + 4 * eps)) << id;
        }
      }
}

TEST(Masking, VanishesAtNormalIncidence) {
  for (const auto id : smithlike)
    for (const double alpha : masking_alphas)
      EXPECT_NEAR(g2(find_term(id), alpha, 1, 1), 1, 4 * eps) << id;
}

TEST(Masking, HasAFiniteVisibilityWhereOneDirectionGrazes) {
  for (const double alpha : masking_alphas) {
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
    for (const double c : masking_cosines)
      EXPECT_NEAR(g1(m, 1, c), 2 * c / (1 + c), 4 * eps);  // α = 1
  }
}

TEST(SmithGgx, SeparableIsTheProductOfItsParts) {
  for (const double alpha : masking_alphas)
    for (const double l : masking_cosines)
      for (const double v : masking_cosines) {
        const double product = g1(separable(), alpha, l) * g1(separable(), alpha, v);
        EXPECT_NEAR(g2(separable(), alpha, l, v), product, 16 * eps * product);
      }
}

TEST(SmithGgx, CorrelatedIsHeitzsEquation99) {
  for (const double alpha : masking_alphas)
    for (const double l : masking_cosines)
      for (const double v : masking_cosines) {
        const auto lambda = [&](double c) { return 1 / g1(separable(), alpha, c) - 1; };
        const double g = 1 / (1 + lambda(l) + lambda(v));
        EXPECT_NEAR(g2(correlated(), alpha, l, v), g, 32 * eps * g);
        EXPECT_GE(g2(correlated(), alpha, l, v) * (1 + 16 * eps), g2(separable(), alpha, l, v));
      }
}

// ---- Beckmann -----------------------------------------------------------------------------------

TEST(SmithBeckmann, HasItsClosedValues) {
  const auto apart = find_term("masking.smith_beckmann.separable");
  const auto joint = find_term("masking.smith_beckmann.correlated");
  for (const double alpha : {0.1, 0.3, 1.0})
    for (const double c : {0.05, 0.1, 0.5, 0.9}) {
      const double a = c / (alpha * std::sqrt(1 - c * c));
      const double g = 2 / (1 + std::erf(a) + std::exp(-a * a) / (a * std::sqrt(pi)));
      EXPECT_NEAR(g1(apart, alpha, c), g, 8 * eps);
      EXPECT_NEAR(g1(joint, alpha, c), g, 8 * eps);
      EXPECT_NEAR(g2(apart, alpha, c, 0.4), g * g1(apart, alpha, 0.4), 16 * eps);
      EXPECT_NEAR(1 / g2(joint, alpha, c, 0.4), 1 / g + 1 / g1(joint, alpha, 0.4) - 1,
                  64 * eps / g);
    }
  // Λ → α/(2 √π c) at grazing angles
  EXPECT_NEAR(visibility(joint, 0.3, 0.5, 0) * 2 * 0.5 * 0.3, std::sqrt(pi), 8 * eps);
}

TEST(SmithBeckmannRational, IsWithinItsAuthorsBoundAndJumps) {
  const auto exact = find_term("masking.smith_beckmann.separable");
  const auto rational = find_term("masking.smith_beckmann.rational");
  double worst = 0;
  for (double c = 0.001; c < 1; c += 0.001)
    worst = std::max(worst, std::abs(g1(rational, 0.5, c) / g1(exact, 0.5, c) - 1));
  EXPECT_GT(worst, 0.002);
  EXPECT_LT(worst, 0.0035);
  const double at = 0.8 / std::sqrt(1 + 0.64);  // a = 1.6 where tan θ = 1/(1.6 α)
  EXPECT_NEAR(g1(rational, 0.5, at * (1 - 1e-9)), 11.23936 / 11.23872, 1e-8);
  EXPECT_EQ(g1(rational, 0.5, at * (1 + 1e-9)), 1);
}

// ---- Anisotropy ---------------------------------------------------------------------------------

TEST(AnisotropicSmith, IsTheIsotropicOneOfTheWidthAlongTheDirection) {
  for (const auto& [id, isotropic] :
       {std::pair{"masking.smith_ggx_aniso.separable", "masking.smith_ggx.separable"},
        {"masking.smith_ggx_aniso.correlated", "masking.smith_ggx.correlated"},
        {"masking.smith_beckmann_aniso.correlated", "masking.smith_beckmann.correlated"}}) {
    const auto aniso = find_term(id), iso = find_term(isotropic);
    for (const double azimuth : {0.0, 0.6, pi / 2, 2.5})
      for (const double c : {0.0, 0.01, 0.3, 0.8, 1.0}) {
        const double ax = 0.1, ay = 0.6;
        const double along = std::hypot(ax * std::cos(azimuth), ay * std::sin(azimuth));
        const auto [n, v] = directions(1, c, azimuth);
        const double expected = visibility(iso, along, 1, c);
        EXPECT_NEAR(test::value_at(aniso, {ax, ay}, frame_angles({n, v})), expected,
                    16 * eps * expected)
            << id << " " << azimuth << " " << c;
      }
  }
}

// ---- As shipped ---------------------------------------------------------------------------------

TEST(Schlick, HasTheFiguresOfItsSeveralK) {  // roughness 0.5, NoV 0.1
  const auto g = [](const char* id) { return g1(find_term(id), 0.25, 0.1); };
  EXPECT_NEAR(g("masking.schlick_ggx.half_alpha"), 8.0 / 17, 1e-15);  // k = 0.125: 0.470588
  EXPECT_NEAR(g("masking.schlick_ggx.direct"), 32.0 / 113, 1e-15);    // k = 0.28125: 0.283186
  EXPECT_NEAR(g("masking.schlick_ggx.half_roughness"), 4.0 / 13, 1e-15);
  EXPECT_NEAR(g("masking.schlick_beckmann"), 0.1 / (0.1 + 0.9 * 0.25 * 0.797884560802865), 1e-15);
}

TEST(Schlick, WithHalfAlphaIsSmithWhereAlphaIsOne) {
  const auto schlick = find_term("masking.schlick_ggx.half_alpha");
  for (const double c : masking_cosines)
    EXPECT_NEAR(g1(schlick, 1, c), g1(separable(), 1, c), 4 * eps);
}

TEST(UeJoint, IsHammonsFormAndExactWhereAlphaIsOne) {
  const auto ue = find_term("masking.ue_joint"), hammon = find_term("masking.hammon");
  for (const double l : masking_cosines)
    for (const double v : masking_cosines) {
      for (const double alpha : masking_alphas) {
        const double x = visibility(ue, alpha, l, v);
        EXPECT_NEAR(visibility(hammon, alpha, l, v), x, 8 * eps * x);
      }
      const double exact = visibility(correlated(), 1, l, v);
      EXPECT_NEAR(visibility(ue, 1, l, v), exact, 8 * eps * exact);
    }
}

TEST(UeJoint, OfTheMobilePortIsClampedAndLosesReciprocity) {
  const auto clamped = find_term("masking.ue_joint.clamped");
  EXPECT_EQ(visibility(clamped, 1e-4, 1e-3, 1e-3), 500);  // 0.5/0.001; unclamped 2.3e5
  EXPECT_EQ(visibility(clamped, 1e-4, 0, 1e-3), 500);
  const double nov = 0.4 + 1e-5, v = 0.5 / (0.7 * (nov * 0.75 + 0.25) + nov * (0.7 * 0.75 + 0.25));
  EXPECT_NEAR(visibility(clamped, 0.25, 0.7, 0.4), v, 8 * eps);
  const double ratio = visibility(clamped, 0.25, 0.7, 0.4) / visibility(clamped, 0.25, 0.4, 0.7);
  EXPECT_GT(std::abs(ratio - 1), 1e-6);
  EXPECT_LT(std::abs(ratio - 1), 1e-4);
}

TEST(Disney, MasksAsGgxOfARemappedOrFixedWidth) {
  const auto remap = find_term("masking.disney_remap"), coat = find_term("masking.disney_coat");
  for (const double l : masking_cosines)
    for (const double v : masking_cosines) {
      const double a = visibility(separable(), 0.5625, l, v);  // r = 0.5: (0.5 + 0.25)²
      EXPECT_NEAR(visibility(remap, 0.25, l, v), a, 8 * eps * a);
      const double b = visibility(separable(), 0.25, l, v);
      EXPECT_NEAR(visibility(coat, 0.7, l, v), b, 8 * eps * b);
    }
}

TEST(MobileMasking, HasItsHandWorkedValues) {  // roughness 0.5
  const auto at = [](const char* id, double voh) {
    return test::value_of(find_term(id), {0.25}, {0.1, 0.1, 1, voh, 0});
  };
  EXPECT_NEAR(at("masking.unity_mobile", 1), 1 / 4.0, eps);
  EXPECT_NEAR(at("masking.unity_mobile", 0.2), 1 / (4 * 0.04), 16 * eps);
  EXPECT_NEAR(at("masking.unity_mobile.urp", 1), 1 / 3.0, eps);
  EXPECT_NEAR(at("masking.unity_mobile.urp", 0.2), 1 / 0.3, 8 * eps);  // LoH² ends at 0.1
  EXPECT_EQ(at("masking.ue_mobile_simple", 0.2), 0.375);
}

// ---- From no distribution -----------------------------------------------------------------------

TEST(ClassicMasking, HasItsHandWorkedValues) {
  const auto g = [](const char* id, double nol, double nov, double azimuth) {
    return 4 * nol * nov * visibility(find_term(id), 1, nol, nov, azimuth);
  };
  // back where it came from at 60°: NoH = 0.5, VoH = 1
  EXPECT_NEAR(g("masking.cook_torrance", 0.5, 0.5, 0), 0.5, 4 * eps);
  EXPECT_NEAR(g("masking.neumann", 0.5, 0.5, 0), 0.5, 4 * eps);
  EXPECT_NEAR(g("masking.kelemen", 0.5, 0.5, 0), 0.25, 4 * eps);
  EXPECT_NEAR(g("masking.implicit", 0.5, 0.5, 0), 0.25, 4 * eps);
  EXPECT_NEAR(g("masking.none", 0.5, 0.5, 0), 1, 4 * eps);
  // as a mirror at 60°: NoH = 1, VoH = 0.5
  EXPECT_NEAR(g("masking.cook_torrance", 0.5, 0.5, pi), 1, 4 * eps);
  EXPECT_NEAR(g("masking.kelemen", 0.5, 0.5, pi), 1, 4 * eps);
  // from the normal to 60°: VoH = NoH = cos 30°, 2 NoH NoL/VoH = 1
  EXPECT_NEAR(g("masking.cook_torrance", 0.5, 1, 0), 1, 4 * eps);
  EXPECT_NEAR(g("masking.neumann", 0.5, 1, 0), 0.5, 4 * eps);
  EXPECT_NEAR(g("masking.kelemen", 0.5, 1, 0), 2.0 / 3, 4 * eps);
}

TEST(ClassicMasking, IsItsPrintedFormula) {
  const auto ct = find_term("masking.cook_torrance"), kelemen = find_term("masking.kelemen");
  for (const double l : {0.02, 0.1, 0.5, 0.9})
    for (const double v : {0.05, 0.3, 0.8})
      for (const double azimuth : {0.0, 0.7, 2.0, 3.0}) {
        const auto x = frame_angles(directions(l, v, azimuth));
        const double g = std::min({1.0, 2 * x.noh * v / x.voh, 2 * x.noh * l / x.voh});
        EXPECT_NEAR(4 * l * v * visibility(ct, 1, l, v, azimuth), g, 8 * eps * g);
        EXPECT_NEAR(visibility(kelemen, 1, l, v, azimuth), 1 / (4 * x.voh * x.voh),
                    8 * eps / (x.voh * x.voh));
        EXPECT_LE(4 * l * v * visibility(kelemen, 1, l, v, azimuth), x.noh * x.noh * (1 + 8 * eps));
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

TEST(SmithBeckmann, LeavesAsMuchFacetAreaAsTheSurfaceShows) {
  for (const auto* m : {"masking.smith_beckmann.separable", "masking.smith_beckmann.correlated"})
    for (const double alpha : {0.05, 0.25, 0.5, 1.0})
      for (const double nov : {0.05, 0.3, 0.7, 0.99, 1.0})
        EXPECT_NEAR(g1(find_term(m), alpha, nov) *
                        visible_area(find_term("ndf.beckmann"), {alpha}, nov) / nov,
                    1, 1e-9)
            << alpha << " " << nov;
}

TEST(SmithGgx, LeavesAsMuchFacetAreaAsTheSurfaceShows) {  // [Heitz 2014, Eq. 23]: G₁ ∫ = cos θ_v
  for (const auto m : {separable(), correlated()})
    for (const double alpha : masking_alphas)
      for (const double nov : {0.05, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 1.0})
        EXPECT_NEAR(g1(m, alpha, nov) * visible_area(find_term("ndf.ggx"), {alpha}, nov) / nov, 1,
                    1e-9)
            << alpha << " " << nov;
}

TEST(SmithGtr, LeavesAsMuchFacetAreaAsTheSurfaceShows) {
  for (const auto* m : {"masking.smith_gtr.separable", "masking.smith_gtr.correlated"})
    for (const double gamma : {0.5, 0.8, 1.0, 1.4, 2.0, 2.9, 3.0, 4.5, 7.0, 10.0})
      for (const double alpha : {1e-4, 0.01, 0.25, 0.9})
        for (const double nov : {0.05, 0.3, 0.7, 0.99, 1.0}) {
          const test::Parameters p{alpha, gamma};
          const double g = 4 * nov * test::value_of(find_term(m), p, {1, nov, 0.5, 0.5, 0.75});
          EXPECT_NEAR(g * visible_area(find_term("ndf.gtr"), p, nov) / nov, 1, 5e-7)
              << test::text(p) << nov;
        }
}

TEST(SmithStudent, LeavesAsMuchFacetAreaAsTheSurfaceShows) {
  for (const auto* m : {"masking.smith_student_t.separable", "masking.smith_student_t.correlated"})
    for (const double tail : {0.0, 0.3, 0.7, 1.0})
      for (const double alpha : {0.01, 0.25, 0.9})
        for (const double nov : {0.05, 0.3, 0.7, 0.99, 1.0}) {
          const test::Parameters p{alpha, tail};
          const double g = 4 * nov * test::value_of(find_term(m), p, {1, nov, 0.5, 0.5, 0.75});
          EXPECT_NEAR(g * visible_area(find_term("ndf.student_t"), p, nov) / nov, 1, 1e-8)
              << test::text(p) << nov;
        }
}

/// Estevez and Kulla fitted Λ to what Charlie's facets show: how well is measured here.
TEST(SmithCharlie, LeavesNearlyAsMuchFacetAreaAsTheSurfaceShows) {
  double worst = 0;
  for (const double alpha : {0.1, 0.25, 0.5, 1.0})
    for (const double nov : {0.05, 0.1, 0.3, 0.5, 0.7, 0.99}) {
      const double shown = g1(find_term("masking.smith_charlie.correlated"), alpha, nov) *
                           visible_area(find_term("ndf.charlie"), {alpha}, nov) / nov;
      worst = std::max(worst, std::abs(shown - 1));
    }
  EXPECT_NEAR(worst, 0.116, 0.0005);
}

TEST(SmithCharlie, IsItsPublishedFit) {  // at α = 0 and α = 1 of the table's two columns
  const auto lambda = [](double c, bool smooth) {
    const auto l = [&](double x) {
      return smooth ? 25.3245 / (1 + 3.32435 * std::pow(x, 0.16801)) - 1.27393 * x - 4.85967
                    : 21.5473 / (1 + 3.82987 * std::pow(x, 0.19823)) - 1.97760 * x - 4.32054;
    };
    return c < 0.5 ? std::exp(l(c)) : std::exp(2 * l(0.5) - l(1 - c));
  };
  const auto m = find_term("masking.smith_charlie.correlated");
  for (const double l : {0.01, 0.3, 0.5, 0.8, 0.999})
    for (const double v : {0.02, 0.45, 0.55, 0.9}) {
      const double g = 1 / (1 + lambda(l, false) + lambda(v, false));
      EXPECT_NEAR(g2(m, 1, l, v), g, 1e-13 * g) << l << " " << v;
      const double smooth = 1 / (1 + lambda(l, true) + lambda(v, true));
      EXPECT_NEAR(g2(m, 1e-12, l, v), smooth, 1e-9 * smooth) << l << " " << v;
    }
}

/// The same of an anisotropic distribution: the azimuth by Gauss over the arc that v sees.
double visible_area(std::size_t ndf,
                    const test::Parameters& p,
                    const Direction& v,
                    std::span<const Node> outer,
                    std::span<const Node> inner) {
  const double sin_v = std::hypot(v.x, v.y), phi_v = std::atan2(v.y, v.x);
  const double kink = std::log(v.z / std::max(sin_v, 0.01));
  double area = 0;
  for (const double end : {-20.0, 20.0}) {
    const double range = std::sqrt(std::abs(end - kink));
    for (const auto& node : outer) {
      const double s = range * node.x, t = std::exp(kink + (end < kink ? -s * s : s * s));
      const double cos_h = 1 / std::sqrt(1 + t * t), sin_h = t * cos_h;
      const double a = v.z * cos_h, b = sin_v * sin_h, arc = a >= b ? pi : std::acos(-a / b);
      std::vector<test::Row> at;
      std::vector<double> weight;
      for (const auto& n : inner) {
        const double phi = arc * (2 * n.x - 1);
        at.push_back(test::framed({0.5, 0.5, cos_h, 0.5, sin_h * sin_h}));
        at.back().xoh = sin_h * std::cos(phi + phi_v);
        at.back().yoh = sin_h * std::sin(phi + phi_v);
        weight.push_back(2 * arc * n.weight * (a + b * std::cos(phi)));
      }
      const auto d = test::values_of(ndf, p, at);
      for (std::size_t i = 0; i < d.size(); ++i)
        area += d[i] * weight[i] * sin_h * sin_h * cos_h * 2 * s * range * node.weight;
    }
  }
  return area;
}

TEST(AnisotropicSmith, LeavesAsMuchFacetAreaAsTheSurfaceShows) {
  const auto outer = gauss_legendre(160), inner = gauss_legendre(96);
  for (const auto& [masking, ndf] :
       {std::pair{"masking.smith_ggx_aniso.separable", "ndf.ggx_aniso"},
        {"masking.smith_ggx_aniso.correlated", "ndf.ggx_aniso"},
        {"masking.smith_beckmann_aniso.correlated", "ndf.beckmann_aniso"}})
    for (const auto& p : {test::Parameters{0.2, 0.5}, {0.6, 0.3}, {0.4, 0.4}})
      for (const double nov : {0.1, 0.4, 0.8, 1.0})
        for (const double azimuth : {0.3, 1.2, 2.6}) {
          const auto [n, v] = directions(1, nov, azimuth);
          const double g = 4 * nov * test::value_at(find_term(masking), p, frame_angles({n, v}));
          EXPECT_NEAR(g * visible_area(find_term(ndf), p, v, outer, inner) / nov, 1, 1e-8)
              << masking << test::text(p) << nov << " " << azimuth;
        }
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
double masked_albedo(const std::string& spec, double alpha, double mu) {
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
    EXPECT_NEAR(masked_albedo("ggx/smith_ggx.correlated/schlick", 1, mu),
                1 - mu * std::log(1 + 1 / mu), 1e-6);
    EXPECT_NEAR(masked_albedo("ggx/smith_ggx.separable/schlick", 1, mu),
                2 * (1 - std::log(2)) / (1 + mu), 1e-6);
  }
}

TEST(SmithGgx, ReflectsNoMoreThanArrivesAndLessTheRougher) {
  for (const std::string m : {"separable", "correlated"})
    for (const double mu : {0.3, 0.7, 1.0}) {
      double smoother = 1 + 1e-4;
      for (const double alpha : {0.2, 0.4, 0.7, 1.0}) {
        const double a = masked_albedo("ggx/smith_ggx." + m + "/schlick", alpha, mu);
        EXPECT_LT(a, smoother) << m << " " << alpha << " " << mu;
        EXPECT_GT(a, 0.3);
        smoother = a;
      }
    }
}

}  // namespace
}  // namespace gonio
