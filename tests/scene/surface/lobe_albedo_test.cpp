#include "scene/surface/lobe_albedo.h"

#include <cmath>

#include "integrate/albedo/directional_albedo.h"
#include "integrate/albedo/ggx_albedo.h"
#include "scene/plan/scenes.h"

#include <gtest/gtest.h>

namespace gonio::scene {
namespace {

TEST(LobeAlbedo, IsWithinWhatItSaysOfGgx) {
  for (const double alpha : {1e-4, 0.004, 0.01, 0.09, 0.3, 1.0}) {
    const auto curve = lobe_albedo(std::get<BoundModel>(
                                       test::material("ggx/smith_ggx.correlated/schlick",
                                                      {"alpha=" + std::to_string(alpha), "f0=0.5"})
                                           .is))
                           .curve;
    for (double mu = 1e-4; mu < 1; mu *= 1.3)
      EXPECT_NEAR(value_at(curve, mu), ggx_albedo(alpha, mu).value, 4.3e-5) << alpha << ' ' << mu;
  }
}

TEST(LobeAlbedo, HasTheAverageOverTheHemisphere) {
  const auto a = lobe_albedo(
      std::get<BoundModel>(test::material("ggx/smith_ggx.correlated/schlick", {"alpha=0.5"}).is));
  EXPECT_NEAR(a.average, ggx_average_albedo(0.5).value, 1e-4);
}

TEST(LobeAlbedo, OfOtherDistributionsFollowsTheirOwnIntegral) {
  for (const char* spec :
       {"beckmann/smith_beckmann.correlated/schlick", "gtr/smith_gtr.correlated/schlick"}) {
    const auto model = std::get<BoundModel>(test::material(spec, {"alpha=0.4", "f0=0.7"}).is);
    const auto a = lobe_albedo(model);
    for (const double mu : {0.05, 0.3, 0.9})
      EXPECT_NEAR(value_at(a.curve, mu), directional_albedo(furnace(model), {{mu}})[0].value[0],
                  2e-3)
          << spec << ' ' << mu;
  }
}

TEST(LobeAlbedo, OfAnAnisotropicLobeIsTheMeanOverAzimuths) {
  const auto model = std::get<BoundModel>(
      test::material("ggx_aniso/smith_ggx_aniso.correlated/schlick", {"alpha_x=0.6", "alpha_y=0.2"})
          .is);
  const auto a = lobe_albedo(model);
  double mean = 0;
  constexpr int n = 16;
  for (int i = 0; i < n; ++i)
    mean +=
        directional_albedo(furnace(model), {{0.4}}, (i + 0.5) * 2 * std::numbers::pi / n, {1e-5})[0]
            .value[0] /
        n;
  EXPECT_NEAR(value_at(a.curve, 0.4), mean, 2e-3);
}

}  // namespace
}  // namespace gonio::scene
