#include "scene/plan/half.h"

#include <cmath>

#include "scene/plan/reference.h"
#include "scene/plan/scenes.h"

#include <gtest/gtest.h>

namespace gonio::scene {
namespace {

/// Median of how far halves are from double, relative to the brightest channel.
double median_error(const Material& m, std::string_view compensation = "kulla_conty") {
  const Scene s = test::sphere(m, test::front());
  const Lit lit(s);
  const Look& look = lit.looks[0];
  Forms forms = look.structural();
  const auto all = forms_of(Effect::compensation);
  forms[Effect::compensation] =
      static_cast<std::size_t>(std::ranges::find(all, compensation) - all.begin());
  const auto surface = look.surface(forms);
  const Reference reference(lit.drawer(0, 1).draw(1, 0, 512), surface);
  const auto half = radiance_in_half(surface, reference.points);
  std::vector<double> off;
  for (std::size_t i = 0; i < half.size(); ++i)
    if (reference.exact[i][0] > 0.01)
      off.push_back(std::abs(half[i][0] / reference.exact[i][0] - 1));
  std::ranges::sort(off);
  return off[off.size() / 2];
}

TEST(InHalf, IsTheSameSurfaceToThreeDigits) {
  for (const auto& m : test::six()) {
    const double off = median_error(m);
    EXPECT_LT(off, 0.02);
    EXPECT_GT(off, 1e-5);  // it is rounded
  }
}

TEST(InHalf, ComputesEveryCompensation) {
  for (const char* how : {"none", "turquin", "fdez_aguera"})
    EXPECT_LT(median_error(test::car_paint(), how), 0.02) << how;
}

TEST(InHalf, OverflowsAtAPeakThatHalvesCannotHold) {
  const auto at_peak = [](const char* alpha) {
    const Look look(test::material("ggx/smith_ggx.correlated/conductor", {alpha, "metal=Al"}));
    LitPoints p;
    p.count = 1;
    p.angles = {{{1, 1, 1, 1, 0}, 0, 0, 0, 0, 0, 0}};
    p.point = {0};
    p.weight = {{1, 1, 1}};
    return radiance_in_half(look.surface(look.structural()), p)[0][0];
  };
  EXPECT_TRUE(std::isfinite(at_peak("alpha=0.01")));
  EXPECT_FALSE(std::isfinite(at_peak("alpha=0.001")));  // 1/(π α²) = 318 310
}

}  // namespace
}  // namespace gonio::scene
