#include "table/health/noise.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "support.h"
#include "table/example.h"

namespace gonio {
namespace {

using namespace test;

/// Every value times exp(σ z).
Table noisy(Table t, double sigma, unsigned seed = 1) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> z;
  for (auto& plane : t.values)
    for (double& v : plane) v *= std::exp(sigma * z(random));
  return t;
}

Table slice() {
  return on_grid(image_slice_grid(90, 90, 1.5, Bins::centre), "exr", {"f"},
                 [](const auto& a, std::size_t) { return lobe(a, 0.1, 0.2); });
}

/// Five incident angles in the plane of incidence, by 1°.
Table in_plane(double step = 1) {
  Table t;
  t.format = "csv";
  t.channels = {"f"};
  DirectionList l;
  for (const double in : {10.0, 30.0, 45.0, 60.0, 75.0})
    for (double out = -85; out <= 85; out += step) {
      l.theta_i_deg.push_back(in);
      l.phi_i_deg.push_back(20);
      l.theta_o_deg.push_back(std::abs(out));
      l.phi_o_deg.push_back(out < 0 ? 20 : 200);
    }
  t.where = l;
  const SampleAngles at(t);
  auto& plane = t.values.emplace_back();
  for (std::size_t i = 0; i < l.theta_i_deg.size(); ++i) plane.push_back(lobe(at(i), 0.3, 0.3));
  return t;
}

TEST(Noise, ComesBackWithinAFifth) {
  for (const double sigma : {0.005, 0.02, 0.1})
    for (const Table& t : {merl_example(0.15), mbsdf_example(45, 90), slice(), in_plane()}) {
      const Noise n = estimate_noise(noisy(t, sigma));
      ASSERT_TRUE(n.sigma) << t.format;
      EXPECT_FALSE(n.bound) << t.format << " " << sigma;
      EXPECT_NEAR(*n.sigma / sigma, 1, 0.2) << t.format << " " << sigma;
      for (const double channel : n.channels) EXPECT_NEAR(channel / sigma, 1, 0.2) << t.format;
    }
}

TEST(Noise, IsBoundedFromAboveInASmoothTable) {
  for (const Table& t : {merl_example(0.15), mbsdf_example(45, 90), slice(), in_plane()}) {
    const Noise n = estimate_noise(t);
    ASSERT_TRUE(n.sigma) << t.format;
    EXPECT_TRUE(n.bound) << t.format;
    EXPECT_LT(*n.sigma, 2e-3) << t.format;
    EXPECT_TRUE(n.over_angle.empty());
  }
}

TEST(Noise, OfACoarseTableIsTheShapeOfItsCurves) {
  const Noise n = estimate_noise(in_plane(17));  // a lobe is two samples wide
  ASSERT_TRUE(n.sigma);
  EXPECT_TRUE(n.bound);
}

TEST(Noise, IsToldByAngleAndByValue) {
  Table t = mbsdf_example(45, 90);
  const SampleAngles at(t);
  std::mt19937_64 random(3);
  std::normal_distribution<double> z;
  for (auto& plane : t.values)
    for (std::size_t i = 0; i < t.size(); ++i)
      plane[i] *= std::exp((std::min(at(i).nol, at(i).nov) < 0.5 ? 0.06 : 0.02) * z(random));
  const Noise n = estimate_noise(t);
  ASSERT_EQ(n.over_angle.size(), 6U);
  EXPECT_NEAR(n.over_angle[2].sigma, 0.02, 0.004);
  EXPECT_EQ(n.over_angle[5].from, 75);
  EXPECT_NEAR(n.over_angle[5].sigma, 0.06, 0.012);
  ASSERT_FALSE(n.over_value.empty());
  EXPECT_GT(n.over_value[0].values, 50U);
}

TEST(Noise, DoesNotBelieveCopiedAngles) {
  Table t = noisy(mbsdf_example(45, 90), 0.03);
  for (auto& plane : t.values)
    for (std::size_t row = 1; row < 45; row += 2)
      std::copy_n(&plane[(row - 1) * 4050], 4050, &plane[row * 4050]);
  EXPECT_NEAR(*estimate_noise(t).sigma, 0.03, 0.006);
}

TEST(Noise, OfAListDoesNotDependOnTheOrderOfItsSamples) {
  const Table t = noisy(in_plane(), 0.02);
  Table shuffled = t;
  std::vector<std::size_t> order(t.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::shuffle(order, std::mt19937_64(7));
  auto& to = std::get<DirectionList>(shuffled.where);
  for (std::size_t i = 0; i < order.size(); ++i) {
    to.theta_i_deg[i] = t.list()->theta_i_deg[order[i]];
    to.theta_o_deg[i] = t.list()->theta_o_deg[order[i]];
    to.phi_o_deg[i] = t.list()->phi_o_deg[order[i]];
    shuffled.values[0][i] = t.values[0][order[i]];
  }
  const Noise a = estimate_noise(t), b = estimate_noise(shuffled);
  ASSERT_TRUE(a.sigma);
  EXPECT_EQ(a.along, "theta_o");
  EXPECT_EQ(b.along, a.along);
  EXPECT_EQ(b.sigma, a.sigma);
}

TEST(Noise, IsToldByRepeatsWhereThereAreSome) {
  Table t;
  t.format = "csv";
  t.channels = {"f"};
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> theta(0, 80);
  DirectionList l;
  for (int i = 0; i < 800; ++i) {
    const bool again = i % 2 == 1;
    l.theta_i_deg.push_back(again ? l.theta_i_deg.back() : theta(random));
    l.theta_o_deg.push_back(again ? l.theta_o_deg.back() : theta(random));
    l.phi_i_deg.push_back(0);
    l.phi_o_deg.push_back(again ? l.phi_o_deg.back() : 4 * theta(random));
  }
  t.where = l;
  t.values = {Values(800, 0.3)};
  const Noise n = estimate_noise(noisy(t, 0.05));
  EXPECT_EQ(n.along, "repeats");
  EXPECT_NEAR(*n.sigma, 0.05, 0.01);
}

TEST(Noise, CannotBeToldFromScatteredSamplesOrFewOnes) {
  EXPECT_FALSE(estimate_noise(csv_example()).sigma);
  EXPECT_FALSE(estimate_noise(mbsdf_example(4, 5)).sigma);
  Table dark = slice();
  for (double& v : dark.values[0]) v = -v;
  EXPECT_FALSE(estimate_noise(dark).sigma);
}

}  // namespace
}  // namespace gonio
