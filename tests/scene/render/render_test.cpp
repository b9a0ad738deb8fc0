#include "scene/render/render.h"

#include "brdf/model/evaluate.h"
#include "constants.h"
#include "geometry/half_difference.h"
#include "scene/objects.h"
#include "scene/trace/camera.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace gonio::scene {
namespace {

using test::scene_of;
using test::sphere;

using gonio::test::pi;

Material material(const std::string& spec, const std::vector<Setting>& settings) {
  return {spec, {}, bind_model(spec, settings, 3), false};
}
const Material white = material("lambert", {{"kd", {1}}});
const Material gold =
    material("ggx/smith_ggx.correlated/conductor", {{"alpha", {0.3}}, {"metal", {}, "Au"}});

Scene lit(const Material& m, std::vector<Light> lights) {
  Scene s = scene_of({sphere({0, 0, 0}, 1)}, std::move(lights));
  s.materials = {m};
  std::get<Camera>(s.view).fov_deg = 14;
  return s;
}
std::vector<Shown> exact(const Scene& s) {
  std::vector<Shown> all;
  for (const auto& m : s.materials) {
    const Look look(m);
    all.emplace_back(look, look.exact());
  }
  return all;
}
Picture picture(const Scene& s, const RenderOptions& o) {
  return render(s, exact(s), o);
}
EnvironmentLight even(float radiance) {
  return {"", 1, {2, 1, {{radiance, radiance, radiance}, {radiance, radiance, radiance}}}};
}
DirectionalLight from(const Direction& d) {
  return {DirectionalLight::Fixed{d}, {pi, 2 * pi, 0}};
}

TEST(Render, LosesAWhiteSphereInAnEvenSky) {
  const Scene s = lit(white, {even(0.5)});
  const Picture p = picture(s, {16, 16, 1024, 1});
  double mean = 0;
  for (const auto& c : p.radiance) {
    EXPECT_NEAR(c[0], 0.5, 0.01);
    mean += c[0] / 256;
  }
  EXPECT_NEAR(mean, 0.5, 5e-4);
}

/// ∫ over pixel (x, y) of n, of f at the normal where the ray meets the unit sphere.
double over_pixel(const Scene& s, std::size_t x, std::size_t y, double n, auto&& f) {
  constexpr int parts = 40;
  double sum = 0;
  for (int i = 0; i < parts; ++i)
    for (int j = 0; j < parts; ++j) {
      const auto [o, d] =
          ray(std::get<Camera>(s.view), (static_cast<double>(x) + (i + 0.5) / parts) / n,
              (static_cast<double>(y) + (j + 0.5) / parts) / n, 1);
      const Vector v{d.x, d.y, d.z};
      const double b = dot(o, v), rest = b * b - dot(o, o) + 1;
      if (rest >= 0) sum += f(direction(o + (-b - std::sqrt(rest)) * v));
    }
  return sum / (parts * parts);
}

TEST(Render, ShadesAWhiteSphereByTheCosineOfItsLight) {
  const Direction l = direction(Vector{1, 2, 1});
  const Scene s = lit(white, {from(l)});
  constexpr std::size_t n = 24;
  const Picture p = picture(s, {n, n, 256, 1});
  ASSERT_EQ(p.radiance.size(), n * n);
  for (std::size_t y = 0; y < n; ++y)
    for (std::size_t x = 0; x < n; ++x) {
      const double cosine =
          over_pixel(s, x, y, n, [&](const Direction& m) { return std::max(dot(m, l), 0.0); });
      EXPECT_NEAR(p.radiance[y * n + x][0], cosine, 0.01) << x << ", " << y;
      EXPECT_DOUBLE_EQ(p.radiance[y * n + x][1], 2 * p.radiance[y * n + x][0]);
      EXPECT_EQ(p.radiance[y * n + x][2], 0);
    }
}

TEST(Render, AddsUpARectangleAsItsAreaDoes) {
  const RectangleLight light{{1, 1, 2}, {0.5, 0, 0}, {0, -0.3, 0.3}, {4, 4, 4}};
  for (const auto& m : {white, gold}) {
    Scene s = lit(m, {light});
    std::get<Camera>(s.view).fov_deg = 1e-3;
    const Rgb found = picture(s, {1, 1, 1 << 14, 1}).radiance[0];
    constexpr int parts = 300;
    const Vector normal = cross(light.u, light.v);
    std::vector<FrameAngles<double>> angles;
    std::vector<double> weight;
    for (int i = 0; i < parts; ++i)
      for (int j = 0; j < parts; ++j) {
        const Vector at = light.center + ((2 * i + 1.0) / parts - 1) * light.u +
                          ((2 * j + 1.0) / parts - 1) * light.v;
        const Vector way = at - Vector{0, 0, 1};
        const Direction l = direction(way);
        angles.push_back(frame_angles({l, {0, 0, 1}}));
        weight.push_back(4 * l.z * std::max(-dot(way, normal), 0.0) / std::pow(length(way), 3) *
                         (4.0 / (parts * parts)));
      }
    const Look look(m);
    Forms single = look.exact();
    single[Effect::compensation] = Form::uncompensated;
    const auto f =
        evaluate(look.surface(single).base, std::span<const FrameAngles<double>>(angles));
    const Look same(m);
    const Rgb shown = render(s, std::array{Shown(same, single)}, {1, 1, 1 << 14, 1}).radiance[0];
    for (std::size_t c = 0; c < 3; ++c) {
      double sum = 0;
      for (std::size_t k = 0; k < weight.size(); ++k) sum += f[c][k] * weight[k];
      EXPECT_GT(sum, 0.01);
      EXPECT_NEAR(shown[c], sum, 4e-3 * sum);
      EXPECT_GE(found[c], shown[c]);
    }
  }
}

TEST(Render, GivesTheSamePictureForTheSameSeedWhateverTheThreads) {
  Scene s = lit(gold, {even(1), RectangleLight{{1, 1, 2}, {0.5, 0, 0}, {0, -0.3, 0.3}, {4, 4, 4}}});
  s.objects.push_back(test::object(test::square(3, -1.2F)));
  const RenderOptions o{30, 21, 9, 3};
  const Picture one = [&] {
    const tbb::global_control alone(tbb::global_control::max_allowed_parallelism, 1);
    return picture(s, o);
  }();
  EXPECT_EQ(picture(s, o).radiance, one.radiance);
  RenderOptions other = o;
  other.seed = 4;
  EXPECT_NE(picture(s, other).radiance, one.radiance);
}

TEST(Render, DrawsTheSameDirectionsForEveryForm) {
  const Scene s = lit(gold, {even(1)});
  const Look look(gold);
  const auto of = [&](Form precision) {
    Forms f = look.exact();
    f[Effect::precision] = precision;
    return render(s, std::array{Shown(look, f)}, {16, 16, 4, 1});
  };
  const Picture wide = of(Form::in_double), narrow = of(Form::in_float);
  EXPECT_NE(wide.radiance, narrow.radiance);
  for (std::size_t k = 0; k < wide.radiance.size(); ++k)
    EXPECT_NEAR(narrow.radiance[k][1], wide.radiance[k][1], 1e-5 * wide.radiance[k][1]);
}

TEST(Render, ShowsTheSkyBehindAndNothingWhereThereIsNone) {
  EnvironmentLight sky = even(1);
  sky.map.radiance[1] = {3, 2, 1};  // the half towards −x
  Scene s = lit(white, {sky});
  s.objects[0] = sphere({0, 0, 0}, 0.1);
  const Picture p = picture(s, {8, 8, 1, 1});  // looks along −z: +x is to the right
  EXPECT_EQ(p.radiance[0], (Rgb{3, 2, 1}));
  EXPECT_EQ(p.radiance[7], (Rgb{1, 1, 1}));
  s.lights = {from({0, 0, 1})};
  EXPECT_EQ(picture(s, {8, 8, 1, 1}).radiance[0], (Rgb{0, 0, 0}));
}

TEST(Render, CastsShadows) {
  Scene s = lit(white, {from({0, 1, 0})});
  s.objects = {test::object(test::square(3, -1))};
  std::get<Camera>(s.view) = {{0, 5, 5}, {0, -1, 0}, {0, 1, 0}, 1};
  EXPECT_NEAR(picture(s, {1, 1, 16, 1}).radiance[0][0], 1, 1e-12);
  s.objects.push_back(sphere({0, 0.5, 0}, 0.5));
  EXPECT_EQ(picture(s, {1, 1, 16, 1}).radiance[0][0], 0);
}

TEST(Render, TellsHowMuchIsDone) {
  const Scene s = lit(white, {from({0, 1, 0})});
  std::size_t last = 0;
  render(s, exact(s), {33, 17, 1, 1}, [&](std::size_t done, std::size_t all) {
    EXPECT_EQ(done, ++last);
    EXPECT_EQ(all, 15);
  });
  EXPECT_EQ(last, 15);
}

TEST(Render, LooksTheEnvironmentUpInPlaceOfItsDirections) {
  Scene s = lit(white, {EnvironmentLight{"", 2, {2, 1, {{1, 1, 1}, {1, 1, 1}}, 0}}});
  std::get<Camera>(s.view).fov_deg = 1e-3;
  const Look look = std::move(looks_of(s)[0]);
  Forms forms = look.exact();
  forms[Effect::environment] = Form::split_sum;
  const Rgb drawn =
      render(s, std::array{Shown(look, look.exact())}, {1, 1, 1 << 12, 1}).radiance[0];
  const Rgb looked_up = render(s, std::array{Shown(look, forms)}, {1, 1, 1, 1}).radiance[0];
  EXPECT_NEAR(looked_up[0], drawn[0], 5e-3 * drawn[0]);
  EXPECT_NEAR(looked_up[0], 2, 1e-6);
}

}  // namespace
}  // namespace gonio::scene
