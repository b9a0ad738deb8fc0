#include "reports/pages/spheres.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/base64.h"
#include "image/lit_sphere.h"
#include "png_pixels.h"
#include "tables.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

namespace gonio {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t size = 60;

Spheres spheres(const Table& t, const std::vector<BoundModel>& models) {
  return make_spheres(t, models, size);
}
Table whole() {
  return test::filled(test::half_difference_grid(), test::glossy());
}

/// Without the samples that a mask names.
template <class F>
Table without(Table t, const F& masked) {
  const SampleAngles at(t);
  for (std::size_t i = 0; i < t.size(); ++i)
    if (masked(at.half_difference(i)))
      for (auto& channel : t.values) channel[i] = none;
  return t;
}

TEST(Spheres, OfATableAndTheModelItWasMadeOfLookAlike) {
  const Spheres s = spheres(whole(), {test::glossy()});
  EXPECT_EQ(s.models, std::vector<std::string>{"lambert+ggx/smith_ggx.correlated/schlick"});
  ASSERT_EQ(s.lights.size(), 3U);
  for (const auto& l : s.lights) {
    EXPECT_EQ(l.covered, 1) << l.light;
    ASSERT_EQ(l.models.size(), 1U);
    EXPECT_LT(l.models[0].median, 0.02) << l.light;
    EXPECT_LT(l.models[0].p95, 0.25) << l.light;
  }
}

TEST(Spheres, DifferByTheSpacingOfSamplesAloneWhereTheModelIsRight) {
  for (const Table& t : {test::filled(test::half_difference_grid(15), test::glossy()),
                         test::filled(test::in_out_grid(), test::glossy())})
    for (const auto& l : spheres(t, {test::glossy()}).lights) {
      const auto& m = l.models.at(0);
      EXPECT_GT(m.p95, 0.1) << l.light;
      EXPECT_NEAR(m.spacing_median, m.median, 1e-9) << l.light;
      EXPECT_NEAR(m.spacing_p95, m.p95, 1e-9) << l.light;
    }
}

TEST(Spheres, OfAnotherModelLookDifferent) {
  for (const auto& l : spheres(whole(), {test::glossy(0.1)}).lights) {
    const auto& m = l.models.at(0);
    EXPECT_GT(m.median, 5) << l.light;
    EXPECT_GE(m.p95, m.median) << l.light;
    EXPECT_LT(m.spacing_median, 0.05) << l.light;
  }
}

TEST(Spheres, OfSeveralModelsStandBesideOneTable) {
  const Spheres one = spheres(whole(), {test::glossy()}),
                two = spheres(whole(), {test::glossy(0.1), test::glossy()});
  EXPECT_EQ(two.models.size(), 2U);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto &a = one.lights[k], &b = two.lights[k];
    EXPECT_EQ(a.table, b.table);
    EXPECT_EQ(a.models[0].picture, b.models.at(1).picture);
    EXPECT_NE(a.models[0].picture, b.models.at(0).picture);
    EXPECT_GT(b.models[0].median, b.models[1].median);
  }
}

// Normals within 45° of the middle between flash and viewer, 5° up, fill π/2 cos 5° of the disc,
// those that the flash reaches π/2 (1 + cos 10°).
TEST(Spheres, AreHatchedWhereTheTableHasNoValuesAndSayHowMuchThatIs) {
  const Table t = without(whole(), [](const HalfDifference& a) { return a.theta_h > 45 * degree; });
  const auto flash = spheres(t, {test::glossy()}).lights[2];
  EXPECT_NEAR(flash.covered, std::cos(5 * degree) / (1 + std::cos(10 * degree)), 0.03);
  const std::string bytes = from_base64(flash.models.at(0).difference);
  const auto table = test::png_pixels(from_base64(flash.table)),
             model = test::png_pixels(from_base64(flash.models[0].picture));
  ASSERT_EQ(bytes.size(), size * size);
  ASSERT_EQ(table.pixels.size(), size * size);
  const LitSphere sphere(sphere_lights()[2].towards, size);
  std::vector<bool> lit(size * size);
  for (const auto& p : sphere.points) lit[p.pixel] = true;
  const auto reached = std::ranges::count(lit, true);
  std::ptrdiff_t covered = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const auto byte = static_cast<unsigned char>(bytes[i]);
    EXPECT_EQ(byte == ModelSphere::beside, !sphere.inside[i]);
    const auto& colour = table.pixels[i];
    const bool hatched = colour[0] == colour[1] && (colour[0] == 136 || colour[0] == 184);
    EXPECT_EQ(hatched, byte == ModelSphere::not_covered);
    EXPECT_FALSE(hatched && !lit[i]);
    if (!lit[i] || hatched) continue;
    ++covered;
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(colour[c], model.pixels[i][c], 3);
  }
  EXPECT_DOUBLE_EQ(flash.covered, static_cast<double>(covered) / static_cast<double>(reached));
}

TEST(Spheres, AreExposedSoThatAHundredthOfTheTableIsWhite) {
  const BoundModel lambert = bind_model("lambert", {{"kd", {0.5, 0.5, 0.5}}}, 3);
  const Table t = test::filled(test::half_difference_grid(), lambert);
  const auto flash = spheres(t, {lambert}).lights[2];
  EXPECT_NEAR(flash.exposure, std::numbers::pi / 0.5, 0.02 * std::numbers::pi / 0.5);
  const auto pixels = test::png_pixels(from_base64(flash.table)).pixels;
  const auto white = std::ranges::count(pixels, std::array<unsigned char, 3>{255, 255, 255});
  EXPECT_GT(white, 0);
  EXPECT_LT(white, size * size / 20);
}

TEST(Spheres, OfATableInOnePlaneAreNotShown) {
  DirectionList plane;
  for (double in = 0; in < 90; in += 15)
    for (double out = -85; out < 90; out += 5) {
      plane.theta_i_deg.push_back(in);
      plane.phi_i_deg.push_back(0);
      plane.theta_o_deg.push_back(std::abs(out));
      plane.phi_o_deg.push_back(out > 0 ? 180 : 0);
    }
  for (const auto& l : spheres(test::filled(plane, test::glossy()), {test::glossy()}).lights) {
    EXPECT_LT(l.covered, Spheres::least_share) << l.light;
    EXPECT_EQ(l.table, "");
    EXPECT_TRUE(l.models.empty());
    EXPECT_TRUE(std::isnan(l.exposure));
  }
}

TEST(Spheres, OfOneChannelAreGrey) {
  const BoundModel grey = bind_model("ggx/smith_ggx.correlated/schlick", {{"alpha", {0.3}}}, 1);
  Table t = test::filled(test::half_difference_grid(), grey);
  t.channels = {"f"};
  const Spheres s = spheres(t, {grey});
  EXPECT_EQ(s.channels, std::vector<std::string>{"f"});
  for (const auto& l : s.lights) {
    EXPECT_LT(l.models.at(0).p95, 0.25);
    for (const auto& p : test::png_pixels(from_base64(l.table)).pixels)
      EXPECT_TRUE(p[0] == p[1] && p[1] == p[2]);
  }
}

TEST(Spheres, OfAFormatThatSaysFEverywhereAskItAndKnowNoSpacing) {
  Table t = test::filled(DirectionList{{30}, {0}, {30}, {180}}, test::glossy());
  t.between = [](const DirectionPair& p, std::size_t) { return p.wi.z > 0.2 ? 0.2 : -1; };
  for (const auto& l : spheres(t, {test::glossy()}).lights) {
    EXPECT_GT(l.covered, Spheres::least_share);
    EXPECT_LT(l.covered, 1);
    EXPECT_TRUE(std::isnan(l.models.at(0).spacing_median));
    EXPECT_GT(l.models[0].median, 1);
  }
}

TEST(Spheres, AreTheSameOnAnyNumberOfThreads) {
  const auto alone = [](int threads) {
    Spheres s;
    tbb::task_arena(threads).execute([&] { s = spheres(whole(), {test::glossy(0.1)}); });
    return s;
  };
  const Spheres a = alone(1), b = alone(2);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(a.lights[k].table, b.lights[k].table);
    EXPECT_EQ(a.lights[k].models[0].difference, b.lights[k].models[0].difference);
    EXPECT_EQ(a.lights[k].models[0].median, b.lights[k].models[0].median);
  }
}

}  // namespace
}  // namespace gonio
