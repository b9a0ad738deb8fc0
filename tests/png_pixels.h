#pragma once
/// \file
/// Pixels of a PNG, read by libpng.

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <png.h>

namespace gonio::test {

struct PngPixels {
  std::size_t width = 0, height = 0;
  std::vector<std::array<unsigned char, 3>> pixels;  ///< row by row from the top
};

inline PngPixels png_pixels(const std::string& bytes) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()), 0);
  image.format = PNG_FORMAT_RGB;
  PngPixels p{image.width, image.height, {}};
  p.pixels.resize(p.width * p.height);
  EXPECT_NE(png_image_finish_read(&image, nullptr, p.pixels.data(), 0, nullptr), 0);
  return p;
}

}  // namespace gonio::test
