// Which azimuths belong to a surface, by the curl of its normals.
#include "fitting/map/curl.h"

#include <array>
#include <cmath>
#include <functional>
#include <random>

#include <gtest/gtest.h>

namespace gonio {
namespace {

using SlopesAt = std::function<std::array<double, 2>(double x, double y)>;

/// Normals of pieces of a surface with noise, read under a light whose y is `mirrored`.
std::array<TurnOfNormals, 3> seen(const SlopesAt& slopes,
                                  double mirrored,
                                  double noise = 0.0017,
                                  std::size_t pieces = 24,
                                  std::size_t side = 33) {
  std::mt19937 random(5);
  std::normal_distribution<double> off(0, noise);
  std::uniform_int_distribution<int> place(0, 500);
  TexelSample s;
  s.block_width = side;
  s.block = side * side;
  s.texels = pieces * s.block;
  std::vector<float> normals(3 * s.texels);
  for (std::size_t t = 0; t < s.texels;) {
    const int x0 = place(random), y0 = place(random);
    for (std::size_t k = 0; k < s.block; ++k, ++t) {
      const auto [p, q] =
          slopes(x0 + static_cast<double>(k % side), y0 - static_cast<double>(k / side));
      const std::array<double, 3> n{-p + off(random), mirrored * (-q + off(random)), 1};
      for (std::size_t a = 0; a < 3; ++a) normals[a * s.texels + t] = static_cast<float>(n[a]);
    }
  }
  return turns_of_normals(s, normals);
}

void expect_known(const SlopesAt& slopes, double noise = 0.0017) {
  for (const auto& t : seen(slopes, 1, noise))
    EXPECT_EQ(t.verdict, AzimuthVerdict::excluded) << t.turn;
  const auto negated = seen(slopes, -1, noise);
  EXPECT_EQ(negated[0].turn, 0U);
  EXPECT_EQ(negated[0].verdict, AzimuthVerdict::right);
  EXPECT_LT(negated[0].ratio, 0.5);
}

/// Of the height 20 h sin(x / 20) cos(y / 33 + x / 50).
SlopesAt gentle(double height) {
  return [=](double x, double y) {
    const double a = x / 20, b = y / 33 + x / 50;
    return std::array{height * (std::cos(a) * std::cos(b) - 0.4 * std::sin(a) * std::sin(b)),
                      -height * 20 / 33 * std::sin(a) * std::sin(b)};
  };
}

/// Threads of a cloth, each with its own slope along itself and steps between them.
SlopesAt threads(int period) {
  return [=](double x, double y) {
    const auto i = static_cast<int>(x + 10'000), j = static_cast<int>(y + 10'000);
    const bool up = (i / period + j / period) % 2;
    const double slope =
        0.175 * std::sin(2 * 3.14159265 * ((up ? j : i) % period) / period - 3.14159265);
    return std::array{up ? 0 : slope, up ? slope : 0};
  };
}

TEST(Curl, OfWideLoopsKnowsWhatSmallOnesDoNotTell) {
  const SlopesAt ball = [](double x, double y) {
    const double r = 450, z = std::sqrt(r * r - (x - 250) * (x - 250) - (y - 250) * (y - 250));
    return std::array{-(x - 250) / z, -(y - 250) / z};
  };
  expect_known(ball);
  EXPECT_NE(seen(ball, -1, 0.0017, 200, 2)[0].verdict, AzimuthVerdict::right);
}

TEST(Curl, OfCreasesBetweenFacetsIsKnown) {
  expect_known([](double x, double y) {
    const double period = 40, u = std::fmod(x + 1e4, period) - period / 2,
                 v = std::fmod(y + 1e4, period) - period / 2;
    const double side = std::copysign(0.5, u), end = std::copysign(0.5, v);
    return std::abs(u) > std::abs(v) ? std::array{-side, 0.0} : std::array{0.0, -end};
  });
}

TEST(Curl, OfStepsBetweenThreadsAccusesNoAzimuth) {
  for (const int period : {3, 4, 5, 8, 12, 13, 16, 24, 32, 43})
    for (const auto& t : seen(threads(period), 1))
      EXPECT_NE(t.verdict, AzimuthVerdict::right) << period << " " << t.turn;
}

TEST(Curl, LeavesOpenWhatASurfaceDoesNotSay) {
  // The mirror image of a sum of functions of x and of y is another such sum.
  const SlopesAt sum = [](double x, double y) {
    return std::array{0.3 * std::cos(0.2 * x), 0.3 * std::sin(0.2 * y)};
  };
  for (const double mirrored : {1, -1}) {
    const auto found = seen(sum, mirrored);
    EXPECT_EQ(found[0].verdict, AzimuthVerdict::open);
    EXPECT_EQ(found[1].verdict, AzimuthVerdict::excluded);
    EXPECT_EQ(found[2].verdict, AzimuthVerdict::excluded);
  }
  for (const auto& t : seen(gentle(0), -1)) EXPECT_EQ(t.verdict, AzimuthVerdict::open) << t.turn;
}

TEST(Curl, OfFewLoopsDecidesNothing) {
  for (const auto& t : seen(gentle(0.1), -1, 0.0025, 4, 3))
    EXPECT_EQ(t.verdict, AzimuthVerdict::open) << t.turn;
  expect_known(gentle(0.1), 0.0025);
}

}  // namespace
}  // namespace gonio
