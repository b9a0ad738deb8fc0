#include "scene/light/lighting.h"

#include "constants.h"
#include "geometry/half_difference.h"
#include "integrate/light/irradiance.h"
#include "integrate/lights.h"
#include "scene/objects.h"
#include "support.h"

#include <gtest/gtest.h>

namespace gonio::scene {
namespace {

using test::scene_of;
using test::sphere;

using gonio::test::pi;
const Direction up{0, 1, 0};

DirectionalLight from(const Direction& d, const Rgb& irradiance) {
  return {DirectionalLight::Fixed{d}, irradiance};
}
EnvironmentLight even(const Rgb& radiance) {
  EnvironmentLight e{"", 1, {16, 8, {}}};
  std::array<float, 3> l{};
  std::ranges::transform(radiance, l.begin(), [](double v) { return static_cast<float>(v); });
  e.map.radiance.assign(16 * 8, l);
  return e;
}

std::vector<Incident> incident(const Lighting& lights,
                               const Vector& at,
                               const Direction& normal,
                               const Direction& viewer,
                               std::span<const double> widths,
                               std::size_t count,
                               std::uint64_t seed = 1) {
  Draws draw(seed);
  std::vector<Incident> all;
  lights.incident(at, Frame(normal), viewer, widths, count, draw, all);
  return all;
}
Rgb sum(const std::vector<Incident>& all) {
  Rgb s{};
  for (const auto& i : all)
    for (std::size_t c = 0; c < 3; ++c) s[c] += i.weight[c];
  return s;
}

TEST(Lighting, GivesADirectionalLightByItsCosine) {
  const Direction d = direction(Vector{3, 4, 0});
  const Scene s = scene_of({}, {from(d, {1, 2, 3})});
  const auto all = incident({s, nullptr}, {}, up, up, {}, 9);
  ASSERT_EQ(all.size(), 1);
  EXPECT_DOUBLE_EQ(all[0].weight[1], 2 * 0.8);
  EXPECT_EQ(all[0].direction.x, d.x);
  EXPECT_TRUE(incident({s, nullptr}, {}, {0, -1, 0}, {0, -1, 0}, {}, 9).empty());
  EXPECT_TRUE(incident({s, nullptr}, {}, up, {0, -1, 0}, {}, 9).empty());
}

TEST(Lighting, LeavesOutWhatIsOccluded) {
  RectangleLight above{{0, 9, 0}, {1, 0, 0}, {0, 0, 1}, {1, 1, 1}};
  const Scene s = scene_of({sphere({0, 4, 0}, 2)}, {from(up, {1, 2, 3}), above, even({1, 1, 1})});
  const Tracer tracer(s);
  const auto lit = incident({s, nullptr}, {}, up, up, {}, 4096);
  const auto shaded = incident({s, &tracer}, {}, up, up, {}, 4096);
  EXPECT_EQ(lit[0].weight[2], 3);
  for (const auto& i : shaded) EXPECT_LT(i.direction.y, std::sqrt(0.75) + 1e-6);
  // ∫ cos over a cap of sin θ = 2/4
  EXPECT_NEAR(sum(shaded)[0], pi * 0.75, 0.02);
  EXPECT_EQ(incident({s, &tracer}, {30, 0, 0}, up, up, {}, 1)[0].weight[2], 3);
}

TEST(Lighting, DrawsARangingLightEvenly) {
  const DirectionalLight light{DirectionalLight::Ranging{{{20, 60}, {-10, 90}}}, {1, 1, 1}};
  const Scene s = scene_of({}, {light});
  double elevation = 0, azimuth = 0;
  constexpr int n = 2000;
  for (int i = 0; i < n; ++i) {
    const auto all = incident({s, nullptr}, {}, up, up, {}, 1, static_cast<std::uint64_t>(i));
    ASSERT_EQ(all.size(), 1);
    const Direction& d = all[0].direction;
    const double e = std::asin(d.y) / degree, a = std::atan2(d.x, d.z) / degree;
    EXPECT_GE(e, 20 - 1e-9);
    EXPECT_LE(e, 60 + 1e-9);
    elevation += e / n;
    azimuth += a / n;
  }
  EXPECT_NEAR(elevation, 40, 5 * 40 / std::sqrt(12.0 * n));
  EXPECT_NEAR(azimuth, 40, 5 * 100 / std::sqrt(12.0 * n));
}

/// Irradiance of a rectangle of radiance 1 with a corner straight above, sides a and b of its height.
double of_corner(double a, double b) {
  const auto part = [](double x, double y) {
    return x / std::hypot(1, x) * std::atan(y / std::hypot(1, x));
  };
  return (part(a, b) + part(b, a)) / 2;
}

TEST(Lighting, HasTheIrradianceOfARectangleOverhead) {
  // at height 2, from x = −1 to 3 and z = −2 to 1
  const RectangleLight light{{1, 2, -0.5}, {2, 0, 0}, {0, 0, 1.5}, {1, 2, 4}};
  const Scene s = scene_of({}, {light});
  const double exact =
      of_corner(0.5, 1) + of_corner(0.5, 0.5) + of_corner(1.5, 1) + of_corner(1.5, 0.5);
  const std::vector<std::vector<double>> lobes{{}, {0.2}, {0.05, 0.7}};
  for (const auto& widths : lobes) {
    const Rgb e = sum(incident({s, nullptr}, {}, up, direction(Vector{1, 3, 0}), widths, 1 << 14));
    EXPECT_NEAR(e[0], exact, 4e-3 * exact) << widths.size();
    EXPECT_NEAR(e[2], 4 * e[0], 1e-9);
  }
  // it shines to the side that u × v points to
  const RectangleLight above{{1, 2, 0}, {2, 0, 0}, {0, 0, -1}, {1, 1, 1}};
  const RectangleLight beside{{2, 0.5, 0}, {0, 3, 0}, {0, 0, 3}, {1, 1, 1}};
  const Scene away = scene_of({}, {above, beside});
  EXPECT_TRUE(
      incident({away, nullptr}, {}, up, direction(Vector{1, 1, 0}), std::array{1.0}, 64).empty());
}

TEST(Lighting, HasTheIrradianceOfAnEvenSky) {
  const Scene s = scene_of({}, {even({1, 2, 3})});
  const std::vector<std::vector<double>> lobes{{}, {0.01}, {0.4}, {0.01, 0.4}};
  for (const auto& widths : lobes) {
    const Rgb e = sum(incident({s, nullptr}, {}, direction(Vector{1, 2, 3}),
                               direction(Vector{3, 2, 3}), widths, 1 << 14));
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(e[c], pi * static_cast<double>(c + 1), 0.01 * pi * static_cast<double>(c + 1))
          << widths.size();
  }
}

void expect_irradiance(const EnvironmentLight& light) {
  const Scene s = scene_of({}, {light});
  const Lighting lights(s, nullptr);
  for (std::size_t i = 0; i < 6; ++i) {
    const Direction n = spiral_direction(i, 6);
    const Rgb exact = irradiance(light.map, EnvironmentLight::into_map(n));
    const std::vector<std::vector<double>> lobes{{}, {0.05}};
    for (const auto& widths : lobes) {
      std::array<double, 3> mean{}, square{};
      constexpr int runs = 16;
      for (int r = 0; r < runs; ++r) {
        const Rgb e = sum(incident(lights, {}, n, n, widths, 4096, static_cast<std::uint64_t>(r)));
        for (std::size_t c = 0; c < 3; ++c) {
          mean[c] += e[c] / runs;
          square[c] += e[c] * e[c] / runs;
        }
      }
      for (std::size_t c = 0; c < 3; ++c) {
        const double noise = std::sqrt((square[c] - mean[c] * mean[c]) / (runs - 1));
        EXPECT_NEAR(mean[c], light.scale * exact[c], 5 * noise + 1e-5 * exact[c]) << i;
        EXPECT_LT(noise, 0.02 * light.scale * exact[c]) << i;
      }
    }
  }
}

TEST(Lighting, HasTheIrradianceOfAMapWithASun) {
  expect_irradiance({"", 2, gonio::test::random_texels(16, 5)});
}

TEST(Lighting, HasTheIrradianceOfACity) {
  GONIO_NEEDS_SHARED(path, "data/env/city.exr");
  expect_irradiance({path, 1, read_environment(path)});
}

TEST(Lighting, MakesLittleNoiseOfASmoothLobeInAnEvenSky) {
  const Scene s = scene_of({}, {even({1, 1, 1})});
  const Lighting lights(s, nullptr);
  const double alpha = 0.01;
  const Direction v = direction(0.7, 0.3);
  for (std::uint64_t seed = 0; seed < 2000; ++seed)
    for (const auto& i : incident(lights, {}, {0, 0, 1}, v, std::array{alpha}, 1, seed)) {
      // D G1(v) G1(l)/(4 NoL NoV), of which G1 is at most 1: so that a share of a quarter gives 4
      // at most
      const auto a =
          frame_angles({Frame({0, 0, 1}).inside(i.direction), Frame({0, 0, 1}).inside(v)});
      const double d =
          alpha * alpha / pi / std::pow(alpha * alpha * a.noh * a.noh + a.sin2_theta_h, 2);
      const auto g1 = [&](double c) {
        return 2 * c / (c + std::sqrt(alpha * alpha + (1 - alpha * alpha) * c * c));
      };
      EXPECT_LT(d * g1(a.nol) * g1(a.nov) / (4 * a.nol * a.nov) * i.weight[0], 4 + 1e-9);
    }
}

TEST(Lighting, MakesLittleNoiseOfASunOfOneTexel) {
  EnvironmentLight sky = even({0.1, 0.1, 0.1});
  sky.map = {256, 128, std::vector<std::array<float, 3>>(256 * 128, {0.1F, 0.1F, 0.1F})};
  sky.map.radiance[20 * 256 + 70] = {1e6F, 1e6F, 1e6F};
  const Scene s = scene_of({}, {sky});
  const Lighting lights(s, nullptr);
  const double power =
      1e6 * 2 * pi / 256 * (std::cos(20 * pi / 128) - std::cos(21 * pi / 128)) + 0.4 * pi;
  for (std::uint64_t seed = 0; seed < 2000; ++seed)
    for (const auto& i : incident(lights, {}, up, up, std::array{0.5}, 1, seed))
      EXPECT_LT(i.weight[0], 2 * power);  // a half is drawn from the light
}

TEST(Lighting, DrawsTheSameForTheSameSeed) {
  const RectangleLight light{{1, 2, 0}, {2, 0, 0}, {0, 0, 1}, {1, 2, 4}};
  const Scene s = scene_of({}, {light, even({1, 1, 1})});
  const Lighting lights(s, nullptr);
  const auto run = [&](std::uint64_t seed) {
    std::vector<double> all;
    for (const auto& i : incident(lights, {}, up, up, std::array{0.1, 0.4}, 32, seed))
      all.insert(all.end(), {i.direction.x, i.direction.z, i.weight[0]});
    return all;
  };
  EXPECT_EQ(run(3), run(3));
  EXPECT_NE(run(3), run(4));
}

}  // namespace
}  // namespace gonio::scene
