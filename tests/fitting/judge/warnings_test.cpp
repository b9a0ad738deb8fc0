// What a reader must know before believing the numbers is said, and nothing else.
#include "fitting/judge/warnings.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "fitting/choice/choice.h"
#include "fitting/fit.h"
#include "fitting/support.h"
#include "table/paint.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

FitResult fit_synthetic(const char* model, const std::string& settings, const SynthOptions& s) {
  FitOptions o;
  o.model = model;
  return fit(synthesize(test::bind(model, settings, 3), s), o);
}

TEST(Warnings, SaysThatThePeakIsNotResolved) {
  FitOptions o;
  const auto unresolved = [&](const std::string& alpha) {
    const Table t = synthesize(test::bind(o.model.c_str(), alpha + ",kd=0.1", 3),
                               {.layout = Layout::mbsdf, .noise = 0.02});
    const auto d = fit(t, o).document;
    TableFacts facts(t);
    const bool is = with_table({}, o, facts, d).unresolved.has_value();
    EXPECT_EQ(d.warnings.size(), is ? 1U : 0U);
    return is;
  };
  EXPECT_TRUE(unresolved("alpha=0.01"));
  EXPECT_FALSE(unresolved("alpha=0.3"));
}

TEST(Warnings, SaysWhenTheModelDoesNotDescribeTheTable) {
  const char *metal = "ggx/smith_ggx.correlated/schlick", *settings = "alpha=0.3,f0=0.95,0.64,0.54";
  const Table t = synthesize(test::bind(metal, settings, 3), {.layout = Layout::random});
  FitOptions o;
  o.model = "lambert";
  const auto d = fit(t, o).document;
  EXPECT_GT(d.misfit.size, 0.5);
  const auto words = misfit_in_words(d.misfit, false);  // no interval of a model so wrong
  EXPECT_FALSE(words.empty());
  EXPECT_TRUE(std::ranges::mismatch(words, d.warnings).in1 == words.end()) << "they come first";
  EXPECT_TRUE(fit_synthetic(metal, settings, {.layout = Layout::random}).document.warnings.empty());
}

TEST(Warnings, LookForThePeakOfALobeWhoseWidthHasALimitAlone) {
  const Table t = synthesize(test::bind("ggx/smith_ggx.correlated/schlick", "alpha=0.01", 1),
                             {.layout = Layout::mbsdf});
  TableFacts facts(t);
  FitDocument d;
  const double none = std::nan("");
  const auto unresolved = [&](double limit) {
    d.parameters = {
        {"alpha", {none}, {none}, {none}, {none}, {ParameterStatus::upper_limit}, {limit}, {""}}};
    return with_table({}, {}, facts, d).unresolved.has_value();
  };
  EXPECT_TRUE(unresolved(0.02));
  EXPECT_FALSE(unresolved(0.5)) << "looking for it takes as long as a fit";
}

TEST(Warnings, TellAMisfitsSizeAndItsPlaceApart) {
  Misfit m;
  m.told = true;
  m.size = 0.084;
  m.follows = {"theta_h", "theta_d", "grazing angles"};
  m.worst_cell = {10, 22.5, 60, 75, 40, -0.3};
  EXPECT_EQ(misfit_in_words(m, true),
            (std::vector<std::string>{"beyond noise the model is off by a factor of 1.088, "
                                      "varying with every angle; intervals are widened",
                                      "for instance, around theta_h 16°, theta_d 68° the model is "
                                      "on average too dark by a factor of 1.43"}));
  m.follows = {"theta_h", "grazing angles"};
  EXPECT_NE(misfit_in_words(m, true)[0].find("varying with theta_h and at grazing angles;"),
            std::string::npos);
  m.worst_cell->difference = 2.4;
  EXPECT_TRUE(misfit_in_words(m, true)[1].ends_with(" on average too bright by a factor of 3.4"));
  m.worst_cell->difference = 1.0 / 150 - 1;
  EXPECT_TRUE(misfit_in_words(m, true)[1].ends_with(" on average too dark by a factor of 150"));
  m.told = false;
  EXPECT_TRUE(misfit_in_words(m, true).empty());
}

TEST(Warnings, SayThatIntervalsAllowForAMisfitOnlyWhereThereAreSome) {
  FitDocument d;
  d.misfit.told = true;
  d.misfit.size = 0.5;
  const double none = std::nan("");
  const auto said = [&](ParameterStatus status, ParameterStatus other) {
    d.parameters = {{"kd", {0.1, 0.1}, {1, 1}, {0, 0}, {1, 1}, {status, other}, {none, none}, {}}};
    d.parameters[0].reason = {"", ""};
    return warnings({}, Table{}, d, {})[0].ends_with("; intervals are widened");
  };
  using enum ParameterStatus;
  EXPECT_TRUE(said(unbounded, free));
  for (const auto status : {unbounded, at_bound, fixed, not_identifiable, upper_limit})
    EXPECT_FALSE(said(status, unbounded)) << static_cast<int>(status);
}

TEST(Warnings, NameNoMetricThatTheFitHas) {
  Table t = test::painted(180, 0.05, 0.15);
  for (double& f : t.values[0]) f -= 0.018;
  for (const Metric metric : {Metric::log, Metric::l2_cosine}) {
    FitOptions o;
    o.metric = metric;
    const auto all = fit(t, o).document.warnings;
    EXPECT_TRUE(test::says(all, "rather an offset than noise"));
    EXPECT_EQ(test::says(all, "--metric l2_cosine"), metric == Metric::log);
    const auto compared = compare_models(t, o, std::vector<std::string>{"lambert"}).warnings;
    EXPECT_EQ(test::says(compared, "--metric l2_cosine"), metric == Metric::log);
  }
}

/// Numbers of a sentence: runs of digits, points, signs of powers.
std::ptrdiff_t numbers_in(const std::string& s) {
  std::ptrdiff_t n = 0;
  bool within = false;
  for (const char c : s) {
    const bool digit = c >= '0' && c <= '9';
    n += digit && !within;
    within = digit || (within && (c == '.' || c == 'e' || c == '-' || c == '+'));
  }
  return n;
}

TEST(Warnings, SayOneThingEachInFewWordsAndNumbers) {
  const auto all_of = [](const char* model, const char* settings, const SynthOptions& s,
                         const std::function<void(Table&)>& spoil, const char* fitted) {
    Table t = synthesize(test::bind(model, settings, 1), s);
    spoil(t);
    FitOptions o;
    o.model = fitted;
    return fit(t, o).document.warnings;
  };
  constexpr const char* paint = "lambert+ggx/smith_ggx.correlated/schlick";
  const auto as_it_is = [](Table&) {};
  const auto measured = [](Table& t) { t.truth.reset(); };
  const auto copied = [](Table& t) {
    const auto& axes = t.grid()->axes;
    const std::size_t row = axes[1].size * axes[2].size;
    for (auto& plane : t.values)
      for (std::size_t k = 0; k < row; ++k) plane[row + k] = plane[k];
  };
  const auto floor = [](Table& t) {
    for (auto& plane : t.values)
      for (std::size_t k = 0; k < plane.size(); k += 20) plane[k] = -1e-4;
  };
  std::size_t said = 0;
  for (const auto& list :
       {all_of("lambert+gtr/smith_ggx.correlated/schlick", "alpha=0.3,gamma=1,f0=0.05,kd=0.2",
               {.layout = Layout::in_plane, .noise = 0.01}, measured, paint),
        all_of(paint, "alpha=0.01,f0=0.05,kd=0.1", {.layout = Layout::mbsdf, .noise = 0.02}, copied,
               paint),
        all_of(paint, "alpha=0.3,f0=0.05,kd=0.98", {.layout = Layout::hemisphere}, as_it_is, paint),
        all_of(paint, "alpha=0.3,f0=0.05,kd=0.1", {.layout = Layout::in_plane, .noise = 0.02},
               floor, "lambert")})
    for (const auto& w : list) {
      ++said;
      EXPECT_LE(w.size(), 118U) << w;  // bytes; ° has two
      EXPECT_LE(numbers_in(w), 3) << w;
    }
  EXPECT_GE(said, 8U);
}

TEST(Warnings, SayWhatRelativeErrorsShiftWhereItIsMoreThanAnInterval) {
  const auto warned = [](Metric metric, double noise, std::size_t samples, double outliers) {
    FitOptions o;
    o.metric = metric;
    o.robust = outliers > 0;
    const auto d = fit(synthesize(test::bind(o.model.c_str(), "alpha=0.2,f0=0.05,kd=0.2", 1),
                                  {.layout = Layout::random,
                                   .samples = samples,
                                   .noise = noise,
                                   .outliers = outliers}),
                       o)
                       .document;
    return std::ranges::any_of(d.warnings, [](const std::string& w) {
      return w.starts_with("relative errors shift values by about");
    });
  };
  EXPECT_TRUE(warned(Metric::relative, 0.05, 2000, 0));
  EXPECT_TRUE(warned(Metric::relative, 0.02, 2000, 0.2));
  EXPECT_FALSE(warned(Metric::relative, 0.01, 60, 0));
  EXPECT_FALSE(warned(Metric::log, 0.05, 2000, 0));
}

TEST(Warnings, EnoughAnglesAreEight) {
  EXPECT_TRUE(enough_angles(8));
  EXPECT_FALSE(enough_angles(7));
}

}  // namespace
}  // namespace gonio
