#include "stability/subject.h"

#include <cmath>

#include "base/error.h"
#include "brdf/catalogue/registry.h"
#include "geometry/half_difference.h"
#include "refusal.h"

#include <gtest/gtest.h>

namespace gonio::stability {
namespace {

std::vector<std::string> names(const Subject& s) {
  std::vector<std::string> all;
  for (const auto& i : s.inputs) all.push_back(i.name);
  return all;
}
using test::refusal;
using Names = std::vector<std::string>;

TEST(Subject, OfADistributionIsGivenByTheCrossProductAndByTheCosineAlone) {
  const auto ggx = subjects_of("ndf.ggx");
  ASSERT_EQ(ggx.size(), 2U);
  EXPECT_EQ(ggx[0].form(), "cross");
  EXPECT_EQ(names(ggx[0]), (Names{"alpha", "sin2_theta_h"}));
  EXPECT_EQ(ggx[1].form(), "cosine");
  EXPECT_EQ(names(ggx[1]), (Names{"alpha", "noh"}));
  EXPECT_EQ(ggx[0].inputs[0].domain.low, 1e-6);
  const auto shipped = subjects_of("ndf.ggx.mobile");  // a shader that reads NoH alone
  ASSERT_EQ(shipped.size(), 1U);
  EXPECT_EQ(shipped[0].form(), "cosine");
  EXPECT_EQ(names(subjects_of("ndf.ggx_aniso").at(0)),
            (Names{"alpha_x", "alpha_y", "sin2_theta_h", "cos_phi_h"}));
}

TEST(Subject, OfAMaskingIsGivenByDirectionsWhereItReadsTheHalfVector) {
  EXPECT_EQ(names(subjects_of("masking.smith_ggx.correlated").at(0)),
            (Names{"alpha", "nol", "nov"}));
  EXPECT_EQ(names(subjects_of("masking.cook_torrance").at(0)), (Names{"nol", "nov", "cos_phi"}));
  EXPECT_EQ(names(subjects_of("masking.smith_ggx_aniso.correlated").at(0)),
            (Names{"alpha_x", "alpha_y", "nol", "cos_phi_l", "nov", "cos_phi_v"}));
}

TEST(Subject, OfAModelHasItsParametersAndTwoDirections) {
  const auto s = subjects_of("lambert+ggx/smith_ggx.correlated/schlick");
  ASSERT_EQ(s.size(), 1U);
  EXPECT_EQ(names(s[0]), (Names{"kd", "alpha", "f0", "nol", "nov", "cos_phi"}));
  EXPECT_EQ(s[0].inputs[*s[0].decides].name, "alpha");
  EXPECT_FALSE(s[0].term);
}

TEST(Subject, OfEachTermHasAsManyInputsAsItsParametersAndAngles) {
  for (std::size_t term = 0; term < catalogue().size(); ++term)
    for (const auto& s : subjects_of_term(term)) {
      EXPECT_EQ(s.parameters, catalogue()[term].parameters.size()) << s.id;
      EXPECT_EQ(s.inputs.size(), s.parameters + angle_count(s.given)) << s.id;
      for (const auto& i : s.inputs)
        EXPECT_TRUE(i.legal.holds(i.domain.low) && i.legal.holds(i.domain.high))
            << s.id << ' ' << i.name;
    }
}

TEST(Subject, AnglesOfTwoDirectionsAreThoseOfThePair) {
  const DirectionPair pair{direction(0.7, 0), direction(1.1, 2.3)};
  const auto want = frame_angles(pair);
  const std::array in{pair.wi.z, pair.wo.z, std::cos(2.3)};
  const auto got = angles_of<double>(Given::directions, in);
  EXPECT_NEAR(got.noh, want.noh, 1e-15);
  EXPECT_NEAR(got.voh, want.voh, 1e-15);
  EXPECT_NEAR(got.sin2_theta_h, want.sin2_theta_h, 1e-15);
  EXPECT_EQ(got.nol, pair.wi.z);
  const std::array turned{pair.wi.z, 1.0, pair.wo.z, std::cos(2.3)};
  EXPECT_NEAR(angles_of<double>(Given::turned, turned).yov, want.yov, 1e-15);
}

TEST(Subject, AnglesOfOppositeDirectionsHaveNoHalfVector) {
  const std::array in{0.0, 0.0, -1.0};
  const auto a = angles_of<double>(Given::directions, in);
  EXPECT_EQ(a.noh, 0);
  EXPECT_EQ(a.voh, 0);
  EXPECT_EQ(a.sin2_theta_h, 1);
}

TEST(Subject, KnowsWhatPeopleClampAndWhereFormulasAreHardOnTheirOwn) {
  const auto decides = [](const char* id) {
    const auto s = subjects_of(id).at(0);
    return s.decides ? s.inputs[*s.decides].name : "";
  };
  EXPECT_EQ(decides("ndf.gtr"), "alpha");
  EXPECT_EQ(decides("ndf.ggx_aniso"), "alpha_x");
  EXPECT_EQ(decides("fresnel.schlick"), "f0");
  EXPECT_EQ(decides("masking.neumann"), "");
  const auto gtr = subjects_of("ndf.gtr").at(0);
  EXPECT_EQ(gtr.inputs[1].name, "gamma");
  EXPECT_EQ(gtr.inputs[1].edges, std::vector{1.0});
  EXPECT_EQ(subjects_of("fresnel.dielectric").at(0).inputs[0].edges, std::vector{1.0});
  EXPECT_TRUE(gtr.inputs[0].edges.empty());
  // Anisotropy up to 1e4, cosines from 1e-8.
  const auto aniso = subjects_of("masking.smith_ggx_aniso.correlated").at(0);
  EXPECT_EQ(aniso.inputs[0].domain.low, 1e-4);
  EXPECT_EQ(aniso.inputs[2].domain.low, 1e-8);
}

TEST(Subject, RefusesADomainThatIsNone) {
  auto s = subjects_of("ndf.ggx")[0];
  set_domain(s, "alpha", {0.05, 1});
  EXPECT_EQ(s.inputs[0].domain.low, 0.05);
  const double nan = std::nan("");
  EXPECT_HAS(refusal([&] { set_domain(s, "alpha", {1, 0.5}); }, Exit::usage), "reversed");
  EXPECT_HAS(refusal([&] { set_domain(s, "alpha", {nan, 1}); }, Exit::usage), "not a number");
  EXPECT_HAS(refusal([&] { set_domain(s, "alpha", {0.1, 2}); }, Exit::usage), "outside its range");
  EXPECT_HAS(refusal(
                 [&] {
                   set_domain(s, "noh", {0.1, 1});
                 },
                 Exit::usage),
             "it has: alpha, sin2_theta_h");
}

}  // namespace
}  // namespace gonio::stability
