#include "image/png.h"

#include <gtest/gtest.h>
#include <png.h>

namespace gonio {
namespace {

TEST(Png, KeepsPixelsAndText) {
  PngImage image{3, 2, {}, {{"Software", "a test"}, {"seed", "7"}}};
  for (unsigned char i = 0; i < 6; ++i)
    image.pixels.push_back(
        {i, static_cast<unsigned char>(40 * i), static_cast<unsigned char>(255 - i)});
  const std::string bytes = png_bytes(image);
  EXPECT_NE(bytes.find(std::string("tEXtseed\0", 9) + '7'), bytes.npos);
  EXPECT_NE(bytes.find("sRGB"), bytes.npos);

  png_image read{};
  read.version = PNG_IMAGE_VERSION;
  ASSERT_NE(png_image_begin_read_from_memory(&read, bytes.data(), bytes.size()), 0);
  EXPECT_EQ(read.width, 3);
  EXPECT_EQ(read.height, 2);
  read.format = PNG_FORMAT_RGB;
  std::vector<std::array<unsigned char, 3>> pixels(6);
  ASSERT_NE(png_image_finish_read(&read, nullptr, pixels.data(), 0, nullptr), 0);
  EXPECT_EQ(pixels, image.pixels);
}

}  // namespace
}  // namespace gonio
