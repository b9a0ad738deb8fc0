#include "explore/sphere.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/vector.h"
#include "image/display.h"
#include "tables.h"

#include <gtest/gtest.h>

namespace gonio::explore {
namespace {

Surface red_plastic() {
  return {"lambert+ggx/smith_ggx.correlated/schlick",
          "alpha=0.3 kd=0.2,0.1,0.05 f0=0.04,0.05,0.06",
          {}};
}

/// Radiance of each pixel by brute force: Σ L f cos θ_i dω over small parts of the light, by channel.
Channels summed(const Surface& s, std::size_t pixels, const scene::Light& light) {
  Channels l(s.channels(), std::vector<double>(pixels * pixels, NAN));
  for (std::size_t i = 0; i < pixels * pixels; ++i) {
    const auto frame = sphere_frame(pixels, i);
    if (!frame) continue;
    std::vector<DirectionPair> at;
    std::vector<double> weight;  // radiance times solid angle times cosine
    const auto add = [&](const Direction& towards, double of) {
      const Direction wi = frame->inside(towards);
      if (!(wi.z > 1e-9)) return;
      at.push_back({wi, frame->inside(towards_viewer)}), weight.push_back(of * wi.z);
    };
    if (const auto* r = std::get_if<scene::RectangleLight>(&light)) {
      constexpr int n = 48;
      const Vector shines = cross(r->u, r->v);
      const double part = 4 * length(shines) / (n * n);
      for (int a = 0; a < n; ++a)
        for (int b = 0; b < n; ++b) {
          const Vector to = r->center + ((2 * a + 1.0) / n - 1) * r->u +
                            ((2 * b + 1.0) / n - 1) * r->v - vector_of(frame->z);
          const double cosine = -dot(to, shines) / (length(to) * length(shines));
          if (cosine > 0)
            add(direction(to), r->radiance[0] * part * cosine / std::pow(length(to), 2));
        }
    } else {
      const auto& sky = std::get<scene::EnvironmentLight>(light);
      const auto& map = sky.map;
      const double side = std::numbers::pi / static_cast<double>(map.height);
      for (std::size_t j = 0; j < map.height; ++j)
        for (std::size_t k = 0; k < map.width; ++k) {
          const double theta = map.theta(static_cast<double>(j) + 0.5);
          add(scene::EnvironmentLight::out_of_map(
                  direction(theta, map.phi(static_cast<double>(k) + 0.5))),
              map.texel(k, j)[0] * sky.scale * side * side * std::sin(theta));
        }
    }
    const Channels f = s(at);
    for (std::size_t c = 0; c < f.size(); ++c) {
      l[c][i] = 0;
      for (std::size_t k = 0; k < at.size(); ++k)
        if (!std::isnan(f[c][k])) l[c][i] += f[c][k] * weight[k];
    }
  }
  return l;
}

TEST(Sphere, IsThatOfTheReports) {
  const Surface s = red_plastic();
  for (const auto& lights : sphere_lights()) {
    const LitSphere lit(lights.towards, 32);
    std::vector<unsigned char> rgba(4 * 32 * 32, 7);
    Sphere(32, lights.towards).draw(s, 3, rgba);
    std::vector<FrameAngles<double>> x;
    for (const auto& p : lit.points) x.push_back(frame_angles(p.at));
    const auto f = evaluate(*s.model(), x);
    std::vector<Rgb> rgb;
    for (std::size_t i = 0; i < x.size(); ++i) rgb.push_back({f[0][i], f[1][i], f[2][i]});
    const auto radiance = lit.radiance(rgb);
    for (std::size_t i = 0; i < radiance.size(); ++i) {
      const auto bytes = displayed_bytes(radiance[i], 3);
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(rgba[4 * i + c], bytes[c], 2) << lights.name << i;
      EXPECT_EQ(rgba[4 * i + 3], lit.inside[i] ? 255 : 0);
    }
  }
}

TEST(Sphere, DiffersFromAnotherByWhatADisplayShows) {
  const Direction light = direction(Vector{0.5, 0.6, 0.62});
  const Sphere sphere(48, std::span(&light, 1));
  const Surface s = red_plastic(), red("lambert", "kd=0.5,0.1,0.1", 3),
                brighter("lambert", "kd=0.55,0.11,0.11", 3);
  const auto none = sphere.difference(s, s, 3);
  EXPECT_EQ(none.median, 0);
  EXPECT_EQ(none.covered, 1);
  const auto d = sphere.difference(brighter, red, 3);
  // A Lambertian sphere: the brightest pixel is the colour itself.
  const double most = displayed_difference({0.55 / 3.1415927, 0.11 / 3.1415927, 0.11 / 3.1415927},
                                           {0.5 / 3.1415927, 0.1 / 3.1415927, 0.1 / 3.1415927}, 3);
  EXPECT_GT(d.median, 0.3 * most);
  EXPECT_LT(d.median, d.p95);
  EXPECT_NEAR(d.p95, most, 0.1 * most);
  Table t = test::filled(page_grid({12, 9, 6}), test::glossy());
  for (auto& channel : t.values) std::fill(channel.begin(), channel.end(), NAN);
  EXPECT_EQ(sphere.difference(s, Surface(std::move(t)), 3).covered, 0);
}

TEST(WideSphere, ConvergesToTheSumOverItsLight) {
  constexpr std::size_t pixels = 12;
  const Surface table(test::filled(page_grid({45, 30, 36}), test::glossy()));
  for (std::size_t light = 0; light < wide_lights().size(); ++light)
    for (const Surface* s : {&table, static_cast<const Surface*>(nullptr)}) {
      const Surface model = red_plastic();
      const Surface& surface = s ? *s : model;
      const auto expected = summed(surface, pixels, wide_lights()[light].scene.lights[0]);
      WideSphere sphere(pixels, light);
      for (std::size_t pass = 1; pass <= WideSphere::passes; ++pass)
        EXPECT_EQ(sphere.gather(surface), pass);
      const auto found = sphere.radiance();
      ASSERT_EQ(found.size(), expected.size());
      double worst = 0, off = 0, all = 0;
      for (std::size_t c = 0; c < found.size(); ++c)
        for (std::size_t i = 0; i < found[c].size(); ++i) {
          EXPECT_EQ(std::isnan(found[c][i]), !sphere_frame(pixels, i).has_value()) << i;
          if (!(expected[c][i] > 0.02)) continue;
          off += found[c][i] - expected[c][i], all += expected[c][i];
          worst = std::max(worst, std::abs(found[c][i] / expected[c][i] - 1));
        }
      EXPECT_NEAR(off / all, 0, 0.015) << wide_lights()[light].name << " " << !s;
      EXPECT_LT(worst, 0.3) << wide_lights()[light].name << " " << !s;
    }
}

TEST(WideSphere, IsRightInTheMeanFromTheFirstPassOn) {
  const Surface s = red_plastic();
  for (std::size_t light = 0; light < wide_lights().size(); ++light) {
    WideSphere sphere(48, light);
    const auto sum = [&] {
      const auto radiance = sphere.radiance();
      double all = 0;
      for (const double l : radiance[0]) all += std::isnan(l) ? 0 : l;
      return all;
    };
    sphere.gather(s);
    const double first = sum();
    while (sphere.gather(s) < WideSphere::passes) {
    }
    EXPECT_NEAR(first / sum(), 1, 0.1) << wide_lights()[light].name;
  }
}

TEST(WideLights, GiveAFacingWhiteSurfaceTheLightThatADisplayShowsAsWhite) {
  // A white diffuser facing an irradiance of 1 has the radiance 1/π.
  const Surface white("lambert", "kd=1", 1);
  for (const auto& light : wide_lights()) {
    const auto l = summed(white, 24, light.scene.lights[0]);
    double most = 0;
    for (const double v : l[0]) most = std::max(most, std::isnan(v) ? 0 : v);
    EXPECT_NEAR(most * std::numbers::pi, 1, 0.02) << light.name;
  }
}

}  // namespace
}  // namespace gonio::explore
