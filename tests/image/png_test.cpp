#include "image/png.h"

#include "png_pixels.h"

#include <gtest/gtest.h>

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

  const auto read = test::png_pixels(bytes);
  EXPECT_EQ(read.width, 3U);
  EXPECT_EQ(read.height, 2U);
  EXPECT_EQ(read.pixels, image.pixels);
}

}  // namespace
}  // namespace gonio
