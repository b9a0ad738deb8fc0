// Anisotropic models are fitted with the azimuth of their tangent, in a table's own azimuths.
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <span>

#include "base/error.h"
#include "brdf/formula/widths.h"
#include "fitting/fit.h"
#include "fitting/solve/problem.h"
#include "fitting/support.h"
#include "many_fits.h"
#include "refusal.h"

#include <boost/math/distributions/binomial.hpp>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace gonio {
namespace {

constexpr auto ggx = "lambert+ggx_aniso/smith_ggx_aniso.correlated/schlick";

FitOptions options(const char* model) {
  FitOptions o;
  o.model = model;
  return o;
}
double value(const FitDocument& d, const std::string& name) {
  return test::parameter(d, name).value[0];
}

/// Widths with the wider first, and the tangent where the order of a fit has it.
struct Turned {
  double alpha_x, alpha_y, tangent;
};

void expect_found(const char* model,
                  const Turned& truth,
                  const Turned& expected,
                  const SynthOptions& how,
                  const std::string& others,
                  std::size_t channels) {
  const auto b = test::bind(model,
                            fmt::format("{},alpha_x={},alpha_y={},tangent={}", others,
                                        truth.alpha_x, truth.alpha_y, truth.tangent),
                            channels);
  const auto d = fit(synthesize(b, how), options(model)).document;
  const std::string where =
      fmt::format("{} {} {} {}", model, truth.alpha_x, truth.alpha_y, truth.tangent);
  EXPECT_NEAR(value(d, "alpha_x") / expected.alpha_x, 1, 1e-6) << where;
  EXPECT_NEAR(value(d, "alpha_y") / expected.alpha_y, 1, 1e-6) << where;
  EXPECT_NEAR(value(d, "tangent"), expected.tangent, 1e-6) << where;
  EXPECT_EQ(test::parameter(d, "tangent").status[0], ParameterStatus::free) << where;
  for (const auto& p : b.model.parameters) {
    if (p.about == &tangent_parameter || p.name.starts_with("alpha")) continue;
    for (std::size_t c = 0; c < p.count; ++c)
      EXPECT_NEAR(test::parameter(d, p.name).value[c] / b.values[p.first + c], 1, 1e-6)
          << where << " " << p.name;
  }
}

TEST(AnisotropicFit, FindsWidthsAndTangentOfDirectionsAtRandom) {
  const SynthOptions how{.layout = Layout::random, .samples = 3000};
  static constexpr std::array turned{Turned{0.2, 0.01, -44}, Turned{0.4, 0.1, 0},
                                     Turned{0.3, 0.15, 77}, Turned{0.5, 0.05, 133}};
  for (const char* model : {ggx, "lambert+ggx_aniso/smith_ggx_aniso.separable/schlick",
                            "lambert+beckmann_aniso/smith_beckmann_aniso.correlated/schlick"})
    for (const Turned& t : std::span(turned).first(test::few(turned.size())))
      expect_found(model, t, t, how, "f0=0.3,kd=0.2", 1);
  for (const Turned& t : {Turned{0.4, 0.2, 90}, {0.06, 0.02, 12}})
    expect_found("ggx_aniso/smith_ggx_aniso.correlated/schlick", t, t, how, "f0=0.6", 1);
}

TEST(AnisotropicFit, FindsWidthsAndTangentOfATableOfUtia) {
  GONIO_MANY_FITS();
  for (const Turned& t : {Turned{0.5, 0.05, 44.5}, {0.3, 0.1, 0}})
    expect_found(ggx, t, t, {.layout = Layout::utia}, "f0=0.04,0.05,0.06,kd=0.2,0.1,0.05", 3);
}

TEST(AnisotropicFit, HasOneAnswerForWidthsExchangedAndForHalfTurns) {
  const SynthOptions how{.layout = Layout::random, .samples = 1000};
  const auto expect = [&](const Turned& truth, const Turned& expected) {
    expect_found(ggx, truth, expected, how, "f0=0.3,kd=0.2", 1);
  };
  expect({0.1, 0.4, 20}, {0.4, 0.1, 110});
  expect({0.1, 0.4, 60}, {0.4, 0.1, -30});
  expect({0.4, 0.1, 200}, {0.4, 0.1, 20});
  expect({0.4, 0.1, 135 - 1e-3}, {0.4, 0.1, 135 - 1e-3});
  expect({0.4, 0.1, 135 + 1e-3}, {0.4, 0.1, -45 + 1e-3});
}

TEST(AnisotropicFit, HasIntervalsThatHoldTheTruthAsOftenAsTheySay) {
  GONIO_MANY_FITS();
  constexpr int tables = 60;
  // The wrap of the tangent lies within its interval.
  const auto b = test::bind(ggx, "alpha_x=0.3,alpha_y=0.2,tangent=134.9,f0=0.3,kd=0.2", 1);
  std::map<std::string, int> held;
  for (std::uint64_t seed = 1; seed <= tables; ++seed) {
    const Table t =
        synthesize(b, {.layout = Layout::random, .samples = 600, .noise = 0.02, .seed = seed});
    const auto d = fit(t, options(ggx)).document;
    for (const auto& p : b.model.parameters) {
      const auto& found = test::parameter(d, p.name);
      ASSERT_EQ(found.status[0], ParameterStatus::free) << p.name << " " << seed;
      double truth = b.values[p.first];
      if (p.name == "tangent" && found.value[0] < 45) truth -= 180;
      held[p.name] += found.ci95_low[0] <= truth && truth <= found.ci95_high[0];
    }
  }
  const boost::math::binomial_distribution<> counts(tables, 0.95);
  for (const auto& [name, count] : held) {
    EXPECT_GE(boost::math::cdf(counts, count), 1e-3) << name << " " << count;
    EXPECT_LT(count, tables + 1) << name;
  }
}

TEST(AnisotropicFit, SaysThatAnIsotropicTableHasNoTangent) {
  const auto b =
      test::bind("lambert+ggx/smith_ggx.correlated/schlick", "alpha=0.3,f0=0.3,kd=0.2", 1);
  for (const double noise : {0.0, 0.02}) {
    const Table t = synthesize(b, {.layout = Layout::random, .samples = 1000, .noise = noise});
    const auto d = fit(t, options(ggx)).document;
    const auto& tangent = test::parameter(d, "tangent");
    EXPECT_EQ(tangent.status[0], ParameterStatus::not_identifiable) << noise;
    EXPECT_FALSE(tangent.reason[0].empty());
    const double near = noise > 0 ? 0.05 : 1e-4;
    EXPECT_NEAR(value(d, "alpha_x") / 0.3, 1, near);
    EXPECT_NEAR(value(d, "alpha_y") / 0.3, 1, near);
  }
}

TEST(AnisotropicFit, LeavesWhatIsHeldOrBoundedWhereItIs) {
  const auto b = test::bind(ggx, "alpha_x=0.1,alpha_y=0.4,tangent=170,f0=0.3,kd=0.2", 1);
  const Table t = synthesize(b, {.layout = Layout::random, .samples = 1000});
  const auto with = [&](const char* fixed, const char* bounds) {
    FitOptions o = options(ggx);
    if (*fixed) o.fixed = parse_settings(std::vector<std::string>{fixed});
    if (*bounds) o.bounds = parse_settings(std::vector<std::string>{bounds});
    return fit(t, o).document;
  };
  const auto held = with("tangent=-10", "");
  EXPECT_EQ(test::parameter(held, "tangent").status[0], ParameterStatus::fixed);
  EXPECT_NEAR(value(held, "alpha_x"), 0.1, 1e-6);
  const auto bounded = with("", "tangent=150,220");
  EXPECT_NEAR(value(bounded, "tangent"), 170, 1e-5);
  EXPECT_NEAR(value(bounded, "alpha_x"), 0.1, 1e-6);
  const auto width = with("alpha_y=0.4", "");
  EXPECT_NEAR(value(width, "tangent"), -10, 1e-5);
  EXPECT_NEAR(value(width, "alpha_x"), 0.1, 1e-6);
}

TEST(AnisotropicFit, IsRefusedWhereTheTableSaysNothingOfTheTangent) {
  const auto b =
      test::bind("lambert+ggx/smith_ggx.correlated/schlick", "alpha=0.3,f0=0.3,kd=0.2", 3);
  std::set<std::string> reasons;
  for (const auto layout : {Layout::mbsdf, Layout::in_plane, Layout::hemisphere, Layout::random})
    reasons.insert(
        test::refusal([&] { fit(synthesize(b, {.layout = layout}), options(ggx)); }, Exit::usage));
  EXPECT_EQ(reasons.size(), 4U) << "each has its own, random none";
  EXPECT_TRUE(reasons.contains(""));
}

}  // namespace
}  // namespace gonio
