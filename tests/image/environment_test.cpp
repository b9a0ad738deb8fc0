#include "image/environment.h"

#include <cmath>
#include <limits>

#include "image/exr.h"
#include "refusal.h"
#include "support.h"

namespace gonio {
namespace {

using test::Folder;

Image grey(std::size_t width, std::size_t height) {
  Image i;
  i.width = width;
  i.height = height;
  i.channels = {"B", "G", "R"};
  for (int c = 0; c < 3; ++c) {
    auto& plane = i.planes.emplace_back();
    for (std::size_t k = 0; k < width * height; ++k)
      plane.push_back(static_cast<float>(1000 * c + static_cast<int>(k)));
  }
  return i;
}

std::string complaint(const Folder& folder, const Image& i) {
  write_exr(folder / "e.exr", i);
  return test::refusal([&] { read_environment(folder / "e.exr"); });
}

TEST(Environment, ItsMiddleIsXItsLeftQuarterYItsTopZ) {
  const Folder folder;
  write_exr(folder / "e.exr", grey(8, 4));
  const auto e = read_environment(folder / "e.exr");
  const auto at = [&](const Direction& d) { return static_cast<int>(e(d)[2]); };  // blue: k
  constexpr double a = 0.01;
  EXPECT_EQ(at({1, a, a}), 1 * 8 + 3);
  EXPECT_EQ(at({1, -a, a}), 1 * 8 + 4);
  EXPECT_EQ(at({1, -a, -a}), 2 * 8 + 4);
  EXPECT_EQ(at({-a, 1, a}), 1 * 8 + 1);
  EXPECT_EQ(at({a, -1, a}), 1 * 8 + 5);
  EXPECT_EQ(at({-1, a, a}), 1 * 8 + 0);
  EXPECT_EQ(at({-1, -a, a}), 1 * 8 + 7);
  EXPECT_EQ(at({a, a / 2, 1}), 0 * 8 + 3);
  EXPECT_EQ(at({a, a / 2, -1}), 3 * 8 + 3);
  EXPECT_EQ(e({1, -a, a})[0], 2012);
  EXPECT_EQ(e({1, -a, a})[1], 1012);
}

TEST(Environment, EachTexelLiesAtItsAngles) {
  const Folder folder;
  write_exr(folder / "e.exr", grey(16, 8));
  const auto e = read_environment(folder / "e.exr");
  for (std::size_t j = 0; j < 8; ++j)
    for (std::size_t i = 0; i < 16; ++i)
      for (const double off : {0.01, 0.5, 0.99}) {
        const Direction d =
            direction(e.theta(static_cast<double>(j) + off), e.phi(static_cast<double>(i) + off));
        EXPECT_EQ(e(d), e.texel(i, j)) << i << " " << j;
      }
  for (const double z : {1.0, -1.0}) EXPECT_GE(e({0, 0, z})[0], 0);
}

TEST(Environment, RefusesWhatIsNoRadianceByItsPlace) {
  const Folder folder;
  for (const float v :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -1e6F}) {
    Image i = grey(8, 4);
    i.planes[1][8 + 3] = v;
    const auto line = complaint(folder, i);
    EXPECT_NE(line.find("pixel (3, 1): found G = "), line.npos) << line;
    EXPECT_EQ(line.find('\n'), line.npos);
  }
}

TEST(Environment, TakesAFewNegativeValuesForBlackAndCountsThem) {
  const Folder folder;
  Image i = grey(8, 4);
  i.planes[0][5] = i.planes[2][7] = -0.01F;
  EXPECT_EQ(complaint(folder, i), "");
  const auto e = read_environment(folder / "e.exr");
  EXPECT_EQ(e.negative, 2U);
  EXPECT_EQ(e.texel(5, 0)[2], 0);
}

TEST(Environment, RefusesOtherImages) {
  const Folder folder;
  EXPECT_NE(complaint(folder, grey(8, 8)).find("twice as wide as high"), std::string::npos);
  Image i = grey(8, 4);
  i.channels[2] = "Y";
  EXPECT_NE(complaint(folder, i).find("R among them"), std::string::npos);
}

TEST(Environment, ReadsMapsMadeElsewhere) {
  GONIO_NEEDS_SHARED(folder, "data/env");
  for (const char* name : {"/studio.exr", "/city.exr", "/courtyard.exr", "/interior.exr"}) {
    const auto e = read_environment(folder + name);
    EXPECT_EQ(e.width, 1024U);
    EXPECT_LT(e.negative, 10'000U);  // of lossy compression
  }
}

}  // namespace
}  // namespace gonio
