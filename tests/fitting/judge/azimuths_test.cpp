// A model that is the same all round is judged by what turns with the surface.
#include "fitting/judge/azimuths.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "brdf/model/evaluate.h"
#include "fitting/fit.h"
#include "fitting/support.h"
#include "geometry/angles.h"
#include "geometry/half_difference.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

constexpr const char* isotropic = "ggx/smith_ggx.correlated/schlick";
constexpr const char* turning = "ggx_aniso/smith_ggx_aniso.correlated/schlick";

/// Directions all round, with the surface turned beneath the light, of a table that gonio did not make.
Table turned(const BoundModel& truth, double noise) {
  Table t = test::list_of({});
  DirectionList l;
  for (const double in : {20.0, 40.0, 60.0})
    for (double light = 0; light < 180; light += 45)
      for (double out = 10; out < 80; out += 15)
        for (double phi = 0; phi < 360; phi += 30) {
          l.theta_i_deg.push_back(in);
          l.phi_i_deg.push_back(light);
          l.theta_o_deg.push_back(out);
          l.phi_o_deg.push_back(phi);
        }
  t.where = std::move(l);
  t.values.assign(1, {});
  const SampleAngles at(t);
  for (std::size_t i = 0; i < t.list()->theta_i_deg.size(); ++i)
    t.values[0].push_back(evaluate(truth, std::vector{at.frame(i)})[0][0]);
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (auto& plane : t.values)
    for (double& v : plane) v *= std::exp(noise * normal(random));
  return t;
}

FitDocument fitted(const Table& t, const char* model) {
  FitOptions o;
  o.model = model;
  o.certificate = Certify::none;
  return fit(t, o).document;
}

TEST(Azimuths, TellAModelThatIsTheSameAllRoundFromASurfaceThatIsNot) {
  const auto truth = test::bind(turning, "alpha_x=0.3,alpha_y=0.36,f0=0.05", 1);
  for (const double noise : {0.0, 0.03})
    for (const bool scattered : {false, true}) {
      const Table t = scattered ? synthesize(truth, {.layout = Layout::random, .noise = noise})
                                : turned(truth, noise);
      const auto d = fitted(t, isotropic);
      EXPECT_TRUE(d.misfit.told) << noise << scattered << d.misfit.note;
      EXPECT_GT(d.misfit.size, std::hypot(d.residuals.log_rms, noise) / 2 - noise);
      EXPECT_LE(d.misfit.size, 1.01 * d.residuals.log_rms);  // some readings stand twice
      EXPECT_NE(std::ranges::find(d.misfit.follows, "the surface's azimuth"),
                d.misfit.follows.end());
    }
}

TEST(Azimuths, AccuseNoRightModel) {
  EXPECT_FALSE(
      fitted(turned(test::bind(isotropic, "alpha=0.3,f0=0.05", 1), 0.02), isotropic).misfit.told);
  EXPECT_FALSE(
      fitted(turned(test::bind(turning, "alpha_x=0.2,alpha_y=0.4,f0=0.05", 1), 0.02), turning)
          .misfit.told);
}

TEST(Azimuths, TellAWaveAroundTheHalfVector) {
  Table t = synthesize(test::bind(isotropic, "alpha=0.3,f0=0.05", 1),
                       {.layout = Layout::random, .noise = 0.01});
  t.truth.reset();  // as if measured
  EXPECT_FALSE(fitted(t, isotropic).misfit.told);
  const SampleAngles at(t);
  for (std::size_t i = 0; i < t.size(); ++i)
    t.values[0][i] *= 1 + 0.1 * std::cos(4 * half_difference(at.directions(i)).phi_h);
  EXPECT_TRUE(fitted(t, isotropic).misfit.told);
}

TEST(Azimuths, HaveHarmonicsOfTheirOwn) {
  misfit::Unit unit{};
  unit.at = {direction(40 * degree, 20 * degree), direction(40 * degree, 80 * degree)};
  unit.functions[1] = 0.5;
  using enum misfit::Azimuth;
  const auto second = [&](misfit::Azimuth of) { return misfit::values_of({of, 2, 2}, unit); };
  EXPECT_NEAR(second(light)[0], std::cos(40 * degree), 1e-12);
  EXPECT_NEAR(second(detector)[1], std::sin(160 * degree), 1e-12);
  EXPECT_NEAR(second(between)[0], std::cos(120 * degree), 1e-12);
  const auto half = second(half_vector);
  ASSERT_EQ(half.size(), 6U);
  EXPECT_NEAR(half[1], std::sin(100 * degree), 1e-12);
  EXPECT_NEAR(half[3], half[1] / 2, 1e-12);
  EXPECT_NEAR(half[5], half[1] / 4, 1e-12);
  EXPECT_EQ(misfit::values_of({light}, unit).size(), 8U);
}

}  // namespace
}  // namespace gonio
