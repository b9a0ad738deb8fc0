// The sums over columns are the sums over samples, whatever the threads; Ceres sees the same
// problem.
#include "fitting/solve/accumulate.h"

#include <array>
#include <cmath>
#include <set>

#include "data_synth/synth.h"
#include "fitting/fit.h"
#include "fitting/judge/assess.h"
#include "fitting/judge/uncertainty.h"
#include "fitting/solve/solve.h"
#include "table/format/formats.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace gonio {
namespace {

BoundModel paint() {
  return bind_model(
      "lambert.coupled+gtr/smith_ggx.correlated/schlick",
      parse_settings(std::vector<std::string>{"alpha=0.2,gamma=1.7,f0=0.05,kd=0.2,0.1,0.05"}), 3);
}

/// A table with masked values and weights, and values away from the optimum.
struct Case {
  BoundModel model = paint();
  Table table;
  FreeSlots free{std::vector<bool>(8, true)};
  std::vector<double> off;
  explicit Case(const SynthOptions& o = {.layout = Layout::random, .samples = 3000, .noise = 0.1}) {
    table = synthesize(model, o);
    for (std::size_t i = 0; i < table.size(); i += 11)
      table.values[i % 3][i] = i % 2 ? -1 : std::nan("");
    table.weights.assign(table.size(), 1);
    for (std::size_t i = 0; i < table.size(); i += 7)
      table.weights[i] = 0.5 * static_cast<double>(i % 5);
    off = model.values;
    for (auto& v : off) v *= 1.1;
  }
  Sampling sampling(Metric m, bool fold = false) const {
    return Sampling(table, table.bins(), m, 0, fold);
  }
  BoundModel at_off() const { return {model.model, off, {}}; }
};

Case small() {
  return Case({.layout = Layout::random, .samples = 500, .noise = 0.1});
}

TEST(NormalEquations, GradientIsTheSlopeOfTheCost) {
  const Case c;
  for (std::size_t m = 0; m < metric_names.size(); ++m)
    for (const double huber : {no_huber, 0.05}) {
      const auto data = fit_data<double>(c.sampling(static_cast<Metric>(m)));
      const Accumulator<double> a(c.model.model, data, c.free, huber);
      const auto e = a.normal_equations(c.off);
      for (std::size_t i = 0; i < c.off.size(); ++i) {
        auto low = c.off, high = c.off;
        const double h = 1e-5 * c.off[i];
        low[i] -= h;
        high[i] += h;
        const double slope =
            (a.normal_equations(high).cost - a.normal_equations(low).cost) / (2 * h);
        EXPECT_NEAR(e.g[i], slope, 1e-5 * std::abs(slope) + 1e-7 * e.cost) << metric_names[m] << i;
      }
    }
}

TEST(NormalEquations, AreTheNaiveSumsOverResiduals) {
  const Case c = small();
  const auto data = fit_data<double>(c.sampling(Metric::log));
  const Accumulator<double> a(c.model.model, data, c.free);
  const auto e = a.normal_equations(c.off);
  const auto r = a.residuals(c.off);
  ASSERT_EQ(r.size(), data.counts.used);
  double cost = 0;
  for (const double x : r) cost += x * x / 2;
  EXPECT_NEAR(e.cost, cost, 1e-12 * cost);
  // J by differences of the residuals themselves
  std::vector<std::vector<double>> j;
  for (std::size_t i = 0; i < c.off.size(); ++i) {
    auto low = c.off, high = c.off;
    const double h = 1e-6 * c.off[i];
    low[i] -= h;
    high[i] += h;
    auto up = a.residuals(high);
    const auto down = a.residuals(low);
    for (std::size_t k = 0; k < up.size(); ++k) up[k] = (up[k] - down[k]) / (2 * h);
    j.push_back(std::move(up));
  }
  for (std::size_t p = 0; p < 8; ++p)
    for (std::size_t q = 0; q < 8; ++q) {
      double sum = 0, size = 0;
      for (std::size_t k = 0; k < r.size(); ++k) {
        sum += j[p][k] * j[q][k];
        size += std::abs(j[p][k] * j[q][k]);
      }
      EXPECT_NEAR(e.h[p * 8 + q], sum, 1e-6 * size + 1e-12) << p << q;
    }
}

/// MERL's two ways, mirrored and exchanged, and the two halves of an in/out grid.
std::vector<Case> layouts_that_fold() {
  std::vector<Case> all;
  const auto add = [&](Grid grid) {
    for (auto& axis : grid.axes) axis.size = axis.name.starts_with("phi") ? 2 * axis.size / 15 : 18;
    Case c({.layout = Layout::random, .samples = grid.size(), .noise = 0.1});
    Table t = std::move(c.table);
    t.where = grid;  // the values are noise to the angles: nothing is met by luck
    c.table = std::move(t);
    all.push_back(std::move(c));
  };
  add(merl_grid(Bins::centre));
  add(merl_grid(Bins::edge));
  add(merl_grid(Bins::centre, false));
  add(mbsdf_grid(18, 90, Bins::centre));
  return all;
}

TEST(Folding, ChangesNoSum) {
  for (const Case& c : layouts_that_fold())
    for (std::size_t m = 0; m < metric_names.size(); ++m) {
      const auto alone = c.sampling(static_cast<Metric>(m)),
                 folded = c.sampling(static_cast<Metric>(m), true);
      EXPECT_LT(folded.groups().size(), 0.6 * static_cast<double>(alone.groups().size()));
      const auto all = fit_data<double>(alone), less = fit_data<double>(folded);
      EXPECT_EQ(all.counts.used, less.counts.used);
      EXPECT_EQ(all.counts.by_reason(alone), less.counts.by_reason(folded));
      const auto e = Accumulator<double>(c.model.model, all, c.free).normal_equations(c.off);
      const auto f = Accumulator<double>(c.model.model, less, c.free).normal_equations(c.off);
      EXPECT_NEAR(f.cost, e.cost, 1e-11 * e.cost) << metric_names[m];
      for (std::size_t i = 0; i < e.g.size(); ++i)
        EXPECT_NEAR(f.g[i], e.g[i], 1e-10 * std::sqrt(e.cost * e.h[i * 9])) << metric_names[m];
      for (std::size_t i = 0; i < e.h.size(); ++i)
        EXPECT_NEAR(f.h[i], e.h[i], 1e-11 * std::abs(e.h[i]) + 1e-12) << metric_names[m];
    }
}

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
          const auto size = [&](const Matrix& m) { return std::sqrt(m[i * 9] * m[k * 9]); };
          const std::size_t at = i * 8 + k;
          EXPECT_NEAR(a.sandwich.bread[at], b.sandwich.bread[at], 1e-11 * size(a.sandwich.bread));
          EXPECT_NEAR(a.sandwich.meat[at], b.sandwich.meat[at], 1e-11 * size(a.sandwich.meat));
        }
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
    const auto a = assess(s, m, none, no_huber, true, in_float);
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

TEST(Levels, HoldValuesAloneWhateverTheTableLacks) {
  Case c({.layout = Layout::random, .samples = 40000, .noise = 0.1});
  for (auto& v : c.table.values)
    for (std::size_t i = 0; i < v.size(); ++i)
      if (i % 100) v[i] = -1;  // 1 % is left
  constexpr std::array<std::size_t, 2> most{50, 200};
  const auto levels = fit_levels<double>(c.sampling(Metric::log), most);
  for (std::size_t l = 0; l < most.size(); ++l) {
    EXPECT_GT(levels.thinned[l].groups, 0U);
    EXPECT_GE(levels.thinned[l].counts.used, levels.thinned[l].groups);
  }
}

TEST(Folding, InFloatLosesSixDigitsAtMost) {
  for (const Case& c : layouts_that_fold()) {
    const auto s = c.sampling(Metric::log, true);
    const auto e =
        Accumulator<double>(c.model.model, fit_data<double>(s), c.free).normal_equations(c.off);
    const auto f =
        Accumulator<float>(c.model.model, fit_data<float>(s), c.free).normal_equations(c.off);
    EXPECT_NEAR(f.cost, e.cost, 1e-5 * e.cost);
    for (std::size_t i = 0; i < 8; ++i) {
      EXPECT_NEAR(f.g[i], e.g[i], 2e-5 * std::sqrt(e.cost * e.h[i * 9]));
      EXPECT_NEAR(f.h[i * 9], e.h[i * 9], 2e-5 * e.h[i * 9]);
    }
    const auto a = assess(s, c.at_off(), c.free, no_huber, true, false);
    const auto b = assess(s, c.at_off(), c.free, no_huber, true, true);
    EXPECT_NEAR(a.residuals.log_rms, b.residuals.log_rms, 1e-5 * a.residuals.log_rms);
    for (std::size_t i = 0; i < 8; ++i)
      EXPECT_NEAR(a.sandwich.meat[i * 9], b.sandwich.meat[i * 9], 1e-3 * a.sandwich.meat[i * 9]);
  }
}

TEST(Sandwich, OfIndependentValuesIsTheSumOfSquaredScoresAndOfClustersTheSquareOfTheirSums) {
  const Case c = small();
  const auto s = c.sampling(Metric::l2_cosine);
  const auto data = fit_data<double>(s);
  const auto e = Accumulator<double>(c.model.model, data, c.free).normal_equations(c.off);
  const auto independent = assess(s, c.at_off(), c.free, no_huber, false);
  for (std::size_t i = 0; i < 64; ++i)
    EXPECT_NEAR(independent.sandwich.bread[i], e.h[i], 1e-12 * std::abs(e.h[i]));
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
      EXPECT_NEAR(a.sandwich.meat[p * 8 + q], g[p] * g[q], 1e-9 * std::abs(g[p] * g[q]) + 1e-20);
  // Each value its own: one channel, no angle twice.
  Case each = small();
  auto& apart = std::get<DirectionList>(each.table.where);
  for (std::size_t i = 0; i < each.table.size(); ++i) {
    apart.theta_i_deg[i] = 0.1 * static_cast<double>(i);
    for (std::size_t ch = 1; ch < 3; ++ch) each.table.values[ch][i] = -1;
  }
  const auto lone =
      assess(each.sampling(Metric::l2_cosine), each.at_off(), each.free, no_huber, true);
  const auto every =
      assess(each.sampling(Metric::l2_cosine), each.at_off(), each.free, no_huber, false);
  for (std::size_t i = 0; i < 64; ++i)
    EXPECT_NEAR(lone.sandwich.meat[i], every.sandwich.meat[i],
                1e-10 * std::abs(every.sandwich.meat[i]) + 1e-20);
}

TEST(NormalEquations, AreTheSameBitsForAnyNumberOfThreads) {
  const Case c({.layout = Layout::random, .samples = 60000, .noise = 0.1});
  const auto data = fit_data<float>(c.sampling(Metric::log));
  const Accumulator<float> a(c.model.model, data, c.free);
  const auto many = a.normal_equations(c.off);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const auto single = a.normal_equations(c.off);
  EXPECT_EQ(many.h, single.h);
  EXPECT_EQ(many.g, single.g);
  EXPECT_EQ(many.cost, single.cost);
}

TEST(Solve, FindsTheMinimumOfAQuadraticAndKeepsInsideItsBounds) {
  // ½ (x − (1, 2))ᵀ H (x − (1, 2)) + 3
  const auto evaluate = [](const std::vector<double>& x) {
    const double a = x[0] - 1, b = x[1] - 2;
    NormalEquations e;
    e.h = {2, 1, 1, 3};
    e.g = {2 * a + b, a + 3 * b};
    e.cost = (a * e.g[0] + b * e.g[1]) / 2 + 3;
    return e;
  };
  std::vector<double> x{10, -10};
  const auto s = solve(evaluate, x, {{-100, -100}, {100, 100}});
  EXPECT_TRUE(s.converged);
  EXPECT_NEAR(x[0], 1, 1e-6);
  EXPECT_NEAR(x[1], 2, 1e-6);
  EXPECT_NEAR(s.at.cost, 3, 1e-12);
  x = {10, -10};
  solve(evaluate, x, {{-100, -100}, {100, 1}});
  EXPECT_EQ(x[1], 1);
  EXPECT_NEAR(x[0], 1.5, 1e-4);  // 2 (x − 1) + (1 − 2) = 0
}

// The cost is rounded to more than the last steps lower it by; only the gradient can lead on.
TEST(Solve, IsNotHeldUpByTheRoundingOfTheCost) {
  const std::vector<double> optimum{0.3, 0.7};
  int passes = 0;
  const auto evaluate = [&](const std::vector<double>& x) {
    ++passes;
    const double a = x[0] - optimum[0], b = x[1] - optimum[1];
    NormalEquations e;  // JᵀJ is a little less than the curvature: the steps are a little too long
    e.h = {1.8, 0.9, 0.9, 2.7};
    e.g = {2 * a + b, a + 3 * b};
    const double exact = 1e4 + (a * e.g[0] + b * e.g[1]) / 2;
    e.cost = 0.01 * std::round(exact / 0.01);
    return e;
  };
  std::vector<double> x{0.35, 0.68};
  const auto s = solve(evaluate, x, {{0, 0}, {1, 1}}, {.rounding = 1e-9});
  EXPECT_TRUE(s.converged);
  EXPECT_LT(passes, 6);
  // 1e-8 of the cost: half a step of 0.01 along the flattest direction
  EXPECT_NEAR(x[0], optimum[0], 0.012);
  EXPECT_NEAR(x[1], optimum[1], 0.012);
  EXPECT_EQ(s.cost_per_iteration.size(), static_cast<std::size_t>(s.iterations) + 1);
}

TEST(Solve, SurvivesADirectionInWhichNothingChanges) {
  const auto evaluate = [](const std::vector<double>& x) {
    const double a = x[0] + x[1] - 1;
    return NormalEquations{{1, 1, 0, 1, 1, 0, 0, 0, 0}, {a, a, 0}, a * a / 2 + 1};
  };
  std::vector<double> x{0, 0, 5};
  const auto s = solve(evaluate, x, {{-9, -9, -9}, {9, 9, 9}});
  EXPECT_TRUE(s.converged);
  EXPECT_NEAR(x[0] + x[1], 1, 1e-6);
  EXPECT_EQ(x[2], 5);
}

TEST(Uncertainty, TellsSingularDirectionsFromKnownParameters) {
  // x0 + x1 known, x2 known with error 0.1, x3 at its bound, x4 without effect
  Sandwich s;
  s.bread.assign(25, 0);
  s.bread[0] = s.bread[1] = s.bread[5] = s.bread[6] = 100;
  s.bread[12] = 100;
  s.bread[18] = 100;
  s.meat = s.bread;
  const std::vector<double> x{0.3, 0.3, 0.5, 1, 0.5};
  const auto u =
      uncertainty(s, x, {std::vector<double>(5, 0), std::vector<double>(5, 1)}, 1'000'000, 0);
  EXPECT_EQ(u.status[0], ParameterStatus::not_identifiable);
  EXPECT_EQ(u.status[1], ParameterStatus::not_identifiable);
  EXPECT_EQ(u.status[2], ParameterStatus::free);
  EXPECT_NEAR(u.std_error[2], 0.1, 1e-6);
  EXPECT_EQ(u.status[3], ParameterStatus::at_bound);
  EXPECT_EQ(u.status[4], ParameterStatus::not_identifiable);
  EXPECT_TRUE(std::isnan(u.std_error[3]));
}

TEST(Uncertainty, TakesStudentsQuantileFromTheTables) {
  // NIST/SEMATECH e-Handbook, table 1.3.6.7.2
  EXPECT_NEAR(student_t_975(4), 2.776, 0.014);
  EXPECT_NEAR(student_t_975(10), 2.228, 0.001);
  EXPECT_NEAR(student_t_975(30), 2.042, 0.0005);
  EXPECT_NEAR(student_t_975(89), 1.987, 0.0005);
}

TEST(Fit, IsTheSameDocumentForAnyNumberOfThreads) {
  const Table t = synthesize(paint(), {.layout = Layout::mbsdf, .noise = 0.05});
  FitOptions o;
  o.model = paint().model.spec;
  o.robust = true;
  const auto strip = [](FitDocument d) {
    d.solver.phase_ms.clear();
    return to_json(d);
  };
  const auto many = strip(fit(t, o).document);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(strip(fit(t, o).document), many);
}

}  // namespace
}  // namespace gonio
