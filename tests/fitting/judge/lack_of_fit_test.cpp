// A misfit is told, the right model is not accused, and intervals that are stated hold the truth.
#include "fitting/judge/lack_of_fit.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <random>

#include "fitting/fit.h"
#include "fitting/goniometer.h"
#include "fitting/support.h"
#include "geometry/half_difference.h"
#include "many_fits.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace gonio {
namespace {

constexpr const char* paint = "lambert+ggx/smith_ggx.correlated/schlick";

/// Noise of a table, beside what synthesize() knows.
enum class Disturbance { none, additive, gains, large_gains };

struct Row {
  const char *name, *truth, *settings;
  const char* fitted;
  std::vector<std::pair<const char*, std::vector<double>>> known;  ///< true values of the fitted
  SynthOptions synth;
  Disturbance disturbance = Disturbance::none;
  Metric metric = Metric::log;
  bool robust = false;
};

Table disturbed(const Row& r, std::uint64_t seed) {
  SynthOptions s = r.synth;
  s.seed = seed;
  Table t = synthesize(test::bind(r.truth, r.settings, 3), s);
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  if (r.disturbance == Disturbance::additive)
    for (auto& plane : t.values)
      for (double& v : plane) v += 0.002 * normal(random);
  if (r.disturbance == Disturbance::gains || r.disturbance == Disturbance::large_gains) {
    const double spread = r.disturbance == Disturbance::gains ? 0.02 : 0.05;
    t.truth.reset();  // as if measured
    std::map<double, double> gain;
    for (std::size_t i = 0; i < t.size(); ++i) {
      double& g = gain[t.list()->theta_i_deg[i]];
      if (g == 0) g = std::exp(spread * normal(random));
      for (auto& plane : t.values) plane[i] *= g;
    }
  }
  return t;
}

struct Tally {
  unsigned fits = 0, told = 0;
  unsigned stated = 0, silent_and_wrong = 0;  ///< intervals
  unsigned inside = 0, inside_of_half = 0;  ///< that hold the truth, and would at half their width
};

Tally tally(const Row& r, unsigned seeds) {
  Tally sum;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    FitOptions o;
    o.model = r.fitted;
    o.metric = r.metric;
    o.robust = r.robust;
    const auto d = fit(disturbed(r, seed), o).document;
    ++sum.fits;
    sum.told += d.misfit.told;
    for (const auto& [name, truth] : r.known) {
      const auto& p = test::parameter(d, name);
      for (std::size_t c = 0; c < p.value.size(); ++c) {
        if (std::isnan(p.ci95_low[c])) continue;
        ++sum.stated;
        const double value = truth[truth.size() > 1 ? c : 0];
        const auto holds = [&](double part) {
          return p.value[c] + part * (p.ci95_low[c] - p.value[c]) <= value &&
                 value <= p.value[c] + part * (p.ci95_high[c] - p.value[c]);
        };
        sum.inside += holds(1);
        sum.inside_of_half += holds(0.5);
        sum.silent_and_wrong += !d.misfit.told && !holds(1);
      }
    }
  }
  return sum;
}

std::vector<Row> in_layouts(const Row& row, std::initializer_list<double> noises) {
  std::vector<Row> all;
  for (const double noise : noises)
    for (const auto& [layout, samples] : {std::pair{Layout::in_plane, std::size_t{0}},
                                          {Layout::hemisphere, std::size_t{0}},
                                          {Layout::random, std::size_t{60}},
                                          {Layout::random, std::size_t{2000}}}) {
      Row& r = all.emplace_back(row);
      r.synth.layout = layout;
      r.synth.samples = samples;
      r.synth.noise = noise;
    }
  return all;
}

const std::vector<double> kd{0.2, 0.1, 0.05};

std::vector<Row> wrong_models() {
  const std::vector<Row> pairs{{"dielectric as schlick",
                                "lambert+ggx/smith_ggx.correlated/dielectric",
                                "alpha=0.6,eta=1.5,kd=0.2,0.1,0.05",
                                paint,
                                {{"alpha", {0.6}}, {"f0", {0.04}}, {"kd", kd}},
                                {}},
                               {"narrow dielectric as schlick",
                                "lambert+ggx/smith_ggx.correlated/dielectric",
                                "alpha=0.2,eta=1.5,kd=0.2,0.1,0.05",
                                paint,
                                {{"alpha", {0.2}}, {"f0", {0.04}}, {"kd", kd}},
                                {}},
                               {"uncoupled as gltf",
                                paint,
                                "alpha=0.2,f0=0.04,kd=0.2,0.1,0.05",
                                "lambert.coupled+ggx/smith_ggx.separable/schlick",
                                {{"alpha", {0.2}}, {"f0", {0.04}}},
                                {}},
                               {"gtr as ggx",
                                "lambert+gtr/smith_ggx.correlated/schlick",
                                "alpha=0.3,gamma=1.5,f0=0.05,kd=0.2,0.1,0.05",
                                paint,
                                {{"alpha", {0.3}}, {"f0", {0.05}}, {"kd", kd}},
                                {}},
                               {"beckmann as ggx",
                                "lambert+beckmann/smith_beckmann.correlated/schlick",
                                "alpha=0.3,f0=0.05,kd=0.2,0.1,0.05",
                                paint,
                                {{"f0", {0.05}}, {"kd", kd}},
                                {}},
                               {"separable as correlated",
                                "lambert+ggx/smith_ggx.separable/schlick",
                                "alpha=0.5,f0=0.05,kd=0.2,0.1,0.05",
                                paint,
                                {{"alpha", {0.5}}, {"f0", {0.05}}, {"kd", kd}},
                                {}}};
  std::vector<Row> all;
  for (const auto& p : pairs)
    for (auto& r : in_layouts(p, {0.01, 0.05})) all.push_back(std::move(r));
  return all;
}

/// Rows whose metric or loss hides what logarithms show.
std::vector<Row> wrong_under_other_metrics() {
  const auto random = [](std::size_t samples, double noise) {
    return SynthOptions{.layout = Layout::random, .samples = samples, .noise = noise};
  };
  const char* const narrow = "alpha=0.092,f0=0.08,kd=0.3";
  return {{"cook_torrance",
           paint,
           narrow,
           "lambert.coupled+ggx/smith_ggx.correlated/schlick",
           {{"alpha", {0.092}}, {"f0", {0.08}}},
           random(200, 0.05),
           Disturbance::none,
           Metric::l2_cosine},
          {"faint separable",
           "lambert+ggx/smith_ggx.separable/schlick",
           "alpha=0.162,f0=0.04,kd=0.02",
           paint,
           {{"alpha", {0.162}}, {"f0", {0.04}}, {"kd", {0.02}}},
           random(200, 0.02)},
          {"schlick_ggx, outliers",
           paint,
           "alpha=0.556,f0=0.04,kd=0.6",
           "lambert+ggx/schlick_ggx.half_alpha/schlick",
           {{"alpha", {0.556}}, {"f0", {0.04}}, {"kd", {0.6}}},
           random(60, 0.02),
           Disturbance::none,
           Metric::relative,
           true},
          {"gtr as ggx, outliers",
           "lambert+gtr/smith_ggx.correlated/schlick",
           "alpha=0.287,gamma=2.48,f0=0.3,kd=0.3",
           paint,
           {{"alpha", {0.287}}, {"f0", {0.3}}, {"kd", {0.3}}},
           random(60, 0.005),
           Disturbance::none,
           Metric::l2_cosine,
           true}};
}

/// Rows whose highlight alone determines what the metric weighs, and robust ones whose angles have a
/// scale of their own.
std::vector<Row> right_under_other_metrics() {
  const char* const two =
      "lambert+ggx/smith_ggx.correlated/schlick+ggx/smith_ggx.correlated/schlick";
  const char* const gtr = "gtr/schlick_ggx.half_alpha/schlick";
  const char* const beckmann = "beckmann/smith_beckmann.correlated/schlick";
  std::vector<Row> all{{"two lobes",
                        two,
                        "alpha=0.067,f0=0.04,alpha_2=0.528,f0_2=0.3,kd=0.1",
                        two,
                        {},
                        {.layout = Layout::in_plane, .noise = 0.1},
                        Disturbance::none,
                        Metric::l2_cosine},
                       {"narrow gtr",
                        gtr,
                        "alpha=0.0383,gamma=3.823,f0=0.074",
                        gtr,
                        {},
                        {.layout = Layout::random, .samples = 300, .noise = 0.1},
                        Disturbance::none,
                        Metric::l2_cosine},
                       {"narrow beckmann",
                        beckmann,
                        "alpha=0.02,f0=0.5",
                        beckmann,
                        {},
                        {.layout = Layout::hemisphere, .noise = 0.02},
                        Disturbance::none,
                        Metric::l2_cosine}};
  for (const Layout layout : {Layout::in_plane, Layout::hemisphere})
    for (const Metric metric : {Metric::log, Metric::l2_cosine, Metric::relative})
      all.push_back({"paint, gains, outliers",
                     paint,
                     "alpha=0.2,f0=0.05,kd=0.2",
                     paint,
                     {},
                     {.layout = layout, .noise = 0.02},
                     Disturbance::large_gains,
                     metric,
                     true});
  return all;
}

std::vector<Row> right_models() {
  std::vector<Row> all;
  const Row row{"paint",
                paint,
                "alpha=0.2,f0=0.05,kd=0.2,0.1,0.05",
                paint,
                {{"alpha", {0.2}}, {"f0", {0.05}}, {"kd", kd}},
                {}};
  const auto add = [&](const Row& r, std::initializer_list<double> noises) {
    for (auto& x : in_layouts(r, noises)) all.push_back(std::move(x));
  };
  add(row, {0.01, 0.05});
  for (const Metric metric : {Metric::l2_cosine, Metric::relative}) {
    Row r = row;
    r.metric = metric;
    add(r, {0.01, 0.05});
  }
  for (const Metric metric : {Metric::log, Metric::l2_cosine, Metric::relative}) {
    Row r = row;
    r.name = "paint, outliers";
    r.metric = metric;
    r.robust = true;
    r.synth.outliers = 0.1;
    add(r, {0.02});
  }
  Row additive = row;
  additive.name = "paint, additive noise";
  additive.metric = Metric::l2_cosine;
  additive.disturbance = Disturbance::additive;
  add(additive, {0.0});
  Row gains = row;
  gains.name = "paint, gains";
  gains.disturbance = Disturbance::gains;
  for (auto& r : in_layouts(gains, {0.01}))
    if (r.synth.layout != Layout::random) all.push_back(r);
  for (const auto& [name, model, settings] :
       {std::tuple{"dielectric", "lambert+ggx/smith_ggx.correlated/dielectric",
                   "alpha=0.6,eta=1.5,kd=0.2,0.1,0.05"},
        {"gtr", "lambert+gtr/smith_ggx.correlated/schlick",
         "alpha=0.3,gamma=1.5,f0=0.05,kd=0.2,0.1,0.05"},
        {"beckmann", "lambert+beckmann/smith_beckmann.correlated/schlick",
         "alpha=0.3,f0=0.05,kd=0.2,0.1,0.05"}})
    add({name, model, settings, model, {}, {}}, {0.02});
  return all;
}

unsigned seeds() {
  return std::getenv("GONIO_LONG") ? 100 : 2;
}

std::string line(const Row& r, const Tally& t) {
  return fmt::format(
      "{:<30} {:<10} {:>5} {:<10} noise {:<5} told {:>3} of {:>3}, intervals silent and wrong "
      "{:>3} of {:>4}\n",
      r.name, name_of(r.synth.layout), r.synth.samples, name_of(r.metric), r.synth.noise, t.told,
      t.fits, t.silent_and_wrong, t.stated);
}

TEST(LackOfFit, OfAWrongModelMakesIntervalsAsWideAsTheTruthIsFar) {
  GONIO_MANY_FITS();
  std::string table;
  Tally all;
  for (const auto& r : wrong_models()) {
    const Tally t = tally(r, seeds());
    all.silent_and_wrong += t.silent_and_wrong;
    all.stated += t.stated;
    all.inside += t.inside;
    all.inside_of_half += t.inside_of_half;
    table += line(r, t);
  }
  RecordProperty("table", table);
  EXPECT_LE(20 * all.silent_and_wrong, all.stated) << table;
  EXPECT_GE(100 * all.inside, 92 * all.stated) << "too narrow: " << all.inside;
  EXPECT_LE(100 * all.inside_of_half, 85 * all.stated) << "too wide: " << all.inside_of_half;
  if (std::getenv("GONIO_LONG")) fmt::print("{}", table);
}

TEST(LackOfFit, OfTheRightModelIsNotTold) {
  GONIO_MANY_FITS();
  std::string table;
  unsigned told = 0, fits = 0;
  for (const auto& r : right_models()) {
    const Tally t = tally(r, seeds());
    told += t.told;
    fits += t.fits;
    table += line(r, t);
  }
  EXPECT_LE(20 * told, fits) << table;
  if (std::getenv("GONIO_LONG")) fmt::print("{}", table);
}

TEST(LackOfFit, OfEachWrongModelIsToldWhateverTheMetric) {
  for (const auto& r : wrong_under_other_metrics()) {
    const Tally t = tally(r, 10);
    EXPECT_GE(t.told, 9U) << line(r, t);
    EXPECT_LE(10 * t.silent_and_wrong, t.stated) << line(r, t);
  }
}

TEST(LackOfFit, OfEachRightModelIsNotToldWhateverTheMetric) {
  GONIO_MANY_FITS();
  for (const auto& r : right_under_other_metrics()) {
    const Tally t = tally(r, 20);
    EXPECT_LE(t.told, 1U) << line(r, t);
  }
}

FitDocument fit_of(const Table& t, const char* model = paint) {
  FitOptions o;
  o.model = model;
  return fit(t, o).document;
}

TEST(LackOfFit, OfAGridIsToldWhereItIsSmall) {
  const Table t = synthesize(test::bind(paint, "alpha=0.2,f0=0.04,kd=0.2,0.1,0.05", 3),
                             {.layout = Layout::mbsdf, .noise = 0.02});
  const auto d = fit_of(t, "lambert.coupled+ggx/smith_ggx.separable/schlick");
  EXPECT_LT(d.residuals.log_rms, 0.25);
  EXPECT_TRUE(d.misfit.told);
  EXPECT_LT(d.misfit.p, 1e-9);
  ASSERT_TRUE(d.misfit.worst_cell);
  EXPECT_GT(std::abs(d.misfit.worst_cell->difference), 0.005);
  EXPECT_FALSE(d.misfit.follows.empty());
  const auto right = fit_of(t);
  EXPECT_TRUE(right.misfit.tested);
  EXPECT_FALSE(right.misfit.told);
}

TEST(LackOfFit, OfWhatDigitsLeaveOutIsNotJudged) {
  Table t = synthesize(test::bind(paint, "alpha=0.3,f0=0.04,kd=0.2,0.1,0.05", 3),
                       {.layout = Layout::in_plane});
  EXPECT_FALSE(fit_of(t).misfit.tested);  // noise-free: what is left is our own rounding
  for (auto& plane : t.values)
    for (double& v : plane) v = std::round(v * 1e3) / 1e3;
  const auto d = fit_of(t);
  EXPECT_FALSE(d.misfit.tested);
  EXPECT_FALSE(d.misfit.note.empty());
  EXPECT_TRUE(d.warnings.empty());
  EXPECT_TRUE(fit_of(t, "lambert").misfit.told);
}

void round_to_digits(Table& t, int digits) {
  for (auto& plane : t.values)
    for (double& v : plane) v = std::stod(fmt::format("{:.{}g}", v, digits));
}

TEST(LackOfFit, WhatDigitsLeaveOutOfAllValuesAlikeIsInTheInterval) {
  Table t = synthesize(test::bind("lambert", "kd=0.5", 1), {.layout = Layout::in_plane});
  round_to_digits(t, 2);  // 0.159 is 0.16, everywhere
  const auto d = fit_of(t, "lambert");
  const auto& found = test::parameter(d, "kd");
  EXPECT_LT(found.ci95_low[0], 0.5);
  EXPECT_GT(found.ci95_high[0], 0.5);
  EXPECT_LT(found.ci95_high[0] - found.ci95_low[0], 0.1);
}

TEST(LackOfFit, OfValuesOfFewDigitsIsToldWhereItExceedsThemByFar) {
  Table t = synthesize(test::bind("ggx/smith_ggx.correlated/schlick", "alpha=0.1,f0=0.5", 3),
                       {.layout = Layout::in_plane, .noise = 0.02});
  for (const int digits : {9, 3}) {
    round_to_digits(t, digits);
    for (const Metric metric : {Metric::log, Metric::relative}) {
      FitOptions o;
      o.metric = metric;
      // Falls to next to nothing where the values do not: so does what rounding may be of them.
      o.model = "beckmann/smith_beckmann.correlated/schlick";
      EXPECT_TRUE(fit(t, o).document.misfit.told) << digits << " " << name_of(metric);
      o.model = "lambert";
      EXPECT_TRUE(fit(t, o).document.misfit.told) << digits << " " << name_of(metric);
    }
  }
}

TEST(LackOfFit, OfALobeThatFallsToNothingIsTested) {
  const char* const lobe = "beckmann/smith_beckmann.correlated/schlick";
  for (const auto& [layout, samples] :
       {std::pair{Layout::hemisphere, std::size_t{0}}, {Layout::random, std::size_t{300}}})
    for (const char* alpha : {"alpha=0.3,f0=0.5", "alpha=0.02,f0=0.5"})
      for (const Metric metric : {Metric::log, Metric::l2_cosine, Metric::relative}) {
        FitOptions o;
        o.model = lobe;
        o.metric = metric;
        const auto m = fit(synthesize(test::bind(lobe, alpha, 3),
                                      {.layout = layout, .samples = samples, .noise = 0.02}),
                           o)
                           .document.misfit;
        EXPECT_TRUE(m.tested) << m.note;
        EXPECT_FALSE(m.told) << name_of(layout) << " " << alpha << " " << name_of(metric);
      }
}

TEST(LackOfFit, OfTooFewValuesIsNotKnownAndThatIsSaid) {
  const auto d = fit_of(synthesize(test::bind(paint, "alpha=0.3", 1),
                                   {.layout = Layout::random, .samples = 6, .noise = 0.02}));
  EXPECT_FALSE(d.misfit.tested);
  EXPECT_EQ(
      std::ranges::count_if(d.warnings, [&](const auto& w) { return w.ends_with(d.misfit.note); }),
      1);
}

TEST(LackOfFit, OfNoMoreValuesThanUnknownsIsNotKnownThoughAllAreMet) {
  const auto d = fit_of(test::list_of({0.1, 0.1}));
  EXPECT_LT(d.residuals.log_rms, 1e-6);
  EXPECT_FALSE(d.misfit.told);
  EXPECT_FALSE(d.misfit.reproduces());
}

TEST(LackOfFit, OfFewMeasuredAnglesIsToldThoughTheScaleOfEachIsLeftOpen) {
  Table t = synthesize(test::bind("lambert+gtr/smith_ggx.correlated/schlick",
                                  "alpha=0.3,gamma=1.2,f0=0.05,kd=0.05", 1),
                       {.layout = Layout::hemisphere, .noise = 0.02});
  t.truth.reset();  // as if measured
  for (std::size_t i = 0; i < t.size(); ++i)
    if (t.list()->theta_i_deg[i] > 40) t.values[0][i] = std::nan("");
  const auto d = fit_of(t);
  EXPECT_LE(d.clusters, 4U);
  EXPECT_TRUE(d.misfit.told) << d.misfit.note;
}

/// Measured values in the plane of incidence, every 2°.
/// \param value  by θ_i and the angle to the side of the mirror direction, in degrees
Table measured_in_plane(int angles, const std::function<double(double, double)>& value) {
  Table t = test::list_of({});
  DirectionList l;
  for (int k = 0; k < angles; ++k)
    for (int out = -80; out <= 80; out += 2) {
      l.theta_i_deg.push_back(10 + 60.0 * k / (angles - 1));
      l.phi_i_deg.push_back(0);
      l.theta_o_deg.push_back(std::abs(out));
      l.phi_o_deg.push_back(out < 0 ? 0 : 180);
      t.values[0].push_back(value(l.theta_i_deg.back(), out));
    }
  t.where = std::move(l);
  return t;
}

TEST(LackOfFit, OfHalfAProfileOfOneAngleIsToldOrNotKnown) {
  DirectionList l;
  for (int k = 0; k < 24; ++k) {
    l.theta_i_deg.push_back(45);
    l.phi_i_deg.push_back(0);
    l.theta_o_deg.push_back(45 + 40.0 * k / 23);
    l.phi_o_deg.push_back(180);
  }
  const auto fitted = [&](const BoundModel& m, unsigned seed) {
    Table t = test::list_of({});
    t.where = l;
    test::put_values(t, m);
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    for (double& v : t.values[0]) v *= std::exp(0.01 * normal(random));
    return fit_of(t).misfit;
  };
  const std::string both = std::string(paint) + "+ggx/smith_ggx.correlated/schlick";
  const auto two = test::bind(both.c_str(), "alpha=0.08,alpha_2=0.5,f0=0.04,f0_2=0.06,kd=0.05", 1);
  const auto one = test::bind(paint, "alpha=0.2,f0=0.04,kd=0.05", 1);
  int accused = 0, unknown = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const auto wrong = fitted(two, seed), right = fitted(one, seed);
    EXPECT_TRUE(wrong.told || wrong.too_few) << seed;
    accused += right.told, unknown += right.too_few;
  }
  EXPECT_LE(accused, 0);
  EXPECT_LE(unknown, 2);
}

TEST(LackOfFit, OfAParameterAtItsBoundIsTold) {
  for (const double value : {0.6123456789, 0.6})
    for (const int angles : {4, 14}) {
      const auto d =
          fit_of(measured_in_plane(angles, [&](double, double) { return value; }), "lambert");
      EXPECT_EQ(test::parameter(d, "kd").status[0], ParameterStatus::at_bound);
      EXPECT_TRUE(d.misfit.told) << d.misfit.note;
      EXPECT_NEAR(d.misfit.size, d.residuals.log_rms, 0.02) << value << " " << angles;
    }
}

TEST(LackOfFit, OfScalesThatRunSmoothlyOverIncidentAnglesOrThatTwoAzimuthsHaveIsTold) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  const auto told = [&](const std::function<double(double, double)>& gain) {
    return fit_of(measured_in_plane(14,
                                    [&](double in, double out) {
                                      return 0.1 * std::exp(0.01 * normal(random) + gain(in, out));
                                    }),
                  "lambert")
        .misfit.told;
  };
  EXPECT_TRUE(told([](double in, double) { return 0.06 * std::cos(in * degree * 2.5); }));
  EXPECT_TRUE(told([](double, double out) { return out < 0 ? 0.06 : -0.06; }));
  EXPECT_FALSE(told([](double, double out) { return out < 0 ? 0.02 : -0.02; }));
  EXPECT_FALSE(told([&](double in, double) {  // of each angle its own
    return 0.03 * std::sin(1e4 * in);
  }));
}

TEST(LackOfFit, OfATablesScaleIsToldThoughAFactorOfEachAngleTakesItUp) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  const auto metal = test::bind("ggx/smith_ggx.correlated/schlick", "alpha=0.25,f0=0.08", 1);
  const auto told = [&](double scale) {
    return fit_of(measured_in_plane(
                      14,
                      [&](double in, double out) {
                        const std::vector at{frame_angles(
                            {direction(in * degree, 0),
                             direction(std::abs(out) * degree, out < 0 ? 0 : std::numbers::pi)})};
                        return scale * evaluate(metal, at)[0][0] * std::exp(0.01 * normal(random));
                      }),
                  "ggx/smith_ggx.correlated/schlick")
        .misfit.told;
  };
  EXPECT_TRUE(told(1.5));
  EXPECT_FALSE(told(1));
}

TEST(LackOfFit, OfScalesOfAnglesIsToldWhereNoInstrumentErrsSoMuch) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  const auto told = [&](double gain) {
    return fit_of(measured_in_plane(6,
                                    [&](double in, double) {
                                      const bool up = std::lround(in / 12) % 2 == 0;
                                      return 0.1 *
                                             std::exp(0.01 * normal(random) + (up ? gain : -gain));
                                    }),
                  "lambert")
        .misfit.told;
  };
  EXPECT_TRUE(told(0.3));
  EXPECT_FALSE(told(0.03));
}

TEST(LackOfFit, OfARippleThatNoSmoothFunctionFollowsIsToldBesideTheNoise) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  const auto told = [&](double ripple) {
    return fit_of(measured_in_plane(10,
                                    [&](double, double out) {
                                      return 0.1 * std::exp(0.002 * normal(random) +
                                                            ripple * std::sin(out * 2 * M_PI / 24));
                                    }),
                  "lambert")
        .misfit.told;
  };
  EXPECT_TRUE(told(0.1));
  EXPECT_FALSE(told(0));
}

TEST(OddAngle, IsNamedWhereOneFileOfSixHasAnotherScaleAndNeitherOfAWrongModelNorOfSmallScales) {
  const auto odd = [](const char* model, const char* values, double at, double scale,
                      double of_each) {
    Table t = synthesize(test::bind(model, values, 1),
                         {.layout = Layout::hemisphere, .noise = 0.02, .seed = 3});
    t.truth.reset();  // as if measured
    for (std::size_t i = 0; i < t.size(); ++i) {
      const double in = t.list()->theta_i_deg[i];
      t.values[0][i] *= in == at ? scale : std::exp(of_each * std::cos(2 * in));
    }
    std::string named;
    for (const auto& w : fit_of(t).warnings)
      if (w.find("another scale?") != w.npos) named = w;
    return named;
  };
  const char* const right = "alpha=0.3,f0=0.05,kd=0.2";
  for (const double at : {0., 15., 45., 75.})
    for (const double scale : {1.1, 0.7})
      EXPECT_NE(odd(paint, right, at, scale, 0).find(fmt::format("theta_i {:g}°", at)),
                std::string::npos)
          << at << ' ' << scale;
  EXPECT_EQ(odd(paint, right, -1, 1, 0.03), "");
  EXPECT_EQ(odd("lambert+gtr/smith_ggx.correlated/schlick", "alpha=0.3,gamma=1.2,f0=0.05,kd=0.05",
                -1, 1, 0),
            "");
  EXPECT_EQ(odd("lambert+beckmann/smith_beckmann.correlated/schlick", right, -1, 1, 0), "");
  EXPECT_EQ(odd("lambert+ggx/smith_ggx.separable/schlick", "alpha=0.7,f0=0.3,kd=0.02", -1, 1, 0),
            "");
}

TEST(LackOfFit, WidensTheIntervals) {
  Uncertainty u(2);
  u[0].std_error = 0.1;
  u[0].variance = 1;
  auto few = u;
  widen(u, LackOfFit{{}, 3}, u.std_errors());
  EXPECT_NEAR(u[0].std_error, 0.3, 1e-15);
  EXPECT_NEAR(u[0].variance, 9, 1e-14);
  EXPECT_TRUE(std::isnan(u[1].std_error));
  // Of clusters that make wide intervals as they are.
  const std::vector<double> values{0.01, 0.01};
  widen(few, LackOfFit{{}, 3}, values);
  EXPECT_NEAR(few[0].std_error, std::sqrt(0.01 + 8 * 1e-4), 1e-15);
}

TEST(LackOfFit, IsIncludedInTheIntervals) {
  // An exact Fresnel term is told apart from Schlick's by nothing but the residuals.
  unsigned inside = 0, all = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const auto d = fit_of(synthesize(
        test::bind("lambert+ggx/smith_ggx.correlated/dielectric", "alpha=0.6,eta=1.5,kd=0.1", 1),
        {.layout = Layout::random, .samples = 60, .noise = 0.01, .seed = seed}));
    const auto& f0 = test::parameter(d, "f0");
    inside += f0.ci95_low[0] <= 0.04 && 0.04 <= f0.ci95_high[0];
    all += d.misfit.told;
  }
  EXPECT_EQ(all, 5U);
  EXPECT_GE(inside, 4U);
}

TEST(LackOfFit, AddsToAnErrorWhatItDoesToTheErrorThatItWasJudgedAgainst) {
  EXPECT_NEAR(widened(3, 2, 1), std::sqrt(9.0 + 3.0), 1e-15);
  EXPECT_NEAR(widened(3, 2, std::nan("")), 6, 1e-14);
  EXPECT_EQ(widened(3, 1, 1), 3);
}

TEST(LackOfFit, OfAModelOfWhichNothingIsFreeIsTold) {
  const Table t = synthesize(test::bind("lambert", "kd=0.2", 1), {.layout = Layout::in_plane});
  FitOptions o;
  o.model = "lambert";
  o.fixed = {{"kd", {0.3}}};
  const auto m = fit(t, o).document.misfit;
  EXPECT_TRUE(m.told);
  EXPECT_NEAR(m.size, 0.4, 0.1);
}

TEST(LackOfFit, TellsNoiseThatGrowsTowardsGrazingFromAWrongModel) {
  const auto settings = "alpha=0.2,f0=0.05,kd=0.1";
  const auto told = [&](const BoundModel& truth, unsigned seed) {
    Table t;
    t.format = "csv";
    t.channels = {"f"};
    DirectionList l;
    for (const double in : {10, 30, 50, 70})
      for (double out = -80; out <= 80; out += 10) {
        l.theta_i_deg.push_back(in), l.phi_i_deg.push_back(0);
        l.theta_o_deg.push_back(std::abs(out)), l.phi_o_deg.push_back(out < 0 ? 0 : 180);
      }
    t.where = std::move(l);
    test::put_values(t, truth);
    const SampleAngles at(t);
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    for (std::size_t i = 0; i < t.size(); ++i)
      t.values[0][i] *= std::exp(0.01 / at(i).nov * normal(random));
    FitOptions o;
    o.model = paint;
    return fit(t, o).document.misfit.told;
  };
  const auto seeds = static_cast<unsigned>(test::few(20));
  unsigned accused = 0, missed = 0;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    accused += told(test::bind(paint, settings, 1), seed);
    missed +=
        !told(test::bind("lambert+beckmann/smith_beckmann.correlated/schlick", settings, 1), seed);
  }
  EXPECT_EQ(accused, 0U);
  EXPECT_EQ(missed, 0U);
}

}  // namespace
}  // namespace gonio
