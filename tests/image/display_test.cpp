#include "image/display.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

TEST(Display, ExposesThenClips) {
  const Rgb c = displayed({0.1, 0.4, 8}, 2);
  EXPECT_DOUBLE_EQ(c[0], 0.2);
  EXPECT_DOUBLE_EQ(c[1], 0.8);
  EXPECT_EQ(c[2], 1);
  EXPECT_EQ(displayed({-1e-3, 0, 0}, 1)[0], 0);
}

// 0.5 and 0.2140 (which is 0.5 as a display's code) by the standard's formula
TEST(Display, CodesAsTheStandardSays) {
  EXPECT_EQ(srgb_byte(0), 0);
  EXPECT_EQ(srgb_byte(1), 255);
  EXPECT_EQ(srgb_byte(0.5), 188);
  EXPECT_EQ(srgb_byte(0.2140), 127);
  EXPECT_EQ(srgb_byte(0.001), 3);
  EXPECT_EQ(srgb_byte(7), 255);
  EXPECT_EQ(srgb_byte(-7), 0);
}

// CIELAB of sRGB's primaries under D65, as published calculators give it
TEST(Display, HasTheColoursOfItsPrimaries) {
  const auto expect = [](const Rgb& c, const Lab& published) {
    const Lab found = lab_of_display(c);
    EXPECT_NEAR(found.l, published.l, 0.02);
    EXPECT_NEAR(found.a, published.a, 0.05);
    EXPECT_NEAR(found.b, published.b, 0.05);
  };
  expect({1, 1, 1}, {100, 0, 0});
  expect({0, 0, 0}, {0, 0, 0});
  expect({1, 0, 0}, {53.24, 80.09, 67.20});
  expect({0, 1, 0}, {87.73, -86.18, 83.18});
  expect({0, 0, 1}, {32.30, 79.19, -107.86});
}

}  // namespace
}  // namespace gonio
