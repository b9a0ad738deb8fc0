#include "integrate/scattering/compensation.h"

#include <cmath>
#include <string>

#include "base/error.h"
#include "brdf/formula/scattering.h"
#include "constants.h"
#include "integrate/rule/quadrature.h"

namespace gonio {
namespace {

constexpr Compensation all[] = {Compensation::kulla_conty, Compensation::kulla_conty_linear,
                                Compensation::turquin, Compensation::fdez_aguera};
const std::vector<double> three_cosines{0.05, 0.4, 1};
using test::ln2;

BoundModel schlick(double alpha, std::vector<double> f0, const std::string& lobe = "") {
  return bind_model((lobe.empty() ? "ggx/smith_ggx.correlated" : lobe) + "/schlick",
                    {{"alpha", {alpha}}, {"f0", std::move(f0)}}, 1);
}

TEST(Compensation, GivesBackAllThatComesInAtFOne) {
  for (const auto how : all)
    for (const std::string lobe : {"ggx/smith_ggx.correlated", "ggx/smith_ggx.separable",
                                   "beckmann/smith_beckmann.correlated"})
      for (const double alpha : {0.1, 1.0})
        for (const auto& a : compensated_albedo(schlick(alpha, {1}, lobe), how, three_cosines, 0,
                                                {1e-6, 1'000'000})) {
          EXPECT_NEAR(a.value[0], 1, a.error) << lobe << " " << alpha;
          EXPECT_LE(a.error, 1e-6);
        }
}

/// The same reflectance f everywhere: E_single = f E, F_avg = f.
TEST(Compensation, AtAlphaOneIsMadeOfTheClosedForms) {
  const double f = 0.3, average = 4 / 3.0 * (1 - ln2);
  const auto model =
      bind_model("ggx/smith_ggx.correlated/constant", {{"alpha", {1}}, {"f0", {f}}}, 1);
  const auto kulla_conty = compensated_albedo(model, Compensation::kulla_conty, three_cosines);
  const auto linear = compensated_albedo(model, Compensation::kulla_conty_linear, three_cosines);
  const auto turquin = compensated_albedo(model, Compensation::turquin, three_cosines);
  for (std::size_t i = 0; i < three_cosines.size(); ++i) {
    const double mu = three_cosines[i], e = 1 - mu * std::log(1 + 1 / mu);
    const double more = f * average / (1 - f * (1 - average)) * (1 - e);
    EXPECT_NEAR(kulla_conty[i].value[0], f * e + f * more, kulla_conty[i].error + 1e-15);
    EXPECT_NEAR(linear[i].value[0], f * e + more, linear[i].error + 1e-15);
    EXPECT_NEAR(turquin[i].value[0], f * (e + f * (1 - e)), turquin[i].error + 1e-15);
  }
}

TEST(Compensation, ItsBoundIsTrue) {
  for (const auto how : all) {
    const auto fine =
        compensated_albedo(schlick(0.6, {0.5}), how, three_cosines, 0, {1e-11, 4'000'000});
    for (const double goal : {1e-3, 1e-5, 1e-7}) {
      const auto rough =
          compensated_albedo(schlick(0.6, {0.5}), how, three_cosines, 0, {goal, 4'000'000});
      for (std::size_t i = 0; i < three_cosines.size(); ++i) {
        EXPECT_NEAR(rough[i].value[0], fine[i].value[0], rough[i].error + fine[i].error);
        EXPECT_LE(rough[i].error, goal);
      }
    }
  }
}

TEST(Compensation, OfKullaContyAveragesToTheMapOfTheAverages) {
  const auto model = schlick(0.5, {0.4});
  const auto single = hemispherical_albedo(model), e = hemispherical_albedo(furnace(model));
  const auto average = compensated_average(model, Compensation::kulla_conty, {1e-7, 4'000'000});
  const std::array p{single.value[0], e.value[0], e.value[0], schlick_average(0.4)};
  EXPECT_NEAR(average.value[0], KullaConty<double>::apply(p)[0], average.error + 1e-7);
}

TEST(Compensation, IsOfEachLobeByItselfAndLeavesDiffuseTermsAsTheyAre) {
  const auto bound = [](const char* spec, std::vector<Setting> settings) {
    return bind_model(spec, std::move(settings), 3);
  };
  const std::vector<double> gold{1, 0.8, 0.3}, kd{0.2, 0.1, 0.05};
  const auto whole =
      bound("lambert+ggx/smith_ggx.correlated/schlick+ggx/smith_ggx.separable/schlick",
            {{"kd", kd}, {"alpha", {0.8}}, {"f0", {0.04}}, {"alpha_2", {0.4}}, {"f0_2", gold}});
  const auto first = bound("ggx/smith_ggx.correlated/schlick", {{"alpha", {0.8}}, {"f0", {0.04}}});
  const auto second = bound("ggx/smith_ggx.separable/schlick", {{"alpha", {0.4}}, {"f0", gold}});
  for (const auto how : all) {
    const auto sum = compensated_albedo(whole, how, three_cosines);
    const auto a = compensated_albedo(first, how, three_cosines);
    const auto b = compensated_albedo(second, how, three_cosines);
    for (std::size_t i = 0; i < three_cosines.size(); ++i)
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(sum[i].value[c], a[i].value[c] + b[i].value[c] + kd[c], 3e-8);
  }
}

TEST(Compensation, TakesWhatIsAnisotropic) {
  const auto m = bind_model("ggx_aniso/smith_ggx_aniso.correlated/schlick",
                            {{"alpha_x", {0.3}}, {"alpha_y", {0.8}}, {"f0", {1}}}, 1);
  const auto a = compensated_albedo(m, Compensation::kulla_conty, {{0.3}}, 0.5, {1e-5, 4'000'000});
  EXPECT_NEAR(a[0].value[0], 1, 1e-5);
}

TEST(Compensation, RefusesWhatItCannotDo) {
  const auto gold = bind_model("ggx/smith_ggx.correlated/conductor", {{"metal", {}, "Au"}});
  EXPECT_THROW(compensated_albedo(gold, Compensation::fdez_aguera, {{0.5}}), Error);
  EXPECT_THROW(compensated_albedo(schlick(0.5, {0.5}), Compensation::turquin, {{1.5}}), Error);
  EXPECT_THROW(compensated_albedo(gold, Compensation::turquin, {{0.5}}, HUGE_VAL), Error);
}

TEST(Compensation, ColourIsNearerTheTruthWithTheSquareOfFAverage) {
  const auto model = schlick(1, {0.5});
  const auto truth = half_space(model, three_cosines).at;
  const auto with = [&](Compensation how) {
    double worst = 0;
    const auto a = compensated_albedo(model, how, three_cosines);
    for (std::size_t i = 0; i < three_cosines.size(); ++i)
      worst = std::max(worst, std::abs(a[i].value[0] - truth[i].albedo[0]));
    return worst;
  };
  EXPECT_LT(with(Compensation::kulla_conty), 0.031);
  EXPECT_GT(with(Compensation::kulla_conty_linear), 0.085);
}

TEST(FresnelAverage, IsSchlicksClosedFormAndWhatIsKnownOfGlass) {
  const auto m = bind_model("ggx/smith_ggx.correlated/schlick", {{"f0", {0.04, 0.5, 1}}});
  const auto a = fresnel_average(m, m.model.lobes[0].fresnel);
  const double f0[] = {0.04, 0.5, 1};
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(a.value[c], schlick_average(f0[c]), 1e-12);
  const auto glass = bind_model("ggx/smith_ggx.correlated/dielectric", {{"eta", {1.5}}}, 1);
  EXPECT_NEAR(fresnel_average(glass, glass.model.lobes[0].fresnel).value[0], 0.0918, 5e-5);
}

TEST(WithDiffuse, AddsTheTermsThatTheWalkLeavesOut) {
  const auto model = bind_model("lambert+ggx/smith_ggx.correlated/schlick", {{"kd", {0.3}}}, 1);
  const auto d = diffuse_average(model, {1e-6, 1'000'000});
  EXPECT_NEAR(d.value[0], 0.3, d.error);
  const auto sum = with_diffuse({{0.1}, {0.01}, {{0.1}}, {0}, {{0.01}}, 1}, d);
  EXPECT_NEAR(sum.value[0], 0.4, 1e-6);
  EXPECT_GE(sum.error, 0.01);
}

}  // namespace
}  // namespace gonio
