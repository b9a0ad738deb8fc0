// The albedo of a table is that of the surface it was taken from, within the error that is said.
#include "table/health/directional_albedo.h"

#include <array>
#include <cmath>
#include <random>

#include "brdf/model/evaluate.h"
#include "table/example.h"
#include "table/format/utia.h"
#include "tables.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

/// A metal that reflects all light but what masking takes, on MERL's grid.
Table white_metal(double alpha) {
  const auto metal =
      bind_model("ggx/smith_ggx.correlated/schlick", {{"alpha", {alpha}}, {"f0", {1}}}, 1);
  Table t;
  t.format = "merl";
  t.channels = {"f"};
  t.where = merl_grid(Bins::centre);
  test::put_values(t, metal);
  return t;
}

TEST(AlbedoOfATable, IsThatOfTheSurfaceHoweverNarrowItsHighlight) {
  for (const double alpha : {0.05, 0.02}) {
    const Table t = white_metal(alpha);
    for (const double theta_i : {0.0, 30.0, 60.0}) {
      const auto a = directional_albedo(t, theta_i);
      EXPECT_NEAR(a.albedo[0], 1, 0.02) << alpha << " " << theta_i;
      EXPECT_LT(a.error, 0.025) << alpha << " " << theta_i;
    }
  }
}

TEST(AlbedoOfATable, IsWithinItsErrorWhereSamplesAreFurtherApartThanTheHighlightIsWide) {
  Table t;
  t.format = "utia";
  t.channels = {"f"};
  t.where = utia_directions();
  test::put_values(t, bind_model("lambert+ggx/smith_ggx.correlated/schlick",
                                 {{"alpha", {0.05}}, {"f0", {0.04}}, {"kd", {0.3}}}, 1));
  interpolate_utia(t);
  // by `gonio albedo`
  for (const auto& [theta_i, truth] : {std::pair(0.0, 0.3399), {45.0, 0.3425}, {75.0, 0.5342}}) {
    const auto a = directional_albedo(t, theta_i);
    EXPECT_NEAR(a.albedo[0], truth, a.error) << theta_i;
  }
}

/// The model in rings around the normal, every `step` degrees, with directions every `phi_step` degrees in each; one at the
/// normal, or as many.
Table rings_of(const BoundModel& model,
               const std::vector<double>& theta_i_deg,
               double step,
               double first_phi,
               bool one_at_normal,
               double phi_step = 10) {
  DirectionList l;
  for (const double in : theta_i_deg)
    for (double out = 0; out < 88; out += step)
      for (double phi = first_phi; phi < (out > 0 || !one_at_normal ? 360 : 1); phi += phi_step) {
        l.theta_i_deg.push_back(in);
        l.phi_i_deg.push_back(0);
        l.theta_o_deg.push_back(out);
        l.phi_o_deg.push_back(phi);
      }
  Table t;
  t.format = "csv";
  t.channels = {"f"};
  t.where = std::move(l);
  test::put_values(t, model);
  return t;
}
/// A metal in rings around the normal, every `step` degrees.
Table rings(double alpha, double step) {
  return rings_of(
      bind_model("ggx/smith_ggx.correlated/schlick", {{"alpha", {alpha}}, {"f0", {1}}}, 1), {0, 20},
      step, 0, true);
}

TEST(AlbedoOfATable, IsSaidOfAListOnlyAsFarAsItsRingsShowTheHighlight) {
  for (const double alpha : {0.01, 0.02, 0.05, 0.1, 0.3})
    for (const double step : {2.0, 5.0, 10.0})
      for (const auto& a : directional_albedo(rings(alpha, step))) {
        const double truth = alpha < 0.2 ? 0.99 : 0.88;  // by `gonio albedo`, to 0.01
        EXPECT_NEAR(a.albedo[0], truth, a.error + 0.02) << alpha << " " << step;
      }
  EXPECT_TRUE(directional_albedo(rings(0.02, 5)).empty())
      << "a hundredth of the hemisphere decides";
  EXPECT_EQ(directional_albedo(rings(0.3, 5)).size(), 2U);
}

/// Directions every 10° whose azimuths pass the mirror direction by.
Table beside_the_mirror(const BoundModel& model, double first_phi = 5) {
  return rings_of(model, {10, 30, 50, 70}, 10, first_phi, false);
}
TableAlbedo albedo_with_reasons(const Table& t) {
  return albedo_of_table(t, 15, find_peak(t, t.bins()));
}

TEST(AlbedoOfATable, OfARidgeThatFewSamplesMeetIsWithinItsErrorOrNone) {
  std::size_t known = 0;
  const auto expect = [&](double x, double y, double truth, double step, double tangent) {
    Table t = rings_of(bind_model("lambert", {}, 1), {0}, step, 0, true);
    const BoundModel brushed =
        bind_model("ggx_aniso/smith_ggx_aniso.correlated/schlick",
                   {{"alpha_x", {x}}, {"alpha_y", {y}}, {"f0", {0.9}}, {"tangent", {tangent}}}, 1);
    const SampleAngles at(t);
    std::vector<FrameAngles<double>> frames;
    for (std::size_t i = 0; i < t.size(); ++i) frames.push_back(at.frame(i));
    const auto f = evaluate(brushed, frames);
    t.values[0].assign(f[0].begin(), f[0].end());
    for (const auto& a : directional_albedo(t)) {
      EXPECT_NEAR(a.albedo[0], truth, 1.1 * a.error)
          << x << " " << y << " " << step << " " << tangent;
      ++known;
    }
  };
  for (const double step : {5.0, 10.0})
    for (const double tangent : {0.0, 45.0, 90.0}) {  // truths by `gonio albedo`
      expect(0.3, 0.05, 0.8406, step, tangent);
      expect(0.5, 0.05, 0.7396, step, tangent);
      expect(0.3, 0.1, 0.8368, step, tangent);
      expect(0.5, 0.2, 0.7220, step, tangent);
    }
  EXPECT_GE(known, 10U);
}

TEST(AlbedoOfATable, OfAGridIsNoneWhereItsErrorIsMoreThanItself) {
  Table t;
  t.format = "utia";
  t.channels = {"f"};
  t.where = utia_directions();
  test::put_values(
      t, bind_model("ggx/smith_ggx.correlated/schlick", {{"alpha", {0.01}}, {"f0", {1}}}, 1));
  interpolate_utia(t);
  const auto found = albedo_with_reasons(t);
  for (const auto& a : found.known) EXPECT_FALSE(a.albedo[0] > 1.5) << a.theta_i_deg;
  ASSERT_EQ(found.left_out.size(), 1U);
  EXPECT_NE(found.left_out[0].find("too far apart for the highlight"), std::string::npos);
}

TEST(AlbedoOfATable, IsNoneWhereAHighlightMayHideBetweenTheSamples) {
  const char* const beckmann = "lambert+beckmann/smith_beckmann.correlated/schlick";
  const auto shiny = [&](double alpha) {
    return bind_model(beckmann, {{"alpha", {alpha}}, {"f0", {0.3}}, {"kd", {0.1}}}, 1);
  };
  const auto hidden = albedo_with_reasons(beside_the_mirror(shiny(0.01)));
  EXPECT_TRUE(hidden.known.empty());
  EXPECT_FALSE(hidden.at_least.empty());
  ASSERT_FALSE(hidden.left_out.empty());
  EXPECT_NE(hidden.left_out.back().find("a highlight narrower than"), std::string::npos);
  EXPECT_FALSE(albedo_with_reasons(beside_the_mirror(shiny(0.3))).known.empty())
      << "a highlight that is resolved hides none";
  const auto matte = bind_model("lambert", {{"kd", {0.5}}}, 1);
  EXPECT_TRUE(albedo_with_reasons(beside_the_mirror(matte)).known.empty());
  EXPECT_EQ(albedo_with_reasons(beside_the_mirror(matte, 0)).known.size(), 4u)
      << "samples in the mirror direction show that there is none";
}

TEST(AlbedoOfATable, SaysOfEachIncidentAngleWithoutOneWhy) {
  DirectionList in_plane;
  for (double out = 0; out < 90; out += 5) {
    in_plane.theta_i_deg.push_back(30);
    in_plane.phi_i_deg.push_back(0);
    in_plane.theta_o_deg.push_back(out);
    in_plane.phi_o_deg.push_back(180);
  }
  Table t;
  t.format = "csv";
  t.channels = {"f"};
  t.where = std::move(in_plane);
  test::put_values(t, bind_model("lambert", {{"kd", {0.5}}}, 1));
  const auto found = albedo_with_reasons(t);
  EXPECT_TRUE(found.known.empty());
  ASSERT_EQ(found.left_out.size(), 1u);
  EXPECT_EQ(found.left_out[0], "30°: the samples do not cover the hemisphere");
}

TEST(AlbedoOfATable, OfAListTakesNoiseBelowZeroAndNoMarks) {
  const Table clean = rings(0.3, 5);
  const auto whole = directional_albedo(clean);
  Table marked = clean, noisy = clean;
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (std::size_t i = 0; i < clean.size(); ++i) {
    if (i % 20 == 7) marked.values[0][i] = -999;
    noisy.values[0][i] += 0.02 * normal(random);
  }
  for (const Table& t : {marked, noisy}) {
    const auto found = directional_albedo(t);
    ASSERT_EQ(found.size(), 2U);
    for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(found[k].albedo[0], whole[k].albedo[0], 0.03);
  }
}

/// ∫ f cos θ_o dω_o of the model itself, over half vectors that lie densest at the highlight.
double albedo_of(const BoundModel& model, double theta_i_deg) {
  constexpr int radii = 600, rays = 128;
  const Direction wi = direction(theta_i_deg * degree, 0);
  std::vector<Angles<double>> at;
  std::vector<double> weight;
  for (int j = 0; j < rays; ++j)
    for (int i = 0; i < radii; ++i) {
      const double x = (i + 0.5) / radii, psi = 2 * M_PI * (j + 0.5) / rays,
                   theta = M_PI / 2 * x * x * x;
      const Direction h = direction(theta, psi);
      const double voh = dot(wi, h);
      const Direction wo{2 * voh * h.x - wi.x, 2 * voh * h.y - wi.y, 2 * voh * h.z - wi.z};
      if (!(voh > 0 && wo.z > 0)) continue;
      at.push_back(angles(DirectionPair{wi, wo}));
      weight.push_back(4 * voh * wo.z * std::sin(theta) * M_PI / 2 * 3 * x * x / radii * 2 * M_PI /
                       rays);
    }
  const auto f = evaluate(model, at);
  double sum = 0;
  for (std::size_t k = 0; k < weight.size(); ++k) sum += weight[k] * f[0][k];
  return sum;
}

TEST(AlbedoOfATable, IsWithinItsErrorOfTheModelsOnGridsAndRings) {
  const char* const ggx = "lambert+ggx/smith_ggx.correlated/schlick";
  const std::pair<const char*, std::vector<Setting>> models[] = {
      {"eon", {{"kd", {0.6}}, {"r", {0.8}}}},
      {ggx, {{"alpha", {0.05}}, {"f0", {0.04}}, {"kd", {0.3}}}},
      {ggx, {{"alpha", {0.2}}, {"f0", {0.04}}, {"kd", {0.3}}}},
      {ggx, {{"alpha", {0.4}}, {"f0", {0.9}}, {"kd", {0}}}},
      {ggx, {{"alpha", {0.8}}, {"f0", {0.9}}, {"kd", {0}}}},
      {"lambert+gtr/smith_ggx.correlated/schlick",
       {{"alpha", {0.1}}, {"gamma", {1.2}}, {"f0", {0.3}}, {"kd", {0.05}}}},
      {"lambert+beckmann/smith_beckmann.correlated/schlick",
       {{"alpha", {0.3}}, {"f0", {0.04}}, {"kd", {0.05}}}},
      {"charlie/smith_charlie.correlated/schlick", {{"alpha", {0.4}}, {"f0", {0.5}}}}};
  for (const auto& [spec, settings] : models) {
    const BoundModel model = bind_model(spec, settings, 1);
    std::array<double, 6> truth;
    for (std::size_t k = 0; k < truth.size(); ++k)
      truth[k] = albedo_of(model, 15. * static_cast<double>(k));
    const auto expect = [&](const Table& t, const char* layout) {
      for (std::size_t k = 0; k < truth.size(); ++k) {
        const auto a = directional_albedo(t, 15. * static_cast<double>(k));
        EXPECT_NEAR(a.albedo[0], truth[k], a.error + 1e-3 * truth[k])
            << layout << " " << spec << " " << 15 * k;
        EXPECT_LT(a.error, layout == std::string("utia") ? HUGE_VAL : 0.2 * truth[k])
            << layout << " " << spec << " " << 15 * k;
      }
    };
    Table merl;
    merl.format = "merl";
    merl.channels = {"f"};
    merl.where = merl_grid(Bins::centre);
    test::put_values(merl, model);
    expect(merl, "merl");
    Table utia;
    utia.format = "utia";
    utia.channels = {"f"};
    utia.where = utia_directions();
    test::put_values(utia, model);
    interpolate_utia(utia);
    expect(utia, "utia");
  }
}

TEST(AlbedoOfATable, IsWithinItsErrorWhereAzimuthsAreFurtherApartThanZenithAngles) {
  std::size_t known = 0;
  for (const double alpha : {0.1, 0.15, 0.2, 0.3, 0.5})
    for (const double kd : {0.02, 0.1, 0.4}) {
      const BoundModel model = bind_model("lambert+ggx/smith_ggx.correlated/schlick",
                                          {{"alpha", {alpha}}, {"f0", {0.04}}, {"kd", {kd}}}, 1);
      for (const auto& [step, phi_step] : {std::pair(2.0, 15.0), {5.0, 15.0}, {5.0, 10.0}})
        for (const auto& a :
             directional_albedo(rings_of(model, {0, 30, 60}, step, 0, true, phi_step))) {
          EXPECT_NEAR(a.albedo[0], albedo_of(model, a.theta_i_deg), 1.15 * a.error)
              << alpha << " " << kd << " " << step << " × " << phi_step << " " << a.theta_i_deg;
          ++known;
        }
    }
  EXPECT_GE(known, 100U);
  // A retro edge, whose bound is the same in whatever order the samples stand.
  const BoundModel eon = bind_model("eon", {{"kd", {0.7}}, {"r", {1}}}, 1);
  for (const double phi_step : {10.0, 12.0}) {
    const Table t = rings_of(eon, {20, 55, 70}, 2, 0, true, phi_step);
    Table reversed = t;
    auto& l = std::get<DirectionList>(reversed.where);
    for (auto* column : {&l.theta_i_deg, &l.phi_i_deg, &l.theta_o_deg, &l.phi_o_deg})
      std::ranges::reverse(*column);
    std::ranges::reverse(reversed.values[0]);
    const auto all = directional_albedo(t), same = directional_albedo(reversed);
    ASSERT_EQ(all.size(), 3U);
    for (std::size_t k = 0; k < all.size(); ++k) {
      EXPECT_NEAR(all[k].albedo[0], albedo_of(eon, all[k].theta_i_deg), all[k].error);
      EXPECT_NEAR(same[k].error, all[k].error, 1e-4 * all[k].error);
    }
  }
}

}  // namespace
}  // namespace gonio
