#include "integrate/scattering/microsurface.h"

#include "base/error.h"
#include "brdf/catalogue/registry.h"
#include "refusal.h"

namespace gonio {
namespace {

std::string refusal(const std::string& spec) {
  return test::refusal([&] { microsurfaces(bind_model(spec, {})); }, Exit::usage);
}

TEST(Microsurface, HasTheSlopesTheWidthsAndTheFresnelOfItsLobe) {
  const auto ggx = microsurfaces(bind_model(
      "ggx/smith_ggx.correlated/schlick+beckmann_aniso/smith_beckmann_aniso.correlated/conductor",
      {{"alpha", {0.25}}, {"alpha_x_2", {0.5}}, {"alpha_y_2", {0.75}}}));
  ASSERT_EQ(ggx.size(), 2U);
  EXPECT_EQ(ggx[0].slopes, Microsurface::Slopes::ggx);
  EXPECT_EQ(ggx[0].alpha_x, 0.25);
  EXPECT_EQ(ggx[0].alpha_y, 0.25);
  EXPECT_EQ(ggx[0].fresnel.term, find_term("fresnel.schlick"));
  EXPECT_EQ(ggx[1].slopes, Microsurface::Slopes::beckmann);
  EXPECT_EQ(ggx[1].alpha_x, 0.5);
  EXPECT_EQ(ggx[1].alpha_y, 0.75);
  EXPECT_EQ(ggx[1].fresnel.term, find_term("fresnel.conductor"));
}

TEST(Microsurface, IsEveryCorrelatedSmithPairOfTheCatalogue) {
  for (const std::string name : {"ggx", "ggx_aniso", "beckmann", "beckmann_aniso"})
    EXPECT_EQ(refusal(name + "/smith_" + name + ".correlated/schlick"), "");
  EXPECT_EQ(refusal("lambert+ggx/smith_ggx.correlated/schlick"), "");
}

TEST(Microsurface, IsNoLobeOfAnotherDistributionOrMasking) {
  for (const std::string spec :
       {"gtr/smith_ggx.correlated/schlick", "ggx/smith_ggx.separable/schlick",
        "ggx/smith_beckmann.correlated/schlick", "beckmann/neumann/schlick", "ggx/none/schlick",
        "ggx/smith_ggx.correlated/schlick+blinn_phong/none/schlick"})
    EXPECT_NE(refusal(spec).find("is no surface to walk on"), std::string::npos) << spec;
  EXPECT_EQ(refusal("lambert"), "'lambert' has no lobe, so no facets to walk on");
}

}  // namespace
}  // namespace gonio
