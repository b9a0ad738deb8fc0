// Values that lie alone are told as such, not as the model's misfit; a wrong model's residuals are
// never taken for them.
#include "fitting/judge/outliers.h"

#include <algorithm>
#include <cmath>

#include "fitting/fit.h"
#include "fitting/support.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

constexpr const char* right = "lambert+ggx/smith_ggx.correlated/schlick";
constexpr const char* settings = "alpha=0.2,f0=0.05,kd=0.3";

FitDocument fitted(const Table& t, const char* model, bool robust = false) {
  FitOptions o;
  o.model = model;
  o.robust = robust;
  return fit(t, o).document;
}
bool proposes_huber(const FitDocument& d) {
  return std::ranges::any_of(d.next, [](const auto& s) { return s.starts_with("--robust huber"); });
}
Table hemisphere(const char* model, const char* set, double noise, double outliers, unsigned seed) {
  SynthOptions s{Layout::hemisphere};
  s.noise = noise;
  s.outliers = outliers;
  s.seed = seed;
  return synthesize(test::bind(model, set, 3), s);
}
bool hold(const FitDocument& d, const char* name, double truth) {
  const auto& p = *std::ranges::find(d.parameters, std::string_view(name), &FittedParameter::name);
  return p.ci95_low[0] <= truth && truth <= p.ci95_high[0];
}

TEST(Outliers, AreToldAsSuchAndTheIntervalsHoldTheTruth) {
  unsigned inside = 0, all = 0;
  for (unsigned seed = 1; seed <= 5; ++seed)
    for (const double share : {0.002, 0.01, 0.05}) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", " << share);
      const auto d = fitted(hemisphere(right, settings, 0.02, share, seed), right);
      EXPECT_TRUE(proposes_huber(d));
      EXPECT_FALSE(d.misfit.told);
      for (const auto& [name, truth] : {std::pair{"kd", 0.3}, {"alpha", 0.2}, {"f0", 0.05}})
        ++all, inside += hold(d, name, truth);
    }
  EXPECT_GE(inside, 0.9 * all);
}

TEST(Outliers, OfOneSlipOfAReadingAreTold) {
  Table t = hemisphere(right, settings, 0.02, 0, 1);
  t.values[0][t.size() / 2] *= 1000;
  const auto d = fitted(t, right);
  EXPECT_TRUE(proposes_huber(d));
  EXPECT_FALSE(d.misfit.told);
  EXPECT_FALSE(proposes_huber(fitted(t, right, true))) << "which it is already";
}

TEST(Outliers, AreNotWhatAWrongModelMisses) {
  for (const auto& [truth, set] :
       {std::pair{"lambert+gtr/smith_gtr.correlated/schlick",
                  "alpha=0.05,gamma=1.3,f0=0.05,kd=0.2"},
        {"lambert+ggx/smith_ggx.correlated/schlick+ggx/smith_ggx.correlated/schlick",
         "alpha=0.03,alpha_2=0.3,f0=0.04,f0_2=0.05,kd=0.1"},
        {"ggx/smith_ggx.correlated/conductor", "alpha=0.1,eta=0.2,k=3.9"},
        {"eon+ggx/smith_ggx.correlated/schlick", "kd=0.6,r=0.9,alpha=0.02,f0=0.04"}})
    for (const double noise : {0.0, 0.02}) {
      const auto d = fitted(hemisphere(truth, set, noise, 0, 1), right);
      EXPECT_TRUE(d.misfit.told) << truth;
      EXPECT_FALSE(proposes_huber(d)) << truth << ", noise " << noise;
    }
}

TEST(Outliers, AreAHighlightWhereTheyStandWhereTheLightComesFrom) {
  Table t = hemisphere(right, settings, 0.01, 0, 1);
  t.truth.reset();
  for (std::size_t i = 0; i < t.size(); ++i) {
    const auto [l, v] = SampleAngles(t).directions(i);
    const double apart =
        std::acos(std::clamp(l.x * v.x + l.y * v.y + l.z * v.z, -1.0, 1.0)) / degree;
    for (auto& plane : t.values) plane[i] += 0.5 * std::exp(-(apart / 3) * (apart / 3));
  }
  const auto d = fitted(t, right);
  EXPECT_TRUE(d.misfit.told);
  EXPECT_FALSE(proposes_huber(d));
  EXPECT_TRUE(
      std::ranges::any_of(d.next, [](const auto& s) { return s.starts_with("--mask 'retro"); }));
}

TEST(Outliers, BesideAWrongModelLeaveItsMisfitTold) {
  const auto d = fitted(hemisphere("lambert+gtr/smith_gtr.correlated/schlick",
                                   "alpha=0.2,gamma=1.3,f0=0.05,kd=0.1", 0.02, 0.01, 1),
                        right);
  EXPECT_TRUE(proposes_huber(d));
  EXPECT_TRUE(d.misfit.told);
}

}  // namespace
}  // namespace gonio
