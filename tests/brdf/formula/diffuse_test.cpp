// Diffuse terms as published, and what a white one reflects.
#include <cmath>

#include "brdf/model/evaluate.h"
#include "brdf/model/model.h"
#include "brdf/terms.h"
#include "constants.h"
#include "integrate/rule/quadrature.h"

namespace gonio {
namespace {

using test::eps;
using test::pi;

Direction direction(double cosine, double azimuth) {
  const double s = std::sqrt((1 - cosine) * (1 + cosine));
  return {s * std::cos(azimuth), s * std::sin(azimuth), cosine};
}
double value(std::string_view id, const test::Parameters& p, double nol, double nov, double phi) {
  return test::value_at(find_term(id), p, frame_angles({direction(nol, phi), direction(nov, 0)}));
}

/// The azimuth apart from a quarter turn on, and θ apart at the other direction's, for there Oren and Nayar's have kinks.
double albedo(std::string_view id, const test::Parameters& p, double nov) {
  const auto nodes = gauss_legendre(48);
  const double theta_v = std::acos(nov);
  std::vector<test::Row> at;
  std::vector<double> weight;
  for (const auto& [from, to] : {std::pair{0.0, theta_v}, {theta_v, pi / 2}})
    for (const auto& polar : nodes)
      for (const double quarter : {0.0, 0.5})
        for (const auto& turn : nodes) {
          const double theta = from + (to - from) * polar.x, phi = pi * (quarter + turn.x / 2);
          at.push_back(frame_angles({direction(std::cos(theta), phi), direction(nov, 0)}));
          weight.push_back((to - from) * polar.weight * std::sin(theta) * std::cos(theta) * pi *
                           turn.weight);
        }
  const auto f = test::values_of(find_term(id), p, at);
  double sum = 0;
  for (std::size_t i = 0; i < f.size(); ++i) sum += weight[i] * f[i];
  return sum;
}

constexpr double cosines[] = {0.02, 0.1, 0.3, 0.55, 0.8, 0.99};

/// Albedo of Fujii's form at kd = 1, and its average, as Portsmouth, Kutz and Hill print them.
double fujii_albedo(double c, double r) {
  const double a = 1 / (1 + (0.5 - 2 / (3 * pi)) * r), s = std::sqrt(1 - c * c);
  const double g = s * (std::acos(c) - s * c) + 2.0 / 3 * (s / c * (1 - s * s * s) - s);
  return a + r * a / pi * g;
}
double fujii_average(double r) {
  return (1 + (2.0 / 3 - 28 / (15 * pi)) * r) / (1 + (0.5 - 2 / (3 * pi)) * r);
}

TEST(DiffuseRuler, MeasuresAWhiteLambertian) {
  for (const double nov : cosines) EXPECT_NEAR(albedo("diffuse.lambert", {1}, nov), 1, 1e-14);
}

TEST(Diffuse, IsReciprocal) {
  for (const auto t : test::terms_of(Role::diffuse))
    for (const auto& p : test::legal_grid(catalogue()[t].parameters, 3))
      for (const double l : cosines)
        for (const double v : cosines) {
          const DirectionPair pair{direction(l, 2.1), direction(v, 0)};
          EXPECT_EQ(test::value_at(t, p, frame_angles(pair)),
                    test::value_at(t, p, frame_angles({pair.wo, pair.wi})))
              << catalogue()[t].id();
        }
}

// ---- Oren–Nayar ---------------------------------------------------------------------------------

TEST(OrenNayar, WithoutTiltIsLambert) {
  for (const auto* id : {"diffuse.oren_nayar", "diffuse.oren_nayar.fujii", "diffuse.eon"})
    for (const double l : cosines)
      for (const double phi : {0.0, 1.0, 2.0, 3.0})
        EXPECT_NEAR(value(id, {0.6, 0}, l, 0.4, phi), 0.6 / pi, eps) << id;
}

TEST(OrenNayar, IsItsQualitativeModel) {
  for (const double sigma : {0.05, 0.3, 0.8, 1.5})
    for (const double l : cosines)
      for (const double v : cosines)
        for (const double phi : {0.1, 1.2, 1.8, 3.0}) {
          const double s2 = sigma * sigma, more = std::acos(std::min(l, v)),
                       less = std::acos(std::max(l, v));
          const double a = 1 - 0.5 * s2 / (s2 + 0.33), b = 0.45 * s2 / (s2 + 0.09);
          const double f =
              0.7 / pi * (a + b * std::max(0.0, std::cos(phi)) * std::sin(more) * std::tan(less));
          EXPECT_NEAR(value("diffuse.oren_nayar", {0.7, sigma}, l, v, phi), f, 1e-13 * f);
        }
}

TEST(OrenNayar, LosesAThirdOfTheLightWhereRoughest) {
  double average = 0;
  for (const auto& node : gauss_legendre(16))
    average += 2 * node.weight * node.x * albedo("diffuse.oren_nayar", {1, pi / 2}, node.x);
  EXPECT_NEAR(average, 0.65188, 1e-5);
}

TEST(OrenNayar, OfFujiiHasTheAlbedoOfItsClosedForm) {
  for (const double r : {0.1, 0.5, 1.0})
    for (const double c : cosines)
      EXPECT_NEAR(albedo("diffuse.oren_nayar.fujii", {0.3, r}, c), 0.3 * fujii_albedo(c, r), 1e-10)
          << r << " " << c;
}

TEST(OrenNayar, OfFujiiHasNoRingWhereLightAndViewPartSides) {
  const auto step = [](std::string_view id, double parameter) {
    const auto slope = [&](double phi) {
      return (value(id, {1, parameter}, 0.5, 0.5, phi + 1e-4) -
              value(id, {1, parameter}, 0.5, 0.5, phi)) /
             1e-4;
    };
    return std::abs(slope(pi / 2) - slope(pi / 2 - 1e-4)) / std::abs(slope(pi / 2 - 1e-4));
  };
  EXPECT_NEAR(step("diffuse.oren_nayar", 0.8), 1, 1e-3);          // flat behind
  EXPECT_NEAR(step("diffuse.oren_nayar.fujii", 0.5), 0.5, 1e-3);  // falls on: t is 0.5 before
}

// ---- EON ----------------------------------------------------------------------------------------

TEST(Eon, ReflectsAllLightWhereWhite) {
  for (const double r : {0.0, 0.1, 0.5, 1.0})
    for (const double c : cosines)
      EXPECT_NEAR(albedo("diffuse.eon", {1, r}, c), 1, 1e-10) << r << " " << c;
}

TEST(Eon, HasTheAlbedoOfItsClosedForm) {
  for (const double rho : {0.2, 0.8})
    for (const double r : {0.3, 1.0})
      for (const double c : cosines) {
        const double e = fujii_albedo(c, r), average = fujii_average(r);
        const double rho_ms = rho * rho * average / (1 - rho * (1 - average));
        EXPECT_NEAR(albedo("diffuse.eon", {rho, r}, c), rho * e + rho_ms * (1 - e), 1e-10);
      }
}

TEST(Eon, IsItsListing) {
  for (const double rho : {0.1, 0.9})
    for (const double r : {0.2, 0.6, 1.0})
      for (const double l : cosines)
        for (const double v : cosines)
          for (const double phi : {0.3, 1.4, 2.0, 3.1}) {
            const double s = std::sqrt((1 - l * l) * (1 - v * v)) * std::cos(phi);
            const double single = rho / pi / (1 + (0.5 - 2 / (3 * pi)) * r) *
                                  (1 + r * (s > 0 ? s / std::max(l, v) : s));
            const double average = fujii_average(r);
            const double multiple = rho * rho * average / (1 - rho * (1 - average)) / pi *
                                    (1 - fujii_albedo(l, r)) * (1 - fujii_albedo(v, r)) /
                                    (1 - average);
            EXPECT_NEAR(value("diffuse.eon", {rho, r}, l, v, phi), single + multiple, 1e-14);
          }
}

TEST(Eon, FurtherBouncesColourItMore) {
  const double pale = value("diffuse.eon", {0.8, 1}, 0.9, 0.9, 2),
               dark = value("diffuse.eon", {0.4, 1}, 0.9, 0.9, 2);
  EXPECT_GT(pale / dark, 2.05);  // Fujii's is twice
  EXPECT_NEAR(value("diffuse.oren_nayar.fujii", {0.8, 1}, 0.9, 0.9, 2) /
                  value("diffuse.oren_nayar.fujii", {0.4, 1}, 0.9, 0.9, 2),
              2, 4 * eps);
}

// ---- As shipped ---------------------------------------------------------------------------------

TEST(Frostbite, IsItsListing) {
  for (const double r : {1e-6, 0.2, 0.7, 1.0})
    for (const double l : cosines)
      for (const double v : cosines)
        for (const double phi : {0.0, 1.0, 3.0}) {
          const auto x = frame_angles({direction(l, phi), direction(v, 0)});
          const double f90 = 0.5 * r + 2 * x.voh * x.voh * r;
          const double light = 1 + (f90 - 1) * std::pow(1 - l, 5),
                       view = 1 + (f90 - 1) * std::pow(1 - v, 5);
          const double f = 0.7 / pi * light * view * (1 - r + r / 1.51);
          EXPECT_NEAR(test::value_at(find_term("diffuse.frostbite"), {0.7, r * r}, x), f, 1e-14);
        }
}

/// Greatest albedo of a white surface, alone or below a lobe of F0 = 0.04.
double most_albedo(std::string_view id, bool below_a_lobe) {
  double most = 0;
  for (const double roughness : {0.3, 0.5, 0.7, 1.0})
    for (const double c : cosines) {
      double e = albedo(id, {1, roughness * roughness}, c);
      if (below_a_lobe) {
        const auto lobe = bind_model("ggx/smith_ggx.correlated/schlick",
                                     {{"alpha", {roughness * roughness}}, {"f0", {0.04}}}, 1);
        std::vector<Angles<double>> at;
        const auto nodes = cosine_hemisphere(256, 64);
        for (const auto& node : nodes)
          at.push_back(angles(DirectionPair{node.direction, direction(c, 0)}));
        const auto f = evaluate(lobe, at)[0];
        for (std::size_t i = 0; i < f.size(); ++i) e += nodes[i].weight * f[i];
      }
      most = std::max(most, e);
    }
  return most;
}

TEST(Frostbite, GivesBackLessThanDisneysDoes) {
  EXPECT_NEAR(most_albedo("diffuse.disney", false), 1.5188, 1e-4);
  EXPECT_NEAR(most_albedo("diffuse.frostbite", false), 1.0058, 1e-4);
  EXPECT_NEAR(most_albedo("diffuse.disney", true), 1.593, 0.01);
  EXPECT_NEAR(most_albedo("diffuse.frostbite", true), 1.0805, 0.01);
}

TEST(Hammon, IsItsListing) {
  for (const double alpha : {0.01, 0.3, 1.0})
    for (const double l : cosines)
      for (const double v : cosines)
        for (const double phi : {0.0, 1.0, 3.0}) {
          const auto x = frame_angles({direction(l, phi), direction(v, 0)});
          const double facing =
              0.5 + 0.5 * (std::sqrt((1 - l * l) * (1 - v * v)) * std::cos(phi) + l * v);
          const double rough = facing * (0.9 - 0.4 * facing) * ((0.5 + x.noh) / x.noh);
          const double smooth = 1.05 * (1 - std::pow(1 - l, 5)) * (1 - std::pow(1 - v, 5));
          const double single = (smooth + (rough - smooth) * alpha) / pi;
          EXPECT_NEAR(test::value_at(find_term("diffuse.hammon"), {0.6, alpha}, x),
                      0.6 * (single + 0.6 * 0.1159 * alpha), 1e-14);
        }
}

TEST(Hammon, LetsThroughWhatADielectricDoesNotReflectWhereSmooth) {
  // 1.05 · 20/21 of what Schlick's edges leave: 1 at the normal as the average over light from
  // everywhere
  EXPECT_NEAR(albedo("diffuse.hammon", {1, 1e-4}, 1 - 1e-9), 1.05 * 20 / 21, 1e-3);
}

}  // namespace
}  // namespace gonio
