// Fits of what an instrument saw through cones: the truth, made by many directions and not by the
// fit's few, comes back.
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "base/error.h"
#include "fitting/fit.h"
#include "fitting/judge/warnings.h"
#include "fitting/plan/plan_next.h"
#include "fitting/support.h"
#include "table/format/measured_by.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

namespace gonio {
namespace {

using namespace test;

constexpr const char* gloss = "lambert+ggx/smith_ggx.correlated/schlick";

/// Directions of a cone: rings of equal solid angle, each turned against the one before.
std::vector<Direction> cone(const Direction& axis,
                            double width,
                            std::size_t rings,
                            std::size_t around) {
  if (width == 0) return {axis};
  const double theta = theta_of(axis), phi = phi_of(axis),
               height = 2 * std::pow(std::sin(width / 4), 2);
  std::vector<Direction> all;
  for (std::size_t r = 0; r < rings; ++r)
    for (std::size_t k = 0; k < around; ++k) {
      const double z = height * (static_cast<double>(r) + 0.5) / static_cast<double>(rings);
      const double turn = 2 * std::numbers::pi *
                          (static_cast<double>(k) + 0.382 * static_cast<double>(r)) /
                          static_cast<double>(around);
      const double s = std::sqrt(z * (2 - z)), x = s * std::cos(turn), y = s * std::sin(turn);
      const double tilted = x * std::cos(theta) + (1 - z) * std::sin(theta);
      all.push_back({tilted * std::cos(phi) - y * std::sin(phi),
                     tilted * std::sin(phi) + y * std::cos(phi),
                     (1 - z) * std::cos(theta) - x * std::sin(theta)});
    }
  return all;
}

/// What an instrument says of a model: in the plane of incidence, dense about the mirror direction.
Table seen(const BoundModel& b, const Aperture& aperture) {
  Table t;
  t.format = "csv";
  t.channels = {"f"};
  DirectionList l;
  Values values;
  for (const double theta_i : {15.0, 30.0, 45.0, 60.0})
    for (double off = -30; off <= 20; off += std::abs(off) < 1.5 ? 0.25 : 2.5) {
      l.theta_i_deg.push_back(theta_i);
      l.phi_i_deg.push_back(0);
      l.theta_o_deg.push_back(std::abs(theta_i + off));
      l.phi_o_deg.push_back(theta_i + off < 0 ? 0 : 180);
      const DirectionPair p{direction(theta_i * degree, 0),
                            direction(l.theta_o_deg.back() * degree, l.phi_o_deg.back() * degree)};
      const auto from = cone(p.wi, aperture.light, 12, 16),
                 to = cone(p.wo, aperture.detector, 6, 12);
      std::vector<FrameAngles<double>> angles;
      for (const auto& wi : from)
        for (const auto& wo : to) angles.push_back(frame_angles({wi, wo}));
      const auto f = evaluate(b, angles);
      double sum = 0, weight = 0;
      for (std::size_t k = 0; k < angles.size(); ++k) {
        sum += angles[k].nol * angles[k].nov * f[0][k];
        weight += angles[k].nol * angles[k].nov;
      }
      values.push_back(sum / weight);
    }
  t.where = std::move(l);
  t.values.push_back(std::move(values));
  return t;
}

/// A draw of it, by stated uncertainties.
Table drawn(Table t, double noise, std::uint64_t seed) {
  t.errors = t.values;
  std::uint64_t i = 0;
  for (std::size_t k = 0; k < t.size(); ++k) {
    const double part = k % 3 == 0 ? 3 * noise : noise;  // some worse than others, and said so
    t.errors[0][k] = part * t.values[0][k];
    std::uint64_t x =
        (seed * 1'000'003 + ++i) * 0x9E3779B97F4A7C15U;  // a normal variate of twelve uniform ones
    double z = -6;
    for (int n = 0; n < 12; ++n) {
      x ^= x >> 29;
      x *= 0xBF58476D1CE4E5B9U;
      x ^= x >> 32;
      z += static_cast<double>(x >> 11) * 0x1p-53;
    }
    t.values[0][k] *= 1 + part * z;
  }
  return t;
}

FitOptions plain() {
  return {.model = gloss, .bin_sensitivity = false};
}

TEST(Aperture, TwoBeamsOnOneGlossTileGiveOneAlpha) {
  const BoundModel truth = test::bind(gloss, "alpha=0.007,f0=0.04,kd=0.01", 1);
  std::array<double, 2> with{}, without{};
  const std::array beams{Aperture{0.7 * degree, 0}, Aperture{1.4 * degree, 0.2 * degree}};
  for (std::size_t k = 0; k < 2; ++k) {
    Table t = seen(truth, beams[k]);
    without[k] = parameter(fit(t, plain()).document, "alpha").limit[0];
    t.aperture = beams[k];
    const FitDocument d = fit(t, plain()).document;
    with[k] = parameter(d, "alpha").value[0];
    EXPECT_EQ(parameter(d, "alpha").status[0], ParameterStatus::free)
        << "the samples need not resolve it";
    EXPECT_NEAR(parameter(d, "f0").value[0], 0.04, 0.0008);
  }
  EXPECT_NEAR(with[0], 0.007, 0.0001);
  EXPECT_NEAR(with[1], 0.007, 0.0001);
  for (const double limit : without)
    EXPECT_FALSE(limit < 0.007) << "a limit without the aperture holds the truth";
}

TEST(Aperture, IsSeenByAnisotropicModels) {
  const char* model = "lambert+ggx_aniso/smith_ggx_aniso.correlated/schlick";
  const BoundModel truth = test::bind(model, "alpha_x=0.05,alpha_y=0.02,f0=0.5,kd=0.05", 1);
  const Table t =
      synthesize(truth, {.layout = Layout::random, .samples = 250}, {4 * degree, 3 * degree});
  const FitOptions o{.model = model, .bin_sensitivity = false};
  const FitDocument d = fit(t, o).document;
  EXPECT_NEAR(parameter(d, "alpha_y").value[0], 0.02, 1e-5);
  Table points = t;
  points.aperture = {};
  EXPECT_GT(std::abs(parameter(fit(points, o).document, "alpha_y").value[0] - 0.02), 1e-3);
}

TEST(Aperture, WiderThanTheLobeLeavesALimit) {
  const BoundModel truth = test::bind(gloss, "alpha=0.002,f0=0.04,kd=0.01", 1);
  Table t = seen(truth, {6 * degree, 4 * degree});
  t.aperture = {6 * degree, 4 * degree};
  const auto alpha = parameter(fit(t, plain()).document, "alpha");
  EXPECT_EQ(alpha.status[0], ParameterStatus::upper_limit);
  EXPECT_GT(alpha.limit[0], 0.002);
}

/// Draws whose 95 % interval holds alpha, of all.
double coverage(double alpha, const Aperture& aperture, std::size_t draws) {
  const BoundModel truth =
      test::bind(gloss, "alpha=" + std::to_string(alpha) + ",f0=0.04,kd=0.01", 1);
  Table clean = seen(truth, aperture);
  clean.aperture = aperture;
  std::vector<char> holds(draws);
  FitOptions o = plain();
  o.intervals = Intervals::independent;
  tbb::parallel_for(std::size_t{0}, draws, [&](std::size_t k) {
    const auto p = parameter(fit(drawn(clean, 0.02, k + 1), o).document, "alpha");
    holds[k] = p.ci95_low[0] <= alpha && alpha <= p.ci95_high[0];
  });
  return static_cast<double>(std::ranges::count(holds, 1)) / static_cast<double>(draws);
}

TEST(Aperture, IntervalsByStatedUncertaintiesHoldTheTruth) {
  // Of 40 draws 34 or more in all but 1 % of tests.
  EXPECT_GE(coverage(0.01, {0.7 * degree, 0.1 * degree}, 40), 0.85);
  if (!std::getenv("GONIO_LONG")) return;
  for (const double width : {0.3, 0.7, 1.4})
    for (const double alpha : {0.003, 0.01, 0.05}) {
      const double part = coverage(alpha, {width * degree, 0}, 200);
      RecordProperty(fmt::format("width {} alpha {}", width, alpha), fmt::to_string(part));
      EXPECT_GE(part, 0.91) << width << "° " << alpha;
      EXPECT_LE(part, 0.995) << width << "° " << alpha;
    }
  for (const double alpha : {0.05, 0.1, 0.3}) {
    const double part = coverage(alpha, {}, 400);
    RecordProperty(fmt::format("points alpha {}", alpha), fmt::to_string(part));
    EXPECT_GE(part, 0.92) << alpha;
    EXPECT_LE(part, 0.98) << alpha;
  }
}

TEST(StatedUncertainties, AreWeighedAndJudged) {
  const BoundModel truth = test::bind(gloss, "alpha=0.1,f0=0.04,kd=0.05", 1);
  const Table t = drawn(seen(truth, {}), 0.02, 7);
  const FitDocument d = fit(t, plain()).document;
  ASSERT_TRUE(d.residuals.chi2_per_freedom);
  EXPECT_NEAR(*d.residuals.chi2_per_freedom, 1, 0.35);
  EXPECT_EQ(d.uncertainty, "stated");
  Table equal = t;  // as if all were alike: the bad third then counts as much
  equal.errors.clear();
  const auto off = [&](const Table& table) {
    double sum = 0;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      Table x = drawn(seen(truth, {}), 0.02, seed);
      if (table.errors.empty()) x.errors.clear();
      sum += std::pow(parameter(fit(x, plain()).document, "alpha").value[0] / 0.1 - 1, 2);
    }
    return sum;
  };
  EXPECT_LT(off(t), 0.7 * off(equal));

  for (const double factor : {0.2, 5.0}) {  // of what is said over what is
    Table wrong = t;
    for (double& u : wrong.errors[0]) u *= factor;
    const FitDocument e = fit(wrong, plain()).document;
    EXPECT_NEAR(*e.residuals.chi2_per_freedom * factor * factor, *d.residuals.chi2_per_freedom,
                1e-3);
    EXPECT_TRUE(std::ranges::any_of(e.warnings, [](const auto& w) {
      return w.find("stated uncertainties") != w.npos;
    })) << factor;
    EXPECT_GT(parameter(e, "alpha").std_error[0], 0.4 * parameter(d, "alpha").std_error[0])
        << "intervals do not shrink by what the scatter denies";
  }
}

TEST(StatedUncertainties, OfTheTruthAreNoMisfitOfTheRightModel) {
  const Table clean =
      synthesize(test::bind(gloss, "alpha=0.2,f0=0.05,kd=0.3", 1), {.layout = Layout::hemisphere});
  Table t = drawn(clean, 0.02, 5);
  t.truth.reset();
  // Of the truth's value, not of the value: what is stated is then not in proportion to what was
  // drawn.
  for (std::size_t i = 0; i < t.size(); ++i)
    t.errors[0][i] = (i % 3 == 0 ? 0.06 : 0.02) * clean.values[0][i];
  for (const Metric metric : {Metric::log, Metric::uncertainty}) {
    FitOptions o = plain();
    o.metric = metric;
    const FitDocument d = fit(t, o).document;
    EXPECT_FALSE(d.misfit.told) << name_of(metric);
    EXPECT_LT(parameter(d, "alpha").std_error[0], 0.003) << name_of(metric);
  }
}

TEST(Aperture, IsKnownToAPlanOverFewSamples) {
  const Table t =
      synthesize(test::bind(gloss, "alpha=0.2,f0=0.05,kd=0.3", 1),
                 {.layout = Layout::random, .samples = 24, .noise = 0.02}, {degree, degree});
  EXPECT_EQ(plan_next(t, plain(), 2).size(), 2U);
}

TEST(StatedUncertainties, AreWhatTheirOwnMetricCounts) {
  const BoundModel truth = test::bind(gloss, "alpha=0.1,f0=0.04,kd=0.05", 1);
  const Table t = drawn(seen(truth, {}), 0.02, 3);
  FitOptions o = plain();
  o.metric = Metric::uncertainty;
  const FitDocument d = fit(t, o).document;
  EXPECT_NEAR(*d.residuals.chi2_per_freedom, 1, 0.35);
  EXPECT_NEAR(parameter(d, "alpha").value[0], 0.1, 0.004);
  Table none = t;
  none.errors.clear();
  EXPECT_THROW(fit(none, o), Error);
}

}  // namespace
}  // namespace gonio
