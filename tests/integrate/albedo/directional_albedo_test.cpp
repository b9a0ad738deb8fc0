#include "integrate/albedo/directional_albedo.h"

#include <cmath>
#include <limits>

#include "base/error.h"
#include "brdf/catalogue/registry.h"
#include "brdf/model/evaluate.h"
#include "brdf/model/roughness.h"
#include "constants.h"
#include "geometry/half_difference.h"
#include "integrate/rule/quadrature.h"

namespace gonio {
namespace {

using test::ln2;
using test::pi;
constexpr double cosines[] = {0.001, 0.01, 0.05, 0.2, 0.5, 0.8, 1};

BoundModel white(const std::string& masking, double alpha) {
  return bind_model("ggx/" + masking + "/schlick", {{"alpha", {alpha}}, {"f0", {1}}}, 1);
}
Albedo at(const BoundModel& m, double mu, double phi = 0, const Goal& goal = {}) {
  return directional_albedo(m, {&mu, 1}, phi, goal)[0];
}

/// The plain way: the whole model over directions of the light, Gauss in θ and even in φ.
std::vector<double> over_light(const BoundModel& m, double mu, double phi, int n) {
  std::vector<FrameAngles<double>> angles;
  std::vector<double> weights;
  for (const auto& node : gauss_legendre(n))
    for (int k = 0; k < 2 * n; ++k) {
      const double theta = node.x * pi / 2;
      const Direction l = direction(theta, (k + 0.5) * pi / n);
      angles.push_back(frame_angles({l, direction(std::acos(mu), phi)}));
      weights.push_back(node.weight * pi / 2 * pi / n * l.z * std::sin(theta));
    }
  std::vector<double> albedo;
  for (const auto& f : evaluate(m, angles)) {
    double sum = 0;
    for (std::size_t i = 0; i < f.size(); ++i) sum += weights[i] * f[i];
    albedo.push_back(sum);
  }
  return albedo;
}

TEST(DirectionalAlbedo, OfWhiteGgxAtAlphaOneIsTheClosedForm) {
  for (const double mu : cosines) {
    const auto correlated = at(white("smith_ggx.correlated", 1), mu, 0, {1e-10, 1'000'000});
    EXPECT_NEAR(correlated.value[0], 1 - mu * std::log(1 + 1 / mu), correlated.error) << mu;
    EXPECT_LE(correlated.error, 1e-10);
    const auto separable = at(white("smith_ggx.separable", 1), mu, 0, {1e-10, 1'000'000});
    EXPECT_NEAR(separable.value[0], 2 * (1 - ln2) / (1 + mu), separable.error) << mu;
    EXPECT_LE(separable.error, 1e-10);
  }
}

TEST(DirectionalAlbedo, OfWhiteGgxAtAlphaOneAveragesToTheClosedForm) {
  const Goal goal{1e-9, 1'000'000};
  const auto correlated = hemispherical_albedo(white("smith_ggx.correlated", 1), goal);
  EXPECT_NEAR(correlated.value[0], 4 / 3.0 * (1 - ln2), correlated.error);
  EXPECT_LE(correlated.error, 1e-9);
  const auto separable = hemispherical_albedo(white("smith_ggx.separable", 1), goal);
  EXPECT_NEAR(separable.value[0], 4 * (1 - ln2) * (1 - ln2), separable.error);
  EXPECT_LE(separable.error, 1e-9);
}

TEST(DirectionalAlbedo, OfWhiteEonIsOneAtGrazingAnglesToo) {
  for (const double r : {0.1, 1.0})
    for (const double mu : {1e-4, 1e-3, 0.02, 0.3, 0.9, 1.0}) {
      const auto a = at(bind_model("eon", {{"kd", {1}}, {"r", {r}}}, 1), mu, 0, {1e-9, 1'000'000});
      EXPECT_NEAR(a.value[0], 1, a.error + 1e-14) << r << " " << mu;
      EXPECT_LE(a.error, 1e-9);
    }
}

/// Every alpha and mu that there is, against itself a hundred thousand times finer.
TEST(DirectionalAlbedo, ItsBoundIsTrueAndWhatWasAskedFor) {
  for (const std::string masking : {"smith_ggx.correlated", "smith_ggx.separable"})
    for (double alpha = 1e-4; alpha < 1.01; alpha *= std::pow(10, 0.25))
      for (double mu = 0.001; mu < 1.01; mu *= std::pow(10, 0.2)) {
        const auto m = white(masking, std::min(alpha, 1.0));
        const double c = std::min(mu, 1.0);
        const auto truth = at(m, c, 0, {1e-13, 1'000'000});
        ASSERT_LT(truth.error, 1e-12);
        for (const double goal : {1e-2, 1e-4, 1e-6, 1e-8}) {
          const auto a = at(m, c, 0, {goal, 1'000'000});
          EXPECT_LE(std::abs(a.value[0] - truth.value[0]), a.error + truth.error)
              << masking << " " << alpha << " " << mu << " " << goal;
          EXPECT_LE(a.error, goal * 1.0001);
        }
      }
}

/// E = ∫∫ F G₂/G₁(v) over the disk of facets as v sees them [Heitz 2018, listing 1]: another substitution,
/// and no distribution in it.  Its radius is sin a: facets of the tail lie close to its rim.
double over_visible_normals(double alpha, double mu, double f0, int n) {
  const double sine = std::sqrt((1 - mu) * (1 + mu));
  const double stretched = std::hypot(alpha * sine, mu);
  const double vx = alpha * sine / stretched, vz = mu / stretched;
  const auto root = [&](double c) {
    return std::sqrt(alpha * alpha + (1 - alpha * alpha) * c * c);
  };
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      const double a = pi / 2 * (i + 0.5) / n, phi = 2 * pi * (k + 0.5) / n, r = std::sin(a);
      const double t1 = r * std::cos(phi), s = (1 + vz) / 2;
      const double t2 = (1 - s) * std::sqrt(1 - t1 * t1) + s * r * std::sin(phi);
      // T1 = (0, 1, 0), T2 = v × T1 = (−vz, 0, vx)
      const double up = std::sqrt(std::max(0.0, 1 - t1 * t1 - t2 * t2));
      double x = alpha * (up * vx - t2 * vz), y = alpha * t1, z = up * vz + t2 * vx;
      const double length = std::hypot(x, y, z);
      x /= length, y /= length, z /= length;
      const double voh = x * sine + z * mu, nol = 2 * voh * z - mu;
      if (nol <= 0) continue;
      const double g2 = 2 * nol * mu / (nol * root(mu) + mu * root(nol));
      const double g1 = 2 * mu / (mu + root(mu));
      sum += (f0 + (1 - f0) * std::pow(1 - voh, 5)) * g2 / g1 * r * std::cos(a) * pi;
    }
  return sum / n / n;
}

TEST(DirectionalAlbedo, AgreesWithTheIntegralOverVisibleNormals) {
  for (const double alpha : {1e-4, 1e-3, 0.03, 0.2, 0.7, 1.0})
    for (const double mu : cosines)
      for (const double f0 : {0.04, 1.0}) {
        auto m = white("smith_ggx.correlated", alpha);
        m.values[m.model.find("f0")->first] = f0;
        EXPECT_NEAR(at(m, mu).value[0], over_visible_normals(alpha, mu, f0, 400), 1e-4)
            << alpha << " " << mu << " " << f0;
      }
}

TEST(DirectionalAlbedo, OfLambertIsKd) {
  const auto m = bind_model("lambert", {{"kd", {0.2, 0.5, 1}}});
  for (const double mu : cosines) {
    const auto a = at(m, mu);
    EXPECT_NEAR(a.value[0], 0.2, 1e-14);
    EXPECT_NEAR(a.value[1], 0.5, 1e-14);
    EXPECT_NEAR(a.value[2], 1, 1e-14);
    EXPECT_LT(a.error, 1e-8);
  }
  EXPECT_NEAR(hemispherical_albedo(m).value[1], 0.5, 1e-13);
}

TEST(DirectionalAlbedo, OfDisneysDiffuseExceedsOne) {
  BoundModel m{compose("disney", 1), {}, {}};  // the term: the preset has lobes too
  m.values = {1, 1};                           // kd, alpha
  ASSERT_EQ(m.model.lobes.size(), 0U);
  EXPECT_NEAR(at(m, 0.02).value[0], 1.52, 0.005);
  for (const double mu : cosines) {
    const auto a = at(m, mu);
    EXPECT_NEAR(a.value[0], over_light(m, mu, 0, 60)[0], 1e-10) << mu;
    EXPECT_LE(a.error, 1e-8);
  }
}

TEST(DirectionalAlbedo, AddsLobesAndDiffuseTermsAsTheModelDoes) {
  for (const std::string spec :
       {"lambert+ggx/smith_ggx.correlated/schlick",
        "lambert.coupled+ggx/smith_ggx.correlated/schlick",
        "lambert.coupled+ggx/smith_ggx.separable/schlick+gtr/smith_ggx.correlated/schlick"}) {
    std::vector<Setting> settings{
        {"alpha", {0.6}}, {"f0", {0.1, 0.5, 0.9}}, {"kd", {0.9, 0.5, 0.1}}};
    if (spec.find("gtr") != spec.npos)
      settings.insert(settings.end(), {{"alpha_2", {0.4}}, {"gamma_2", {1}}, {"f0_2", {0.3}}});
    const auto m = bind_model(spec, settings);
    for (const double mu : {0.2, 0.7, 1.0}) {
      const auto a = at(m, mu);
      const auto plain = over_light(m, mu, 0, 150);
      const auto under = diffuse_albedo(m, {{mu}})[0];
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(a.value[c], plain[c], 2e-6) << spec << " " << mu;
        EXPECT_LT(under.value[c], a.value[c]);
      }
      EXPECT_LE(a.error, 1e-8);
    }
  }
}

/// Whatever the catalogue holds, at its own defaults; anisotropic terms at several azimuths.
TEST(DirectionalAlbedo, OfEveryTermAgreesWithTheIntegralOverDirectionsOfTheLight) {
  for (const auto& term : catalogue()) {
    const auto name = std::string(short_id(term.about->id));
    std::string spec;
    switch (role_of(term.about->id)) {
      case Role::ndf:
        spec = name + "/smith_ggx.correlated/schlick";
        break;
      case Role::masking:
        spec = "ggx/" + name + "/schlick";
        break;
      case Role::fresnel:
        spec = "ggx/smith_ggx.correlated/" + name;
        break;
      case Role::diffuse:
        spec = name + "+ggx/smith_ggx.correlated/schlick";
        break;
    }
    auto m = bind_model(spec, {}, 1);
    for (auto& p : m.model.parameters)  // as wide as the plain way can see
      if (is_alpha(p.name)) m.values[p.first] = p.name == "alpha_y" ? 0.7 : 0.4;
    for (const double mu : {0.3, 0.9})
      for (const double phi : {0.0, 0.8}) {
        if (phi > 0 && !m.model.anisotropic) continue;
        const auto a = at(m, mu, phi, {1e-6, 1'000'000});
        const auto plain = over_light(m, mu, phi, 200)[0];
        EXPECT_NEAR(a.value[0], plain, 2e-5 * std::max(1.0, plain))
            << spec << " " << mu << " " << phi;
        EXPECT_LE(a.error, 1.001e-6) << spec;
      }
  }
}

TEST(DirectionalAlbedo, FurnaceHasNoFresnelInIt) {
  const auto m = bind_model("lambert.coupled+ggx/smith_ggx.correlated/conductor",
                            {{"alpha", {0.4}}, {"eta", {0.2}}, {"k", {3}}, {"kd", {0.5}}});
  for (const double mu : {0.1, 0.9}) {
    const auto a = at(furnace(m), mu);
    for (const double v : a.value)
      EXPECT_NEAR(v, at(white("smith_ggx.correlated", 0.4), mu).value[0], 2e-8);
  }
}

/// Beckmann without its division by NoH², and no masking: E grows without bound towards the horizon.
TEST(DirectionalAlbedo, SaysThatAnAverageDiverges) {
  const auto m = bind_model("beckmann_aniso.as_written/none/schlick",
                            {{"alpha_x", {1}}, {"alpha_y", {0.5}}, {"f0", {1}}}, 1);
  const auto average = hemispherical_albedo(m, {1e-6, 20'000});
  EXPECT_EQ(average.value[0], std::numeric_limits<double>::infinity());
  EXPECT_EQ(average.error, std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isfinite(at(m, 0.02).error));
}

TEST(DirectionalAlbedo, OfAnAnisotropicModelAveragesOverAzimuthsToo) {
  const auto m = bind_model("ggx_aniso/smith_ggx_aniso.correlated/schlick",
                            {{"alpha_x", {0.3}}, {"alpha_y", {0.8}}, {"f0", {1}}}, 1);
  const auto average = hemispherical_albedo(m, {1e-6, 1'000'000});
  double sum = 0;
  for (const auto& q : gauss_legendre(24))  // μ = q²
    for (int k = 0; k < 16; ++k)
      sum += q.weight * q.x * q.x * q.x / 4 *
             at(m, q.x * q.x, (k + 0.5) * pi / 8, {1e-7, 1'000'000}).value[0];
  EXPECT_NEAR(average.value[0], sum, 2e-6);
  EXPECT_LE(average.error, 1e-6);
}

TEST(DirectionalAlbedo, RefusesCosinesOutsideItsRange) {
  for (const double mu : {0.0, -0.1, 1.0000001, std::nan("")})
    EXPECT_THROW(at(white("smith_ggx.correlated", 0.3), mu), Error) << mu;
}

}  // namespace
}  // namespace gonio
