// One pass over all samples tells what a fit is worth.
#include "fitting/judge/assess.h"

#include <cmath>
#include <set>

#include "fitting/support.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace gonio {
namespace {

using test::Case;
using test::layouts_that_fold;
using test::meat;
using test::paint;
using test::small;

TEST(Folding, ChangesNothingThatAnAssessmentSays) {
  for (const Case& c : layouts_that_fold())
    for (const bool by_angle : {false, true}) {
      const auto a = assess(c.sampling(Metric::log), c.at_off(), c.free, no_huber, by_angle);
      const auto b = assess(c.sampling(Metric::log, true), c.at_off(), c.free, no_huber, by_angle);
      EXPECT_EQ(a.incident_angles, b.incident_angles);
      EXPECT_NEAR(a.residuals.rms, b.residuals.rms, 1e-11 * a.residuals.rms);
      ASSERT_EQ(a.residuals.bands.size(), b.residuals.bands.size());
      for (std::size_t i = 0; i < a.residuals.bands.size(); ++i) {
        EXPECT_EQ(a.residuals.bands[i].values, b.residuals.bands[i].values) << i;
        EXPECT_NEAR(a.residuals.bands[i].log_rms, b.residuals.bands[i].log_rms, 1e-10);
      }
      for (std::size_t i = 0; i < 8; ++i)
        for (std::size_t k = 0; k < 8; ++k) {
          const auto &x = a.sandwich, &y = b.sandwich;
          EXPECT_NEAR(x.bread(i, k), y.bread(i, k),
                      1e-11 * std::sqrt(x.bread(i, i) * x.bread(k, k)));
          EXPECT_NEAR(meat(x, i, k), meat(y, i, k),
                      1e-11 * std::sqrt(meat(x, i, i) * meat(x, k, k)));
        }
    }
}

TEST(Assessment, BreadsOfIncidentAnglesAddUpToTheWhole) {
  constexpr std::size_t channels = 40;  // enough for each to have a block of its own
  Setting kd{"kd", {}};
  for (std::size_t c = 0; c < channels; ++c)
    kd.values.push_back(0.1 + 0.01 * static_cast<double>(c));
  const auto model = bind_model("lambert+ggx/smith_ggx.correlated/schlick",
                                {{"alpha", {0.3}}, {"f0", {0.05}}, kd}, channels);
  const Table t = synthesize(model, {.layout = Layout::in_plane, .noise = 0.05});
  const FreeSlots free(model.model, std::vector<bool>(model.values.size(), true));
  ASSERT_FALSE(free.layout()->arms().empty());
  const Sampling s(t, t.bins(), Metric::log, 0, false);
  const auto a = assess(s, model, free, no_huber, true);
  ASSERT_EQ(a.sandwich.clusters.size(), 5U);
  for (std::size_t i = 0; i < free.size(); ++i)
    for (std::size_t k = 0; k < free.size(); ++k) {
      double sum = 0;
      for (const auto& g : a.sandwich.clusters) sum += g.bread(i, k);
      const auto& all = a.sandwich.bread;
      EXPECT_NEAR(sum, all(i, k), 1e-9 * std::sqrt(all(i, i) * all(k, k))) << i << " " << k;
    }
}

TEST(Assessment, PutsEverySampleIntoItsBands) {
  // Beside each edge, where a look-up may slip: θ_h of samples in the plane of incidence.
  const std::vector<double> edges{0, 1, 3, 8, 20, 45, 90};
  Table t;
  t.format = "csv";
  t.channels = {"f"};
  DirectionList l;
  std::vector<std::size_t> expected(edges.size() - 1);
  for (std::size_t band = 0; band + 1 < edges.size(); ++band)
    for (const double part : {0.002, 0.02, 0.3, 0.5, 0.97, 0.998}) {
      const double theta_h = edges[band] + part * (edges[band + 1] - edges[band]);
      l.theta_i_deg.push_back(theta_h);  // wi = wo = h
      l.theta_o_deg.push_back(theta_h);
      l.phi_i_deg.push_back(0);
      l.phi_o_deg.push_back(0);
      ++expected[band];
    }
  t.where = l;
  t.values.emplace_back(l.theta_i_deg.size()).assign(l.theta_i_deg.size(), 0.1);
  const auto m = bind_model("lambert", parse_settings(std::vector<std::string>{"kd=0.3"}), 1);
  const Sampling s(t, Bins::centre, Metric::log, 0, false);
  const FreeSlots none(std::vector<bool>(m.model.value_count, false));
  for (const bool in_float : {false, true}) {
    const auto a = assess(s, m, none, no_huber, true, nullptr, in_float);
    EXPECT_EQ(a.incident_angles, l.theta_i_deg.size());
    std::size_t band = 0;
    for (const auto& b : a.residuals.bands)
      if (std::string(b.angle) == "theta_h") {
        EXPECT_EQ(b.values, expected[band]) << b.from_deg << " in float: " << in_float;
        ++band;
      }
    EXPECT_EQ(band, expected.size());
  }
}

TEST(Assessment, CountsTheWholeDegreesOfAGridsIncidentAngles) {
  const Table t = synthesize(paint(), {.layout = Layout::image_slice});
  const SampleAngles at(t);
  std::set<long> degrees;
  for (std::size_t i = 0; i < t.size(); ++i)
    if (const auto a = at(i); a.nol > horizon_cosine && a.nov > horizon_cosine)
      degrees.insert(static_cast<long>(std::acos(std::min(a.nol, 1.0)) / degree + 0.25));
  const FreeSlots none(std::vector<bool>(8, false));
  const Sampling s(t, t.bins(), Metric::log, 0, false);
  EXPECT_EQ(assess(s, paint(), none, no_huber, true).incident_angles, degrees.size());
}

TEST(Sandwich, OfIndependentValuesIsTheSumOfSquaredScoresAndOfClustersTheSquareOfTheirSums) {
  const Case c = small();
  const auto s = c.sampling(Metric::l2_cosine);
  const auto data = fit_data<double>(s);
  const auto e = Accumulator<double>(c.model.model, data, c.free).normal_equations(c.off);
  const auto independent = assess(s, c.at_off(), c.free, no_huber, false);
  for (std::size_t i = 0; i < 64; ++i)
    EXPECT_NEAR(independent.sandwich.bread.entries()[i], e.h.entries()[i],
                1e-12 * std::abs(e.h.entries()[i]));
  // One incident angle for all: its score is the whole gradient.
  Case one = small();
  auto& where = std::get<DirectionList>(one.table.where);
  where.theta_i_deg.assign(one.table.size(), 30);
  const auto together = one.sampling(Metric::l2_cosine);
  const auto g = Accumulator<double>(one.model.model, fit_data<double>(together), one.free)
                     .normal_equations(one.off)
                     .g;
  const auto a = assess(together, one.at_off(), one.free, no_huber, true);
  EXPECT_EQ(a.incident_angles, 1U);
  for (std::size_t p = 0; p < 8; ++p)
    for (std::size_t q = 0; q < 8; ++q)
      EXPECT_NEAR(meat(a.sandwich, p, q), g[p] * g[q], 1e-9 * std::abs(g[p] * g[q]) + 1e-20);
  // Each value its own: one channel, no angle twice.
  Case each({.layout = Layout::random, .samples = 300, .noise = 0.1});
  auto& apart = std::get<DirectionList>(each.table.where);
  for (std::size_t i = 0; i < each.table.size(); ++i) {
    apart.theta_i_deg[i] = 0.1 * static_cast<double>(i);
    for (std::size_t ch = 1; ch < 3; ++ch) each.table.values[ch][i] = -1;
  }
  const auto lone =
      assess(each.sampling(Metric::l2_cosine), each.at_off(), each.free, no_huber, true);
  const auto every =
      assess(each.sampling(Metric::l2_cosine), each.at_off(), each.free, no_huber, false);
  for (std::size_t i = 0; i < 8; ++i)
    for (std::size_t k = 0; k < 8; ++k)
      EXPECT_NEAR(meat(lone.sandwich, i, k), meat(every.sandwich, i, k),
                  1e-10 * std::abs(meat(every.sandwich, i, k)) + 1e-20);
}

TEST(Sandwich, UnderHubersLossTakesTheClippedOutOfTheBreadAndClipsTheirScores) {
  // ln f − ln y of a Lambertian with kd = 0.3: j = 1/kd everywhere, ten small residuals, two large.
  constexpr double kd = 0.3, huber = 0.05;
  std::vector<double> values;
  double small_squares = 0;
  for (int i = 0; i < 10; ++i) {
    const double r = 0.004 * i - 0.02;
    values.push_back(kd / M_PI * std::exp(-r));
    small_squares += r * r;
  }
  for (const double r : {0.7, -1.5}) values.push_back(kd / M_PI * std::exp(-r));
  const Table t = test::list_of(std::move(values));
  const auto m = test::bind("lambert", "kd=0.3", 1);
  const Sampling s(t, Bins::centre, Metric::log, 0, false);
  const auto a = assess(s, m, FreeSlots({true}), huber, false).sandwich;
  EXPECT_NEAR(a.bread(0, 0), 10 / (kd * kd), 1e-9);
  EXPECT_NEAR(a.meat(0, 0), (small_squares + 2 * huber * huber) / (kd * kd), 1e-12);
}

TEST(Sandwich, OfValuesTakesTheResidualsThatAFitWithoutEachWouldLeave) {
  // (f − y) NoL of a Lambertian is linear in kd: the fit without a value is a quotient of sums.
  const Table t = test::list_of({0.1, 0.12, 0.09, 0.2, 0.11, 0.1, 0.13});
  const SampleAngles at(t);
  double jj = 0, jy = 0;
  std::vector<double> j, y;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double nol = at(i).nol;
    j.push_back(nol / M_PI);
    y.push_back(t.values[0][i] * nol);
    jj += j[i] * j[i];
    jy += j[i] * y[i];
  }
  const double kd = jy / jj;
  double meat = 0, fourth = 0, moves = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double without = (jy - j[i] * y[i]) / (jj - j[i] * j[i]);
    meat += std::pow(j[i] * (j[i] * without - y[i]), 2);
    fourth += std::pow(j[i] * j[i] / jj, 2);
    moves += std::pow(without - kd, 4) * jj * jj;
  }
  const auto m = test::bind("lambert", fmt::format("kd={:.17g}", kd), 1);
  const Sampling s(t, Bins::centre, Metric::l2_cosine, 0, false);
  const Influences influences(ArrowMatrix{jj}, {0});
  for (const bool in_float : {false, true}) {
    const auto a = assess(s, m, FreeSlots({true}), no_huber, false, &influences, in_float).sandwich;
    const double digits = in_float ? 1e-4 : 1e-10;
    EXPECT_NEAR(a.meat(0, 0) / meat, 1, digits);
    EXPECT_NEAR(a.fourth[0] / fourth, 1, digits);
    EXPECT_NEAR(a.moves[0] / moves, 1, 10 * digits);
    EXPECT_EQ(a.alone[0], 0);
  }
}

TEST(Sandwich, LearnsNothingFromAValueThatAloneDeterminesSomething) {
  // Of the second channel one value is left, which its kd follows wherever it goes.
  Table t = test::list_of({0.1, 0.12, 0.09, 0.2});
  t.channels = {"a", "b"};
  t.values.push_back(t.values[0]);
  for (const std::size_t i : {0U, 1U, 3U}) t.values[1][i] = -1;
  t.negative_is_noise = false;
  const auto m = test::bind("lambert", "kd=0.3,0.282743", 2);
  const FreeSlots free({true, true});
  const Sampling s(t, Bins::centre, Metric::log, 0, false);
  const auto bread = assess(s, m, free, no_huber, false).sandwich.bread;
  const Influences influences(bread, {0, 1});
  const auto a = assess(s, m, free, no_huber, false, &influences).sandwich;
  EXPECT_EQ(a.meat(1, 1), 0);
  EXPECT_NEAR(a.alone[1], 1, 1e-12);
  EXPECT_NEAR(a.fourth[1], 1, 1e-12);
  EXPECT_EQ(a.alone[0], 0);
  EXPECT_NEAR(a.fourth[0], 1.0 / 4, 1e-12);
}

TEST(Sandwich, IsTheSameWithChannelsAsArms) {
  constexpr std::size_t channels = 20;
  const auto m = bind_model("lambert+ggx/smith_ggx.correlated/schlick",
                            parse_settings(std::vector<std::string>{"alpha=0.3"}), channels);
  const Table t = synthesize(m, {.layout = Layout::random, .samples = 100, .noise = 0.1});
  const Sampling s(t, Bins::centre, Metric::l2_cosine, 0, false);
  const std::vector<bool> all(m.model.value_count, true);
  const FreeSlots dense(all), arrow(m.model, all);
  ASSERT_EQ(arrow.layout()->arms().size(), channels);
  std::vector<std::size_t> determined;
  for (std::size_t i = 0; i < dense.size(); ++i)
    if (i != dense.index(m.model.find("kd")->first + 3)) determined.push_back(i);
  const auto judged = [&](const FreeSlots& free) {
    const auto bread = assess(s, m, free, no_huber, false).sandwich.bread;
    const Influences influences(bread, determined);
    return assess(s, m, free, no_huber, false, &influences).sandwich;
  };
  const auto a = judged(dense), b = judged(arrow);
  for (const std::size_t i : determined) {
    EXPECT_NEAR(b.meat(i, i) / a.meat(i, i), 1, 1e-9) << i;
    EXPECT_NEAR(b.fourth[i] / a.fourth[i], 1, 1e-9) << i;
    EXPECT_NEAR(b.moves[i] / a.moves[i], 1, 1e-9) << i;
  }
}

TEST(Assessment, CutsManyIncidentAnglesOfAListToWholeDegrees) {
  std::vector<double> values(361, 0.1);
  const auto m = test::bind("lambert", "kd=0.3", 1);
  const auto angles = [&](const Table& t) {
    return assess(Sampling(t, Bins::centre, Metric::log, 0, false), m, FreeSlots({true}), no_huber,
                  true)
        .incident_angles;
  };
  EXPECT_EQ(angles(test::list_of(values)), 61U);  // from 10 to 70°
  values.pop_back();
  EXPECT_EQ(angles(test::list_of(values)), 360U);
}

}  // namespace
}  // namespace gonio
