// Lamps that are near: what six widths of the image do to normals and colours, and what their
// places mend.
#include <array>
#include <cmath>
#include <functional>

#include "brdf/model/evaluate.h"
#include "fitting/map/stacks.h"

#include <fmt/format.h>

namespace gonio {
namespace {

using namespace test;

constexpr std::size_t side = 16, lamps = 24;
constexpr double distance_in_widths = 6;
constexpr std::array<double, 3> kd{0.3, 0.2, 0.1};

struct Shape {
  std::function<double(double, double)> height;
  std::function<Vector(double, double)> normal;
};
const Shape flat{[](double, double) { return 0.0; },
                 [](double, double) {
                   return Vector{0, 0, 1};
                 }};
constexpr double radius = 1.5;
/// Part of a sphere whose corners lie at height 0.
const Shape sphere{[](double x, double y) {
                     return std::sqrt(radius * radius - x * x - y * y) -
                            std::sqrt(radius * radius - 0.5);
                   },
                   [](double x, double y) {
                     return Vector{x, y, std::sqrt(radius * radius - x * x - y * y)};
                   }};

/// Place of a texel's middle in widths.
std::array<double, 2> place(std::size_t t) {
  return {(static_cast<double>(t % side) + 0.5) / side - 0.5,
          0.5 - (static_cast<double>(t / side) + 0.5) / side};
}

/// Stack of a shape under lamps of one brightness at that distance, whose places it has, or only their directions.
std::string near_stack(const Folder& f, const Shape& shape, bool has_places) {
  const BoundModel paint = bind_model(
      "lambert+ggx/smith_ggx.correlated/schlick",
      parse_settings(std::vector<std::string>{"alpha=0.3", "f0=0.05", "kd=0.3,0.2,0.1"}), 3);
  Image heights{side, side, {"Y"}, {{}}, {}};
  for (std::size_t t = 0; t < side * side; ++t) {
    const auto [x, y] = place(t);
    heights.planes[0].push_back(static_cast<float>(shape.height(x, y)));
  }
  write_exr(f / "heights.exr", heights);
  std::string images;
  for (std::size_t k = 0; k < lamps; ++k) {
    const Direction towards = direction((12 + 16 * static_cast<double>(k % 4)) * degree,
                                        67.0 * static_cast<double>(k) * degree);
    const Vector at = distance_in_widths * vector_of(towards);
    Image i{side, side, {"R", "G", "B"}, {{}, {}, {}}, {}};
    for (std::size_t t = 0; t < side * side; ++t) {
      const auto [x, y] = place(t);
      const Vector to_lamp = at - Vector{x, y, shape.height(x, y)};
      const auto angles = frame_angles(
          within({direction(to_lamp), Direction{0, 0, 1}}, direction(shape.normal(x, y))));
      const auto values = evaluate(paint, std::vector{angles});
      const double light = std::max(angles.nol, 0.0) * dot(at, at) / dot(to_lamp, to_lamp);
      for (std::size_t c = 0; c < 3; ++c)
        i.planes[c].push_back(static_cast<float>(values[c][0] * light));
    }
    const std::string name = fmt::format("{}.exr", k);
    write_exr(f / name, i);
    images +=
        fmt::format(R"({}{{"path": "{}", "{}": [{}, {}, {}], "view": [0, 0, 1]}})", k ? ", " : "",
                    name, has_places ? "light_position" : "light", at.x, at.y, at.z);
  }
  return f.write(
      "stack.json",
      fmt::format(R"({{"schema": "gonio.stack/1", "values": "f_r_cosine", {} "images": [{}]}})",
                  has_places ? R"("width": 1, "heights": "heights.exr",)" : "", images));
}

struct Errors {
  double normal_deg = 0;  ///< the largest
  double kd = 0;          ///< the largest, relative
};
Errors errors_of(const std::string& map_path, const Shape& shape) {
  const Image map = read_exr(map_path);
  Errors e;
  for (std::size_t t = 0; t < side * side; ++t) {
    const auto [x, y] = place(t);
    const Vector n = vector_of(direction(shape.normal(x, y)));
    const Vector found{double{plane(map, "normal.X")[t]}, double{plane(map, "normal.Y")[t]},
                       double{plane(map, "normal.Z")[t]}};
    e.normal_deg = std::max(e.normal_deg, std::acos(std::min(1.0, dot(n, found))) / degree);
    const std::array names{"kd.R", "kd.G", "kd.B"};
    for (std::size_t c = 0; c < 3; ++c)
      e.kd = std::max(e.kd, std::abs(double{plane(map, names[c])[t]} / kd[c] - 1));
  }
  return e;
}

TEST(NearLamps, WithTheirPlacesGiveNormalsAndColoursThatFarOnesMiss) {
  TexelOptions refined;
  refined.refine_normals = true;
  for (const Shape* shape : {&flat, &sphere}) {
    SCOPED_TRACE(shape == &flat ? "plane" : "sphere");
    const Folder f;
    const Errors as_far =
        errors_of(fit_map(f, near_stack(f, *shape, false), refined, side, side, "far"), *shape);
    EXPECT_GT(as_far.normal_deg, 2) << "the ruler";
    const Errors near =
        errors_of(fit_map(f, near_stack(f, *shape, true), refined, side, side, "near"), *shape);
    EXPECT_LT(near.normal_deg, 0.05);
    EXPECT_LT(near.kd, 2e-3);
  }
}

}  // namespace
}  // namespace gonio
