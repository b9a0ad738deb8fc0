#include "fitting/export/surface.h"

#include <array>
#include <cmath>

#include "fitting/export/placement.h"
#include "optics/fresnel.h"

namespace gonio {
namespace {

BoundModel bound(const char* spec, const char* settings) {
  return bind_model(spec, parse_settings(std::vector<std::string>{settings}), 3);
}

double conductor(double cosine, double eta, double k) {
  Angles<double> a{};
  a.voh = cosine;
  return as_value<double>(Conductor<double>(std::array{eta, k})(a));
}

TEST(SurfaceOfAFit, TellsReflectanceApartFromWeight) {
  const auto s = surface_of(bound("lambert+ggx/smith_ggx.correlated/schlick.weighted",
                                  "alpha=0.3,f0=0.05,0.1,0.2,weight=0.5,kd=0.3"));
  ASSERT_EQ(s.lobes.size(), 1U);
  EXPECT_EQ(s.lobes[0].weight, 0.5);
  EXPECT_NEAR(s.lobes[0].f0[2], 0.2, 1e-15);
  EXPECT_NEAR(s.lobes[0].f82_tint[2], 1, 1e-12);
  EXPECT_EQ(s.lobes[0].alpha_x, 0.3);
  EXPECT_EQ(s.lobes[0].alpha_y, 0.3);
  EXPECT_EQ(s.largest_kd(), 0.3);
  EXPECT_FALSE(s.lobes[0].is_metal());
}

TEST(SurfaceOfAFit, FindsAnIndexThatReflectsAsTheFitDoes) {
  const auto s = surface_of(
      bound("ggx/smith_ggx.correlated/f82", "alpha=0.3,f0=0.9,0.6,0.3,f82_tint=0.95,0.9,0.97"));
  for (std::size_t c = 0; c < 3; ++c) {
    const auto& l = s.lobes[0];
    EXPECT_NEAR(conductor(1, l.eta[c], l.k[c]), l.f0[c], 1e-9);
    const double schlick = l.f0[c] + (1 - l.f0[c]) * std::pow(6.0 / 7, 5);
    EXPECT_NEAR(conductor(1.0 / 7, l.eta[c], l.k[c]), l.f82_tint[c] * schlick, 0.05);
  }
  EXPECT_TRUE(s.lobes[0].is_metal());
  const auto glass = surface_of(bound("ggx/smith_ggx.correlated/schlick", "alpha=0.3,f0=0.04"));
  EXPECT_NEAR(glass.lobes[0].eta[0], 1.5, 1e-12);
  EXPECT_EQ(glass.lobes[0].k[0], 0);
}

TEST(SurfaceOfAFit, ResolvesTheMetallicWorkflow) {
  const auto s =
      surface_of(bound("lambert.metallic.coupled+ggx/smith_ggx.separable/schlick.metallic",
                       "alpha=0.3,base_color=0.5,metallic=0.5"));
  EXPECT_NEAR(s.kd[0], 0.25, 1e-15);
  EXPECT_NEAR(s.lobes[0].f0[0], 0.27, 1e-15);
}

TEST(Placement, HasTheColourBelowAndTheWeakerLobeAsCoat) {
  const auto s = surface_of(bound(
      "lambert+ggx/smith_ggx.correlated/schlick.weighted+ggx/smith_ggx.correlated/schlick.weighted",
      "alpha=0.1,f0=0.04,weight=0.5,kd=0.3,alpha_2=0.4,f0_2=0.08,weight_2=1"));
  const auto all = placements(s);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].base, &s.lobes[1]);
  EXPECT_EQ(all[0].coat, &s.lobes[0]);
  EXPECT_EQ(all[1].base, &s.lobes[0]);
}

TEST(Placement, TurnsAFrameAsAnAzimuth) {
  for (const double degrees : {-200.0, -10.0, 0.0, 100.0, 359.0}) {
    const double t = turns_of(degrees);
    EXPECT_TRUE(0.25 <= t && t < 0.75) << degrees;
    const double halves = 2 * (t - degrees / 360);
    EXPECT_NEAR(halves, std::round(halves), 1e-12) << degrees;
  }
  SurfaceLobe l;
  l.alpha_x = 0.1, l.alpha_y = 0.4;
  const auto stretch = stretch_of(l, 20);
  EXPECT_EQ(stretch.wide, 0.4);
  EXPECT_EQ(stretch.tangent_deg, 110);
  FrameAngles<double> a{};
  a.xol = 0, a.yol = 1;
  const auto b = turned(a, 0, 1);  // the tangent where the bitangent was
  EXPECT_NEAR(b.xol, 1, 1e-15);
  EXPECT_NEAR(b.yol, 0, 1e-15);
}

}  // namespace
}  // namespace gonio
