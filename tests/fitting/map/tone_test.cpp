// Photographs whose numbers are not the light of their lamps.
#include "fitting/map/tone.h"

#include <cmath>

#include "fitting/map/stack.h"
#include "fitting/map/survey.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

/// A stack whose light [of a white tile that faces the lamp, times its mean] is recorded otherwise.
StackSurvey look_recorded(const std::function<double(double light, double mean)>& record) {
  test::StackOptions o;
  o.texels = 96;
  o.images = 24;
  o.noise = test::Noise::relative;
  o.sigma = 0.01;
  auto s = test::stack(o);
  for (std::size_t t = 0; t < s.texels; ++t)
    for (std::size_t c = 0; c < 3; ++c) {
      double mean = 0;
      const auto cosine = [&](std::size_t i) { return double{s.light[3 * i + 2]}; };
      for (std::size_t i = 0; i < s.images; ++i)
        mean += double{s.values[s.at(i, c, t)]} * cosine(i) / static_cast<double>(s.images);
      for (std::size_t i = 0; i < s.images; ++i) {
        float& value = s.values[s.at(i, c, t)];
        value = static_cast<float>(record(double{value} * cosine(i), mean) / cosine(i));
      }
    }
  return survey(s.samples(), {});
}

constexpr double pi_ = 3.14159265358979;

TEST(Tone, OfPhotographsThatAreLinearIsTheirOwn) {
  const auto found = look_recorded([](double light, double) { return light; });
  EXPECT_FALSE(found.tone);
  EXPECT_LT(found.too_bright, 0.3);
}

TEST(Tone, OfACurveIsNamedBeforeAnotherModel) {
  const auto found =
      look_recorded([](double light, double) { return std::pow(pi_ * light, 1 / 2.2) / pi_; });
  ASSERT_TRUE(found.tone);
  EXPECT_EQ(found.tone->power, 2.2);
  const auto lines = warnings_of(found, {}, "m");
  ASSERT_FALSE(lines.empty());
  EXPECT_NE(lines[0].find("not to be linear"), lines[0].npos) << lines[0];
  for (const auto& line : lines) EXPECT_EQ(line.find("does not fit"), line.npos) << line;
}

TEST(Tone, OfLightOfTheRoomIsTakenOff) {
  const auto found = look_recorded([](double light, double mean) { return light + 0.25 * mean; });
  ASSERT_TRUE(found.tone);
  EXPECT_EQ(found.tone->room, 0.2);  // of the mean with it
  EXPECT_FALSE(found.tone->shadows);
}

TEST(Tone, OfCastShadowsThatALittleLightReachesIsNoLightOfTheRoom) {
  std::size_t call = 0;  // image within channel within texel
  const auto found = look_recorded([&](double light, double mean) {
    const std::size_t texel = call / (24 * 3), image = call % 24;
    ++call;
    return (image + texel / 16) % 4 == 0 ? 0.01 * mean : light;
  });
  ASSERT_TRUE(found.tone);
  EXPECT_TRUE(found.tone->shadows);
  const auto lines = warnings_of(found, {}, "m");
  ASSERT_FALSE(lines.empty());
  EXPECT_NE(lines[0].find("--floor"), lines[0].npos) << lines[0];
}

TEST(Tone, OfAWhiteThatIsTooDarkIsAScale) {
  const auto found = look_recorded([](double light, double) { return 4 * light; });
  ASSERT_TRUE(found.tone);
  EXPECT_LT(found.tone->scale, 1);
  EXPECT_GT(found.too_bright, 0.5);
}

}  // namespace
}  // namespace gonio
