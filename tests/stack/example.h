#pragma once
/// \file
/// A stack of two images of 5 × 4 texels, as a file that tests change.

#include <string>
#include <vector>

#include "image/exr.h"
#include "support.h"

namespace gonio::test {

inline constexpr std::size_t stack_width = 5, stack_height = 4;

/// Value of a texel in an image's channel.
inline float stack_value(std::size_t image, std::size_t channel, std::size_t t) {
  return 0.25F * static_cast<float>(image + 1) + 0.125F * static_cast<float>(channel) +
         0.5F * static_cast<float>(t);
}

inline Image stack_image(std::size_t number, std::size_t width = stack_width) {
  Image i;
  i.width = width;
  i.height = stack_height;
  i.channels = {"B", "G", "R"};
  for (std::size_t c = 3; c-- > 0;) {
    auto& plane = i.planes.emplace_back();
    for (std::size_t t = 0; t < width * stack_height; ++t)
      plane.push_back(stack_value(number, c, t));
  }
  return i;
}

/// The same vector at every texel.
inline Image vector_image(float x, float y, float z) {
  Image i;
  i.width = stack_width;
  i.height = stack_height;
  i.channels = {"X", "Y", "Z"};
  for (const float v : {x, y, z}) i.planes.emplace_back(stack_width * stack_height, v);
  return i;
}

/// \param images  the array, as JSON  \param more  further keys
inline std::string write_stack(const Folder& f,
                               const std::string& images,
                               const std::string& more = "") {
  return f.write("stack.json", R"({"schema": "gonio.stack/1", "images": )" + images + more + "}");
}
inline constexpr const char* two_images =
    R"([{"path": "0.exr", "theta_i": 30, "phi_i": 90, "theta_o": 0},)"
    R"( {"path": "1.exr", "light": [3, 0, 4], "view": [0, 0, 2]}])";
/// Stack with its images.
inline std::string example_stack(const Folder& f, const std::string& more = "") {
  write_exr(f / "0.exr", stack_image(0));
  write_exr(f / "1.exr", stack_image(1));
  return write_stack(f, two_images, more);
}

}  // namespace gonio::test
