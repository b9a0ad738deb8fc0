#include "image/display.h"

#include <cmath>

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

TEST(Display, SeesAnAlbedoByItsFirstMiddleAndLastChannel) {
  const auto expect = [](const std::vector<double>& albedo, const Rgb& seen) {
    const Lab a = lab_of_albedo(albedo), b = lab_of_display(seen);
    EXPECT_EQ(a.l, b.l);
    EXPECT_EQ(a.a, b.a);
    EXPECT_EQ(a.b, b.b);
  };
  expect({0.3}, {0.3, 0.3, 0.3});
  expect({0.9, 0.5, 0.1}, {0.9, 0.5, 0.1});
  expect({0.9, 0.2, 0.5, 0.3, 0.1}, {0.9, 0.5, 0.1});
}

TEST(Display, SeesNoDifferenceBeyondItsWhite) {
  EXPECT_EQ(displayed_difference({7, 7, 7}, {2, 3, 4}, 1), 0);
  EXPECT_NEAR(displayed_difference({0, 0, 0}, {1, 1, 1}, 1), 100, 1e-3);
  EXPECT_NEAR(displayed_difference({0, 0, 0}, {1, 1, 1}, 2), 100, 1e-3);
  EXPECT_GT(displayed_difference({0.1, 0.1, 0.1}, {0.2, 0.2, 0.2}, 2),
            displayed_difference({0.1, 0.1, 0.1}, {0.2, 0.2, 0.2}, 0.01));
  EXPECT_TRUE(std::isinf(displayed_difference({std::nan(""), 0, 0}, {0, 0, 0}, 1)));
}

TEST(Display, ShowsChannelsThatAreNoColoursAsTheGreyOfTheirMean) {
  const std::array values{0.1, 0.2, 0.6};
  EXPECT_EQ(colour_of_channels({"r", "g", "b"}, values), (Rgb{0.1, 0.2, 0.6}));
  for (const double v : colour_of_channels({"351", "532", "633"}, values)) EXPECT_DOUBLE_EQ(v, 0.3);
  EXPECT_EQ(colour_of_channels({"f"}, std::span(values).first(1)), (Rgb{0.1, 0.1, 0.1}));
}

}  // namespace
}  // namespace gonio
