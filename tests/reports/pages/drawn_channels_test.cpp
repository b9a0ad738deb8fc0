// Of thousands of channels a page draws a few, and of few all.
#include "reports/pages/drawn_channels.h"

#include <numeric>

#include "brdf/model/evaluate.h"
#include "reports/pages/inspect_page.h"
#include "table/health/health.h"
#include "tables.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

Table spectrum(std::size_t channels) {
  Table t = test::filled(test::in_out_grid(), bind_model("lambert", {}, 1));
  t.values.assign(channels, t.values[0]);
  t.channels.clear();
  for (std::size_t c = 0; c < channels; ++c) t.channels.push_back(std::to_string(400 + c));
  return t;
}

TEST(DrawnChannels, AreAllOfFewAndSpreadOverMany) {
  EXPECT_EQ(drawn_channels(3), (std::vector<std::size_t>{0, 1, 2}));
  const auto drawn = drawn_channels(4000);
  EXPECT_EQ(drawn.size(), 12U);
  EXPECT_EQ(drawn.front(), 0U);
  EXPECT_EQ(drawn.back(), 3999U);
  EXPECT_FALSE(of_drawn_channels(spectrum(12)));
  EXPECT_EQ(of_drawn_channels(spectrum(13))->channels.back(), "412");
}

TEST(DrawnChannels, OfAModelHaveItsValuesThere) {
  std::vector<double> kd(40);
  std::iota(kd.begin(), kd.end(), 1);
  for (double& x : kd) x /= 100;
  const BoundModel whole = bind_model("lambert+ggx/smith_ggx.correlated/schlick",
                                      {{"alpha", {0.3}}, {"f0", {0.04}}, {"kd", kd}}, 40);
  const BoundModel few = of_drawn_channels(whole);
  const std::vector<FrameAngles<double>> at{
      frame_angles(DirectionPair{direction(0.3, 0), direction(0.5, 2)})};
  const auto all = evaluate(whole, at), drawn = evaluate(few, at);
  const auto which = drawn_channels(40);
  ASSERT_EQ(drawn.size(), which.size());
  for (std::size_t k = 0; k < which.size(); ++k) EXPECT_EQ(drawn[k], all[which[k]]) << k;
}

TEST(DrawnChannels, KeepAPageOfASpectrumSmall) {
  const auto size = [](std::size_t channels) {
    const Table t = spectrum(channels);
    return to_json(make_inspect_page(t), "{}").size();
  };
  EXPECT_LT(size(600), 2 * size(12));
}

}  // namespace
}  // namespace gonio
