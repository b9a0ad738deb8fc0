#include "fitting/batch/preview.h"

#include <algorithm>
#include <cmath>

#include "base/base64.h"
#include "table/cut/cuts.h"
#include "tables.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

TEST(Preview, AlbedoOfALambertianIsItsKd) {
  const BoundModel coloured = bind_model("lambert", {{"kd", {0.2, 0.5, 0.8}}});
  const Preview p = make_preview(test::filled(test::in_out_grid(), coloured), coloured);
  EXPECT_EQ(p.albedo, (std::vector<double>{0.2, 0.5, 0.8}));
}

TEST(Preview, ThumbnailKeepsThePeakAndFewPoints) {
  const BoundModel sharp = bind_model("lambert+ggx/smith_ggx.correlated/schlick",
                                      {{"kd", {0.1, 0.1, 0.1}}, {"alpha", {0.01}}, {"f0", {0.04}}});
  const Table t = test::filled(test::half_difference_grid(), sharp);
  const Preview p = make_preview(t, sharp);
  ASSERT_TRUE(p.curve);
  const Thumbnail& c = *p.curve;
  EXPECT_EQ(c.at, "theta_i");
  EXPECT_LE(c.data_deg.size(), 60U);
  EXPECT_LE(c.model_deg.size(), 60U);
  EXPECT_TRUE(std::ranges::is_sorted(c.data_deg));
  const auto cuts = make_cuts(t, sharp);
  double largest = 0;
  for (const auto& cut : cuts)
    if (std::abs(cut.at_deg - c.at_deg) < 1e-6)
      for (std::size_t i = 0; i < cut.deg.size(); ++i)
        if (std::abs(cut.deg[i]) < 80) largest = std::max(largest, cut.model[0][i]);
  EXPECT_NEAR(std::ranges::max(c.model[0]), largest, 0.01 * largest);
}

TEST(Preview, ShowsFourCurvesOfASpectrum) {
  const BoundModel grey = bind_model("lambert", {{"kd", {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7}}});
  Table t = test::filled(test::in_out_grid(), grey);
  t.channels = {"400", "450", "500", "550", "600", "650", "700"};
  const Preview p = make_preview(t, grey);
  EXPECT_EQ(p.curve->channels, (std::vector<std::size_t>{0, 2, 4, 6}));
  ASSERT_EQ(p.curve->model.size(), 4U);
  EXPECT_NEAR(p.curve->model[1][0], 0.3 / 3.14159, 1e-3);
  EXPECT_EQ(p.albedo.size(), 7U);
}

TEST(Preview, SphereOfAWhiteLambertianIsWhiteToTheLightAndNothingOutside) {
  const Table t = test::filled(test::in_out_grid(), test::glossy());
  const Preview p = make_preview(t, bind_model("lambert", {{"kd", {1, 1, 1}}}));
  constexpr std::size_t n = Preview::size;
  const std::string pixels = from_base64(p.sphere);
  ASSERT_EQ(pixels.size(), n * n / 2 * 3);
  const auto red = [&](std::size_t row, std::size_t column) {
    return static_cast<unsigned char>(pixels[3 * (row * n / 2 + column)]);
  };
  EXPECT_EQ(red(0, n / 2 - 1), 0) << "a corner";
  EXPECT_GE(red(static_cast<std::size_t>(n / 2 * (1 - std::sin(40 * degree))), 0), 252);
  EXPECT_LT(red(n - 2, 0), 180) << "the side away from the light";
}

}  // namespace
}  // namespace gonio
