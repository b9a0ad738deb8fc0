#include "scene/trace/tracer.h"

#include <limits>
#include <numbers>

#include "base/random.h"
#include "scene/objects.h"

#include <gtest/gtest.h>

namespace gonio::scene {
namespace {

using test::object;
using test::scene_of;
using test::sphere;
using test::square;

constexpr double infinite = std::numeric_limits<double>::infinity();

double off(const Direction& a, const Direction& b) {
  return length(vector_of(a) - vector_of(b));
}
void expect_right_handed(const Frame& f) {
  EXPECT_NEAR(length(vector_of(f.x)), 1, 1e-12);
  EXPECT_NEAR(dot(f.x, f.z), 0, 1e-12);
  EXPECT_LT(length(cross(vector_of(f.z), vector_of(f.x)) - vector_of(f.y)), 1e-12);
}

TEST(Tracer, MeetsSpheresInDouble) {
  const Vector c{1, 2, 3};
  const Scene s = scene_of({sphere(c, 0.5, 1)});
  const Tracer t(s);
  Draws draw(1);
  int met = 0;
  for (std::size_t i = 0; i < 1000; ++i) {
    const Vector from = c + 40.0 * vector_of(spiral_direction(i, 1000));
    const Direction d =
        direction(c + Vector{draw.uniform() - 0.5, draw.uniform() - 0.5, 0.0} - from);
    const Vector to = c - from;
    const double apart = length(to - dot(to, vector_of(d)) * vector_of(d));
    const auto hit = t.closest(from, d);
    ASSERT_EQ(hit.has_value(), apart < 0.5) << i;
    if (!hit) continue;
    ++met;
    const Vector out = hit->position - c, way = hit->position - from;
    EXPECT_NEAR(length(out), 0.5, 1e-15);
    EXPECT_LT(length(way - dot(way, vector_of(d)) * vector_of(d)), 1e-12);
    EXPECT_LT(length(way), length(to));
    EXPECT_LT(off(hit->frame.z, direction(out)), 1e-15);
    EXPECT_EQ(hit->object, 0);
    EXPECT_EQ(hit->material, 1);
    expect_right_handed(hit->frame);
  }
  EXPECT_GT(met, 500);
}

TEST(Tracer, MeetsASmallSphereFarAwayAllOverItsDisc) {
  std::vector<Object> objects{sphere({0, 0, 0}, 1e-5)};
  for (int i = 1; i < 100; ++i) objects.push_back(sphere({1e-4 * i, 0, 0}, 1e-5));  // many boxes
  Scene s = scene_of(objects);
  s.view = Camera{{3000.0001, 4000.0001, 5000.0001}, {0, 0, 0}};
  const Tracer t(s);
  const Vector from{3000.0001, 4000.0001, 5000.0001};
  const Frame across(direction(-1 * from));
  for (std::size_t i = 0; i < 1000; ++i) {
    const Direction d = direction(static_cast<double>(i), 0);  // around the disc's edge
    const Vector aim = 0.999e-5 * (d.x * vector_of(across.x) + d.z * vector_of(across.y));
    EXPECT_EQ(t.closest(from, direction(aim - from)).value().object, 0) << i;
  }
}

TEST(Tracer, LaysTheTangentOfASphereAlongTheAzimuth) {
  const Scene s = scene_of({sphere({0, 0, 0}, 1)});
  const Tracer t(s);
  for (const double elevation : {-89.0, 0.0, 40.0})
    for (const double azimuth : {0.0, 100.0, 200.0}) {
      const Direction n = direction_of(elevation, azimuth);
      const Frame f = t.closest(5 * vector_of(n), direction(-1 * vector_of(n))).value().frame;
      EXPECT_LT(off(f.x, direction_of(0, azimuth + 90)), 1e-12);
      EXPECT_LT(off(f.y, direction_of(elevation + 90, azimuth)), 1e-12);
    }
  for (const double up : {5.0, -5.0})
    expect_right_handed(t.closest({0, up, 0}, direction(Vector{0, -up, 0})).value().frame);
}

TEST(Tracer, TurnsTangentsByTheirMaterialsAnticlockwiseFromOutside) {
  const auto mesh = square(1, 0);
  mesh->tangents.assign(4, {0, 0, 1, 1});
  const auto mirrored = square(1, -1);
  mirrored->tangents.assign(4, {0, 0, 1, -1});
  const Scene s = scene_of({sphere({5, 0, 0}, 1, 1), object(mesh, 2), object(mirrored, 2)});
  const Tracer t(s, std::array{0.0, 0.3, 0.4});
  const Frame of_sphere = t.closest({5, 0, 5}, {0, 0, -1}).value().frame;
  EXPECT_LT(off(of_sphere.x, {std::cos(0.3), std::sin(0.3), 0}), 1e-12);
  const Frame of_mesh = t.closest({0.1, 3, 0.2}, {0, -1, 0}).value().frame;
  EXPECT_LT(off(of_mesh.x, {std::sin(0.4), 0, std::cos(0.4)}), 1e-12);
  expect_right_handed(of_mesh);
  // from below: the same line on the surface
  const Frame behind = t.closest({0.1, -0.5, 0.2}, direction(Vector{0.1, 1, 0.3})).value().frame;
  EXPECT_LT(off(behind.z, {0, -1, 0}), 1e-12);
  EXPECT_LT(off(behind.x, of_mesh.x), 1e-12);
  expect_right_handed(behind);
  const Frame other = t.closest({0.1, -0.5, 0.2}, {0, -1, 0}).value().frame;
  EXPECT_LT(off(other.x, {-std::sin(0.4), 0, std::cos(0.4)}), 1e-12);
}

TEST(Tracer, MeetsTrianglesAndBetweenTheirCornersTheNormalBetweenThose) {
  const auto mesh = square(2, 1);
  mesh->normals = {{0, 1, 0}, {0.6F, 0.8F, 0}, {0.6F, 0.8F, 0}, {0, 1, 0}};
  const Scene s = scene_of({object(mesh)});
  const Tracer t(s);
  const Direction down = direction(Vector{0.1, -1, 0.2});
  for (const double x : {-1.9, 0.0, 0.3, 1.8}) {
    const auto hit = t.closest({x - 0.3, 4, -0.1}, down);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->position.x, x, 1e-6);
    EXPECT_NEAR(hit->position.y, 1, 1e-6);
    EXPECT_NEAR(hit->position.z, 0.5, 1e-6);
    const double part = (x + 2) / 4;
    EXPECT_LT(off(hit->frame.z, direction(Vector{0.6 * part, 1 - 0.2 * part, 0})), 1e-6);
    expect_right_handed(hit->frame);
  }
  EXPECT_FALSE(t.closest({3, 4, 0}, {0, -1, 0}));
}

TEST(Tracer, LeansNormalsThatFaceAwayFromTheViewer) {
  const auto mesh = square(1, 0);
  mesh->normals.assign(4, {0.8F, 0.6F, 0});
  const Scene s = scene_of({object(mesh)});
  const Tracer t(s);
  const Direction d = direction(Vector{1, -0.1, 0});
  const auto hit = t.closest({-5, 0.5, 0}, d);
  ASSERT_TRUE(hit);
  EXPECT_GE(-dot(hit->frame.z, d), 1e-3 - 1e-9);
  EXPECT_LT(-dot(hit->frame.z, d), 2e-3);
  EXPECT_GT(hit->frame.z.y, 0.9);
}

TEST(Tracer, MeetsWhatIsNearest) {
  const Scene s = scene_of({sphere({0, 0, 0}, 1, 0), sphere({0, 4, 0}, 0.5, 1),
                            object(square(9, 2), 2), object(square(9, -3), 1)});
  const Tracer t(s);
  const auto object_of = [&](const Vector& from, const Direction& d) {
    return t.closest(from, d).value().object;
  };
  EXPECT_EQ(object_of({0, 9, 0}, {0, -1, 0}), 1);
  EXPECT_EQ(object_of({0, 3, 0}, {0, -1, 0}), 2);
  EXPECT_EQ(object_of({0, 1.5, 0}, {0, -1, 0}), 0);
  EXPECT_EQ(object_of({0, 0, 0}, {0, -1, 0}), 0);  // from within
  EXPECT_LT(off(t.closest({0, 0, 0}, {0, -1, 0})->frame.z, {0, 1, 0}), 1e-15);
  EXPECT_EQ(object_of({2, 1.5, 0}, {0, -1, 0}), 3);
}

TEST(Tracer, TellsWhatLiesBetween) {
  const Scene s = scene_of({sphere({0, 0, 0}, 1), object(square(9, -3))});
  const Tracer t(s);
  const Direction up{0, 1, 0};
  EXPECT_TRUE(t.occluded({0, -3, 0}, up, up, infinite));
  EXPECT_TRUE(t.occluded({0, -3, 0}, up, up, 2.1));
  EXPECT_FALSE(t.occluded({0, -3, 0}, up, up, 1.9));
  EXPECT_FALSE(t.occluded({1.01, -3, 0}, up, up, infinite));
  EXPECT_TRUE(t.occluded({0, 1, 0}, {0, -1, 0}, {0, -1, 0}, infinite));
}

TEST(Tracer, CastsNoShadowOfASurfaceOnItself) {
  const auto far = square(3, 70);
  for (auto& p : far->positions) p[0] += 20;
  const Scene round = scene_of({sphere({30, 20, 10}, 2)}), flat = scene_of({object(far)});
  const auto expect_none = [](const Tracer& t, const Hit& hit) {
    for (std::size_t k = 0; k < 50; ++k)
      for (const double above : {1e-3, 1e-5}) {
        const Direction d = direction(std::numbers::pi / 2 - above, static_cast<double>(k));
        EXPECT_FALSE(t.occluded(hit.position, hit.frame.z, hit.frame.outside(d), 100));
      }
  };
  const Tracer of_round(round), of_flat(flat);
  for (std::size_t i = 0; i < 1000; ++i) {
    const Vector view = vector_of(spiral_direction(i, 1000));
    expect_none(of_round,
                of_round.closest(Vector{30, 20, 10} + 9.0 * view, direction(-1 * view)).value());
    expect_none(of_flat,
                of_flat.closest({20 + 2.9 * view.x, 70.5, 2.9 * view.z}, {0, -1, 0}).value());
  }
}

}  // namespace
}  // namespace gonio::scene
