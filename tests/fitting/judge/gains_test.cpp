// Factors of angles are taken out of residuals whole, along one axis or two, and nothing else is.
#include "fitting/judge/gains.h"

#include <cmath>

#include <gtest/gtest.h>

namespace gonio::misfit {
namespace {

constexpr std::size_t incident = 0, detector = 4;

/// One channel at so many angles of the light times those of the detector.
Left left_of(std::size_t lights, std::size_t detectors) {
  Left left;
  left.unknowns = {{}};
  left.angles[incident] = lights;
  left.angles[detector] = detectors;
  for (std::size_t l = 0; l < lights; ++l)
    for (std::size_t d = 0; d < detectors; ++d) {
      Unit u{};
      u.angle[incident] = l;
      u.angle[detector] = d;
      u.count = 1;
      left.units.push_back(u);
      Value v{};
      v.unit = left.units.size() - 1;
      v.active = 1;
      v.change = 1 + 0.1 * static_cast<double>((3 * l + 5 * d) % 7);
      left.values.push_back(v);
    }
  return left;
}

TEST(Gains, AreTakenOutOfResidualsAlongOneAxisOrTwo) {
  const Left left = left_of(5, 8);
  std::vector<double> of_both;
  for (const auto& v : left.values) {
    const auto& at = left.units[v.unit].angle;
    of_both.push_back(v.change * (std::sin(3. * static_cast<double>(at[incident])) +
                                  std::cos(2. * static_cast<double>(at[detector]))));
  }
  const Gains both(left, {SharedAngle::incident, SharedAngle::detector});
  EXPECT_EQ(both.count(), 5U + 8 - 1) << "a factor of all values is one of either axis";
  const auto taken = both.taken_up(of_both);
  for (std::size_t i = 0; i < taken.size(); ++i) EXPECT_NEAR(taken[i], of_both[i], 1e-6);

  const Gains one(left, {SharedAngle::incident});
  EXPECT_EQ(one.count(), 5U);
  double left_over = 0;
  const auto part = one.taken_up(of_both);
  for (std::size_t i = 0; i < part.size(); ++i) left_over += std::abs(of_both[i] - part[i]);
  EXPECT_GT(left_over, 1) << "those of the detector are none of the light's";
}

TEST(Gains, OfValuesThatARobustFitClipsAreThoseOfTheOthers) {
  Left left = left_of(2, 10);
  std::vector<double> scores;
  for (auto& v : left.values) {
    v.change = 1;
    v.active = left.units[v.unit].angle[detector] == 0 ? 0 : 1;
    scores.push_back(v.active > 0 ? 0.5 : 0);
  }
  const Gains gains(left, {SharedAngle::incident});
  for (const double x : gains.taken_up(scores)) EXPECT_NEAR(x, 0.5, 1e-15);
}

}  // namespace
}  // namespace gonio::misfit
