#include "stack/mirror_ball.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <system_error>
#include <vector>

#include "base/error.h"
#include "base/file.h"
#include "base/quantile.h"
#include "stack/lamps.h"

#include <fmt/format.h>

namespace gonio {

Direction lamp_of_ball(ImageFile& image, const MirrorBall& ball) {
  constexpr double most_radius = 2048;
  const auto refuse = [&](const std::string& found, const std::string& expected) {
    throw bad_input(image.path(), fmt::format("ball {:g},{:g},{:g}", ball.x, ball.y, ball.radius),
                    found, expected);
  };
  const auto width = static_cast<double>(image.width()),
             height = static_cast<double>(image.height());
  if (!(ball.radius >= 4 && ball.radius <= most_radius && ball.x >= ball.radius &&
        ball.y >= ball.radius && ball.x + ball.radius <= width && ball.y + ball.radius <= height))
    refuse(fmt::format("an image of {} × {}", image.width(), image.height()),
           fmt::format("a ball within it, with a radius of 4 to {:g} pixels", most_radius));
  Rectangle part{static_cast<std::size_t>(ball.x - ball.radius),
                 static_cast<std::size_t>(ball.y - ball.radius), 0, 0};
  part.width = static_cast<std::size_t>(std::ceil(ball.x + ball.radius)) - part.x;
  part.height = static_cast<std::size_t>(std::ceil(ball.y + ball.radius)) - part.y;
  std::vector<float> light(part.size(), 0), plane(part.size());
  for (std::size_t c = 0; c < std::min<std::size_t>(3, image.channels().size()); ++c) {
    const std::vector<float*> to{plane.data()};
    image.read(part, std::vector<std::size_t>{c}, to);
    for (std::size_t k = 0; k < light.size(); ++k)
      if (std::isfinite(plane[k])) light[k] += plane[k];
  }
  // Where a pixel's middle is on the ball, in radii.
  const auto place = [&](std::size_t k) {
    const auto middle = [](std::size_t at) { return static_cast<double>(at) + 0.5; };
    return Vector{(middle(part.x + k % part.width) - ball.x) / ball.radius,
                  (ball.y - middle(part.y + k / part.width)) / ball.radius, 0};
  };
  std::vector<double> on_ball;
  std::size_t brightest = 0;
  for (std::size_t k = 0; k < light.size(); ++k) {
    if (const Vector p = place(k); dot(p, p) >= 1)
      light[k] = -1;  // not to be taken
    else
      on_ball.push_back(double{light[k]});
    if (light[k] > light[brightest]) brightest = k;
  }
  const std::size_t inside = on_ball.size();
  const double half = double{light[brightest]} / 2, around = median(on_ball);
  std::vector<std::size_t> next{brightest};
  std::size_t pixels = 0;
  Vector sum{0, 0, 0};
  while (half > 0 && !next.empty()) {
    const std::size_t k = next.back(), x = k % part.width, y = k / part.width;
    next.pop_back();
    if (light[k] < 0) continue;
    const Vector p = place(k);
    const double z2 = 1 - dot(p, p), z = std::sqrt(z2), v = double{light[k]};
    sum = sum + std::max(v - around, 0.0) * Vector{2 * z * p.x, 2 * z * p.y, 2 * z2 - 1};
    light[k] = -1;
    if (v <= half) continue;  // a neighbour
    ++pixels;
    for (std::size_t to_y = y - (y > 0); to_y <= std::min(y + 1, part.height - 1); ++to_y)
      for (std::size_t to_x = x - (x > 0); to_x <= std::min(x + 1, part.width - 1); ++to_x)
        next.push_back(to_y * part.width + to_x);
  }
  constexpr std::size_t part_of_ball = 20;
  if (pixels == 0 || part_of_ball * pixels > inside)
    refuse(fmt::format("{} of its {} pixels as bright as half of the brightest", pixels, inside),
           "a mirror ball with a small highlight of the lamp");
  if (!(sum.z > 0))
    refuse("a highlight near its rim: a lamp below the surface", "one of a lamp above the surface");
  return direction(sum);
}

Stack stack_of_ball(const std::string& folder,
                    const MirrorBall& ball,
                    const std::string& path,
                    bool linear,
                    const std::vector<std::string>& others) {
  namespace fs = std::filesystem;
  std::vector<std::string> files;
  std::error_code failed;
  for (const auto& entry : fs::directory_iterator(folder, failed)) {
    const std::string file = entry.path().string();
    if (is_image_name(file) &&
        std::ranges::none_of(others, [&](const auto& other) { return same_place(other, file); }))
      files.push_back(file);
  }
  if (files.empty())
    throw bad_input(folder, "images", failed ? failed.message() : "none",
                    "a folder of images that end in .exr, .npy, .png or .tif");
  std::ranges::sort(files);
  Stack s;
  s.path = path;
  s.values = StackValues::f_r_cosine;
  for (const std::string& file : files) {
    StackImage& image = s.images.emplace_back();
    image.path = name_in_stack(file, path, folder, "images");
    const Direction lamp = lamp_of_ball(*open_image(file, linear), ball);
    image.light = SideVector<Side::light>{{lamp.x, lamp.y, lamp.z}};
    image.view = SideVector<Side::view>{{0, 0, 1}};
  }
  return s;
}

}  // namespace gonio
