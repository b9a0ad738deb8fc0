#include "shader/traced_formula.h"

#include <numbers>
#include <random>

#include "base/error.h"
#include "brdf/catalogue/registry.h"
#include "brdf/formula/scattering.h"
#include "brdf/function/functions.h"
#include "refusal.h"
#include "stability/value_over.h"

#include <gtest/gtest.h>

namespace gonio::shader {
namespace {

TracedFormula traced(const std::string& spec,
                     const std::vector<std::string>& set = {},
                     const std::vector<std::string>& inputs = {},
                     const std::vector<std::string>& derivatives = {}) {
  return trace_model(bind_model(spec, parse_settings(set)), Precision::float_, inputs, derivatives);
}

std::vector<std::string> names(const std::vector<Argument>& arguments) {
  std::vector<std::string> all;
  for (const auto& a : arguments) all.push_back(a.name);
  return all;
}

TEST(TracedFormula, AsksForWhatItReadsAndNothingElse) {
  const auto f = traced("lambert.coupled+ggx/smith_ggx.correlated/schlick");
  EXPECT_EQ(names(f.parameters), (std::vector<std::string>{"kd", "alpha", "f0"}));
  EXPECT_EQ(names(f.angles),
            (std::vector<std::string>{"NoL", "NoV", "NoH", "VoH", "sin2_theta_h"}));
  EXPECT_TRUE(f.parameters[0].colour);
  EXPECT_FALSE(f.parameters[1].colour);
  EXPECT_TRUE(traced("lambert").angles.empty());
}

TEST(TracedFormula, FoldsWhatWasSetUnlessItShallStay) {
  const std::vector<std::string> set{"alpha=0.5", "f0=0.9,0.6,0.5"};
  const auto f = traced("ggx/smith_ggx.correlated/schlick", set);
  EXPECT_TRUE(f.parameters.empty());
  ASSERT_EQ(f.colours.size(), 1U);
  EXPECT_EQ(f.colours[0].value, (std::array<double, 3>{0.9F, 0.6F, 0.5}));
  const auto kept = traced("ggx/smith_ggx.correlated/schlick", set, {"alpha"});
  EXPECT_EQ(names(kept.parameters), std::vector<std::string>{"alpha"});
  EXPECT_LT(f.operations().total(), kept.operations().total());
}

TEST(TracedFormula, CountsWhatItSharesOnce) {
  const auto once = traced("ggx/smith_ggx.correlated/schlick"),
             twice = traced("ggx/smith_ggx.correlated/schlick+ggx/smith_ggx.correlated/schlick");
  EXPECT_LT(twice.operations().total(), 2 * once.operations().total() + 3)
      << "the power of 1 - VoH is one";
}

TEST(TracedFormula, RefusesNamesThatTheModelHasNot) {
  const auto refused = [](const std::vector<std::string>& set,
                          const std::vector<std::string>& inputs,
                          const std::vector<std::string>& derivatives) {
    return test::refusal([&] { traced("lambert", set, inputs, derivatives); }, Exit::usage);
  };
  EXPECT_HAS(refused({}, {"alpha"}, {}), "no parameter 'alpha'");
  EXPECT_HAS(refused({}, {}, {"alpha"}), "no parameter to derive by 'alpha'");
  EXPECT_HAS(refused({"kd=0.5"}, {}, {"kd"}), "no derivative by 'kd'");
}

TEST(TracedFormula, GivesBackWhatALobeLosesBetweenFacets) {
  const auto bound = bind_model("lambert.coupled+ggx/smith_ggx.correlated/schlick", {}, 1);
  const std::vector<std::string> all{"kd", "alpha", "f0"};
  const auto value = [&](const std::optional<Compensating>& c,
                         const std::vector<std::pair<std::string, double>>& more) {
    const auto f = trace_model(bound, Precision::float_, all, {}, c);
    std::vector<double> inputs;
    for (const auto& n : f.trace.nodes()) {
      if (n.kind != Trace::Kind::input) continue;
      double x = 0.5;  // angles that no two directions have will do: what is tested is the rule
      for (const auto& [name, v] : more)
        if (name == n.name) x = v;
      inputs.push_back(x);
    }
    return replay<double>(f.trace, inputs)[static_cast<std::size_t>(f.results[0].node)];
  };
  const double none = value({}, {}), black = value({}, {{"kd", 0}}),
               fresnel = 0.5 + 0.5 / 32;  // Schlick's of f0 = 1/2 at VoH = 1/2
  // The whole is the lobe and (1 - F) of the diffuse part.
  const double diffuse = 0.5 / std::numbers::pi * (1 - fresnel), lobe = none - diffuse;
  EXPECT_NEAR(black, lobe, 1e-6);
  const Compensating turquin{Compensation::turquin, AlbedoFrom::table};
  EXPECT_NEAR(value(turquin, {{"E_view", 0.8}}), none + lobe * 0.5 * (1 / 0.8 - 1), 1e-6);
  EXPECT_NEAR(value(turquin, {{"E_view", 1}}), none, 1e-6) << "nothing is lost";
  const Compensating fitted{Compensation::turquin, AlbedoFrom::fit};
  const double e = AlbedoFit<double>::apply(std::array{0.5, 0.5})[0];
  EXPECT_NEAR(value(fitted, {}), none + lobe * 0.5 * (1 / e - 1), 1e-5);
  const double average = 0.5 + 0.5 / 21;  // of Schlick's Fresnel
  const Compensating aguera{Compensation::fdez_aguera, AlbedoFrom::table};
  EXPECT_NEAR(value(aguera, {{"E_view", 0.8}}), none - lobe + lobe / (1 - average * (1 - 0.8)),
              1e-6);
  const Compensating kulla{Compensation::kulla_conty, AlbedoFrom::table};
  const double bounces = average * average * 0.9 / (1 - average * (1 - 0.9));
  EXPECT_NEAR(value(kulla, {{"E_light", 0.7}, {"E_view", 0.8}, {"E_average", 0.9}}),
              none + bounces * (1 - 0.7) * (1 - 0.8) / (std::numbers::pi * (1 - 0.9)), 1e-6);
}

TEST(TracedFormula, HasNoFittedAlbedoOfOtherLobes) {
  const auto refused = [](const char* spec, const Compensating& c) {
    return test::refusal(
        [&] { trace_model(bind_model(spec, {}, 1), Precision::float_, {}, {}, c); }, Exit::usage);
  };
  const Compensating fitted{Compensation::turquin, AlbedoFrom::fit};
  EXPECT_HAS(refused("ggx/smith_ggx.separable/schlick", fitted), "fitted albedo");
  EXPECT_HAS(refused("lambert", fitted), "no lobe");
  EXPECT_HAS(
      refused("ggx/smith_ggx.correlated/schlick", {Compensation::kulla_conty, AlbedoFrom::fit}),
      "not for kulla_conty");
}

/// Slopes against differences of the same product rule in doubles; constants of the graph are floats.
TEST(TracedFormula, HasTheSlopesOfItsValue) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> in(0.2, 0.9);
  for (const char* spec :
       {"lambert.coupled+ggx/smith_ggx.correlated/schlick", "gtr/smith_ggx.separable/dielectric",
        "disney+beckmann/smith_beckmann.correlated/conductor"}) {
    const Model m = compose(spec, 1);
    std::vector<std::string> all;
    for (const auto& p : m.parameters) all.push_back(p.name);
    BoundModel b{m, std::vector<double>(m.value_count, 0.5), {}};
    const auto f = trace_model(b, Precision::float_, {}, all);
    ASSERT_EQ(f.results.size(), all.size() + 1);
    for (int i = 0; i < 20; ++i) {
      std::vector<double> p, inputs;
      for (const auto& q : m.parameters) p.push_back(q.name == "eta" ? 1 + in(random) : in(random));
      const Angles<double> a{in(random), in(random), in(random), in(random), in(random)};
      for (const auto& n : f.trace.nodes()) {
        if (n.kind != Trace::Kind::input) continue;
        double x = 0;
        for (std::size_t k = 0; k < all.size(); ++k)
          if (all[k] == n.name) x = p[k];
        const std::pair<const char*, double> angles[] = {{"NoL", a.nol},
                                                         {"NoV", a.nov},
                                                         {"NoH", a.noh},
                                                         {"VoH", a.voh},
                                                         {"sin2_theta_h", a.sin2_theta_h}};
        for (const auto& [name, angle] : angles)
          if (n.name == name) x = angle;
        inputs.push_back(x);
      }
      const auto x = replay<double>(f.trace, inputs);
      for (std::size_t k = 0; k < all.size(); ++k) {
        const double step = 1e-6;
        const auto at = [&](double by) {
          auto q = p;
          q[k] += by;
          return stability::value_over<double>(m, q, FrameAngles<double>{a, 0, 0, 0, 0, 0, 0});
        };
        const double slope = (at(step) - at(-step)) / (2 * step);
        EXPECT_NEAR(x[static_cast<std::size_t>(f.results[k + 1].node)], slope,
                    1e-5 * std::max(1.0, std::abs(slope)))
            << spec << " by " << all[k];
      }
    }
  }
}

}  // namespace
}  // namespace gonio::shader
