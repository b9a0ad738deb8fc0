// Tables that are hard to fit: what comes out is right within its intervals, or says that it is
// not.
#include <algorithm>
#include <cmath>

#include "fitting/fit.h"
#include "fitting/judge/warnings.h"
#include "fitting/sample/data.h"
#include "fitting/solve/search.h"
#include "fitting/support.h"
#include "many_fits.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace gonio {
namespace {

constexpr const char* paint = "lambert+ggx/smith_ggx.correlated/schlick";
constexpr const char* metal = "ggx/smith_ggx.correlated/schlick";
constexpr Metric metrics[] = {Metric::log, Metric::relative, Metric::l2_cosine};
constexpr Layout lists[] = {Layout::in_plane, Layout::hemisphere, Layout::random};

/// True where a document says that values may lie outside their intervals: of a misfit, of more light than there is, of a
/// dark channel, of errors that shift values.
bool has_reservations(const FitDocument& d) {
  return d.misfit.told || returns_too_much(d.physics) ||
         std::ranges::any_of(d.physics.peak_ratio, [](double r) { return std::isinf(r); }) ||
         std::ranges::any_of(d.warnings, [](const std::string& w) {
           return w.find("more than intervals allow for") != w.npos;
         });
}

/// True where a value and its interval, its limit or its reason say nothing false of the truth: 95 % intervals
/// of many fits are left two times their width.
bool is_true(const FittedParameter& p, std::size_t c, double truth) {
  switch (p.status[c]) {
    case ParameterStatus::fixed:
      return p.value[c] == truth;
    case ParameterStatus::free:
    case ParameterStatus::unbounded:
      if (std::isnan(p.std_error[c])) return !p.reason[c].empty();
      return std::abs(p.value[c] - truth) <= p.ci95_high[c] - p.ci95_low[c] + 1e-9;
    case ParameterStatus::at_bound:
      return std::abs(p.value[c] - truth) <= 0.02;
    case ParameterStatus::not_identifiable:
      return std::isnan(p.value[c]) && !p.reason[c].empty();
    case ParameterStatus::upper_limit:
      return truth <= p.limit[c] + 1e-9;
    case ParameterStatus::lower_limit:
      return truth >= p.limit[c] - 1e-9;
  }
  return false;
}

FitOptions comparing(Metric metric, bool robust = false) {
  FitOptions o;
  o.metric = metric;
  o.robust = robust;
  return o;
}

struct HardTable {
  const char* model;
  const char* settings;
  SynthOptions synth = {};
  FitOptions fit = {};
};

/// Fits what a table of the model has become.  In logarithms, which a factor on values does not bend, every
/// statement is true; elsewhere it is or the document has reservations.
FitDocument expect_true_of(HardTable h, auto&& change) {
  const auto truth = test::bind(h.model, h.settings, 3);
  Table t = synthesize(truth, h.synth);
  change(t);
  h.fit.model = h.model;
  h.fit.bin_sensitivity = false;
  auto d = fit(t, h.fit).document;
  EXPECT_EQ(d.solver.termination, "converged");
  if (h.fit.metric != Metric::log && has_reservations(d)) return d;
  for (const auto& p : truth.model.parameters)
    for (std::size_t c = 0; c < p.count; ++c) {
      const auto& q = test::parameter(d, p.name);
      EXPECT_TRUE(is_true(q, c, truth.values[p.first + c])) << fmt::format(
          "{} {} from {} by {}: {} = {} ± {}, {}", h.model, h.settings, name_of(h.synth.layout),
          name_of(h.fit.metric), p.name, q.value[c], q.std_error[c], name_of(q.status[c]));
    }
  return d;
}
FitDocument expect_true_of(const HardTable& h) {
  return expect_true_of(h, [](Table&) {});
}

TEST(HardData, OfAMirrorNarrowerThanABinIsFittedAndSaidToBeUnresolved) {
  GONIO_MANY_FITS();
  for (const auto metric : metrics)
    for (const auto layout : {Layout::in_plane, Layout::hemisphere, Layout::mbsdf})
      for (const auto& [model, settings] :
           {std::pair{metal, "alpha=0.001,f0=0.5"}, {paint, "alpha=0.001,f0=0.05,kd=0.3"}}) {
        const auto d =
            expect_true_of({model, settings, {.layout = layout, .noise = 0.02}, comparing(metric)});
        const bool known = test::parameter(d, "alpha").status[0] == ParameterStatus::free;
        EXPECT_TRUE(!known || std::ranges::any_of(d.warnings,
                                                  [](const std::string& w) {
                                                    return w.starts_with(
                                                        "the table does not resolve its highlight");
                                                  }))
            << name_of(layout) << " " << name_of(metric);
      }
}

TEST(HardData, OfTheEndsOfWidthAndReflectanceIsFitted) {
  GONIO_MANY_FITS();
  for (const auto metric : metrics)
    for (const auto layout : lists)
      for (const char* settings :
           {"alpha=1,f0=0.5,kd=0.3", "alpha=1,f0=0.04,kd=0.3", "alpha=0.2,f0=0,kd=0.3",
            "alpha=0.2,f0=1,kd=0.3", "alpha=0.2,f0=0,kd=0", "alpha=0.2,f0=1,kd=0",
            "alpha=0.2,f0=0,0.5,1,kd=0,0.5,1"})
        expect_true_of({paint, settings, {.layout = layout, .noise = 0.02}, comparing(metric)});
}

TEST(HardData, OfSamplesThatStandTwiceHasTheSameValues) {
  for (const auto metric : metrics) {
    const HardTable h{paint,
                      "alpha=0.2,f0=0.05,kd=0.3",
                      {.layout = Layout::random, .samples = 300, .noise = 0.02},
                      comparing(metric)};
    const auto once = expect_true_of(h),
               twice = expect_true_of(h, [](Table&t) {
                 auto list = *t.list();
                 const auto repeat = [](auto& column) {
                   const std::vector before(column.begin(), column.end());
                   column.insert(column.end(), before.begin(), before.end());
                 };
                 for (auto* angle :
                      {&list.theta_i_deg, &list.phi_i_deg, &list.theta_o_deg, &list.phi_o_deg})
                   repeat(*angle);
                 for (auto& plane : t.values) repeat(plane);
                 t.where = std::move(list);
               });
    for (const char* name : {"alpha", "f0", "kd"})
      EXPECT_NEAR(test::parameter(twice, name).value[0] / test::parameter(once, name).value[0], 1,
                  1e-6);
  }
}

TEST(HardData, OfADarkChannelKnowsTheOthersOrSaysThatItBendsThem) {
  for (const auto metric : metrics)
    for (const auto layout : {Layout::in_plane, Layout::random}) {
      const auto d = expect_true_of({paint,
                                     "alpha=0.2,f0=0.05,kd=0.3,0,0.3",
                                     {.layout = layout, .noise = 0.02},
                                     comparing(metric)},
                                    [](Table& t) {
                                      for (auto& v : t.values[1]) v = 0;
                                    });
      for (const auto& w : d.warnings) EXPECT_EQ(w.find("inf"), w.npos) << w;
      EXPECT_NE(test::parameter(d, "f0").status[1], ParameterStatus::free);
    }
}

TEST(HardData, OfOneIncidentAngleIsFitted) {
  for (const auto metric : metrics)
    for (const char* settings : {"alpha=0.2,f0=0.05,kd=0.3", "alpha=0.02,f0=0.5,kd=0.01"})
      expect_true_of(
          {paint, settings, {.layout = Layout::in_plane, .noise = 0.02}, comparing(metric)},
          [](Table& t) {
            const auto& theta_i = t.list()->theta_i_deg;
            for (std::size_t i = 0; i < t.size(); ++i)
              if (theta_i[i] != theta_i[0])
                for (auto& plane : t.values) plane[i] = std::nan("");
          });
}

TEST(HardData, OfThirtyPercentNoiseIsFittedOrSaidToBeShifted) {
  GONIO_MANY_FITS();
  for (const auto metric : metrics)
    for (const auto layout : lists)
      for (const std::uint64_t seed : {1, 2, 3}) {
        const auto d = expect_true_of({paint,
                                       "alpha=0.2,f0=0.05,kd=0.3",
                                       {.layout = layout, .noise = 0.3, .seed = seed},
                                       comparing(metric)});
        EXPECT_TRUE(metric != Metric::relative || has_reservations(d));
      }
}

TEST(HardData, OfTwentyPercentOutliersIsFittedOrSaidToBeShifted) {
  GONIO_MANY_FITS();
  for (const auto metric : {Metric::log, Metric::relative})
    for (const auto layout : lists)
      for (const bool robust : {false, true}) {
        const auto d = expect_true_of({paint,
                                       "alpha=0.2,f0=0.05,kd=0.3",
                                       {.layout = layout, .noise = 0.02, .outliers = 0.2},
                                       comparing(metric, robust)});
        if (robust) {
          EXPECT_NEAR(test::parameter(d, "alpha").value[0], 0.2, 0.01);
        }
      }
}

TEST(HardData, OfATrillionthOrATrillionTimesTheLightIsNoMaterialAndSaidToBe) {
  for (const auto metric : metrics)
    for (const double factor : {1e-12, 1e12}) {
      Table t = synthesize(test::bind(paint, "alpha=0.2,f0=0.05,kd=0.3", 3),
                           {.layout = Layout::random, .noise = 0.02});
      for (auto& plane : t.values)
        for (auto& v : plane) v *= factor;
      FitOptions o;
      o.metric = metric;
      const auto d = fit(t, o).document;
      EXPECT_TRUE(has_reservations(d)) << factor;
      for (const auto& p : d.parameters)
        for (std::size_t c = 0; c < p.value.size(); ++c)
          EXPECT_TRUE(p.status[c] != ParameterStatus::free || !p.reason[c].empty())
              << p.name << " " << factor << " " << name_of(metric);
      // What has no unit to be wrong in has no trouble.
      o.model = "lambert";
      for (auto& plane : t.values)
        for (auto& v : plane) v = factor < 1 ? v : v / factor * 1e-12;
      EXPECT_LE(test::parameter(fit(t, o).document, "kd").value[0], 1e-11);
    }
}

TEST(HardData, SolvesFromEveryCornerOfTheBounds) {
  for (const auto& [model, settings] :
       {std::pair{paint, "alpha=0.2,f0=0.05,kd=0.3"},
        {"lambert+gtr/smith_gtr.correlated/schlick", "alpha=0.2,gamma=1.5,f0=0.05,kd=0.3"},
        {"eon+student_t/smith_student_t.correlated/schlick",
         "alpha=0.2,tail=0.4,f0=0.05,kd=0.3,r=0.6"},
        {"gtr1/smith_ggx.separable/f82", "alpha=0.1,f0=0.7,f82_tint=0.8"},
        {"beckmann/smith_beckmann.correlated/conductor", "alpha=0.2,eta=0.3,k=4"},
        {"blinn_phong/smith_beckmann.rational/gulbrandsen", "alpha=0.2"},
        {"disney+ggx/smith_ggx.separable/lazanyi", "alpha=0.2,kd=0.3"}})
    for (const auto metric : metrics) {
      const auto truth = test::bind(model, settings, 1);
      const Table t = synthesize(truth, {.layout = Layout::random, .samples = 200, .noise = 0.02});
      FitOptions o;
      o.model = model;
      o.metric = metric;
      const Problem p = pose(t, o);
      const Sampling s(t, t.bins(), metric, 0, true);
      const auto data = fit_data<double>(s, t.size());
      const std::size_t n = p.bounds.low.size();
      for (std::size_t corner = 0; corner < (std::size_t{1} << std::min<std::size_t>(n, 6));
           ++corner) {
        std::vector<double> at(n);
        for (std::size_t k = 0; k < n; ++k)
          at[k] = corner >> std::min<std::size_t>(k, 5) & 1 ? p.bounds.high[k] : p.bounds.low[k];
        BoundModel from = p.start;
        p.free.put(at, from.values);
        const auto f = minimise(p, data, from, no_huber);
        const auto found = p.free.of(f.model.values);
        EXPECT_TRUE(std::isfinite(f.solution.at.cost)) << model << " from corner " << corner;
        for (std::size_t k = 0; k < n; ++k)
          EXPECT_TRUE(p.bounds.low[k] <= found[k] && found[k] <= p.bounds.high[k])
              << model << " from corner " << corner << ": " << found[k];
      }
    }
}

}  // namespace
}  // namespace gonio
