// What was put in comes out: parameters recovered from synthesized tables.
#include "fitting/fit.h"

#include <array>
#include <cmath>
#include <map>
#include <random>
#include <span>

#include "../support.h"
#include "base/error.h"
#include "brdf/model/evaluate.h"
#include "fitting/goniometer.h"
#include "fitting/support.h"
#include "many_fits.h"
#include "refusal.h"
#include "table/format/formats.h"
#include "table/sample_mask.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace gonio {
namespace {

using test::few;
using test::parameter;

constexpr const char* paint = "lambert+ggx/smith_ggx.correlated/schlick";
constexpr const char* metal = "ggx/smith_ggx.correlated/schlick";
constexpr const char* gtr = "lambert+gtr/smith_ggx.correlated/schlick";

struct Material {
  const char* name;
  const char* model;
  std::vector<std::string> settings;
};
const Material materials[] = {
    {"paint", paint, {"alpha=0.15", "f0=0.05", "kd=0.2,0.1,0.05"}},
    {"metal", metal, {"alpha=0.3", "f0=0.95,0.64,0.54"}},
    {"gtr_1_5", gtr, {"alpha=0.15", "gamma=1.5", "f0=0.05", "kd=0.2,0.1,0.05"}},
    {"gtr_3", gtr, {"alpha=0.15", "gamma=3", "f0=0.05", "kd=0.2,0.1,0.05"}},
};

/// Each true value with its fitted one and its error.
template <class Check>
void each_value(const Material& m, const FitDocument& d, Check&& check) {
  const BoundModel truth = bind_model(m.model, parse_settings(m.settings), 3);
  for (const auto& p : truth.model.parameters) {
    const auto& q = parameter(d, p.name);
    ASSERT_EQ(q.value.size(), p.count);
    for (std::size_t c = 0; c < p.count; ++c)
      check(p.name, truth.values[p.first + c], q.value[c], q.std_error[c]);
  }
}

FitResult fit_synthetic(const Material& m, const SynthOptions& s, FitOptions o = {}) {
  o.model = m.model;
  Table t = synthesize(bind_model(m.model, parse_settings(m.settings), 3), s);
  if (o.metric == Metric::uncertainty) {
    t.errors = t.values;
    for (auto& plane : t.errors)
      for (double& u : plane) u = std::max(0.01 * u, 1e-9);
  }
  return fit(t, o);
}

class Recovery : public testing::TestWithParam<Material> {
  void SetUp() override {
    if (GetParam().name != materials[0].name) GONIO_MANY_FITS();
  }
};

TEST_P(Recovery, FromANoiseFreeMerlTableIsExact) {
  FitOptions o;
  o.bin_sensitivity = false;
  const auto r = fit_synthetic(GetParam(), {}, o);
  EXPECT_EQ(r.document.solver.termination, "converged");
  each_value(GetParam(), r.document, [](const auto& name, double truth, double fitted, double) {
    EXPECT_NEAR(fitted / truth, 1, 1e-6) << name;
  });
}

TEST_P(Recovery, FromANoisyMerlTableIsWithinFourStandardErrors) {
  SynthOptions s;
  s.noise = 0.02;
  FitOptions o;
  o.bin_sensitivity = false;
  const auto r = fit_synthetic(GetParam(), s, o);
  each_value(GetParam(), r.document,
             [](const auto& name, double truth, double fitted, double error) {
               EXPECT_LT(std::abs(fitted - truth), 4 * error) << name;
               EXPECT_LT(error, 0.01 * truth) << name;  // a million bins know it well
             });
}

TEST_P(Recovery, WorksFromEveryLayoutAndMetric) {
  for (std::size_t l = 0; l < names_of<Layout>.size(); ++l)
    for (std::size_t k = 0; k < names_of<Metric>.size(); ++k) {
      SynthOptions s;
      s.layout = static_cast<Layout>(l);
      if (s.layout == Layout::merl) continue;                // above
      if (s.layout == Layout::rgl && few(2) == 1) continue;  // 127,040 samples
      if (k >= few(names_of<Metric>.size())) continue;
      FitOptions o;
      o.metric = static_cast<Metric>(k);
      o.bin_sensitivity = false;
      const auto r = fit_synthetic(GetParam(), s, o);
      each_value(GetParam(), r.document,
                 [&](const auto& name, double truth, double fitted, double) {
                   EXPECT_NEAR(fitted / truth, 1, 1e-5)
                       << name << " " << names_of<Layout>[l] << " " << names_of<Metric>[k];
                 });
    }
}

INSTANTIATE_TEST_SUITE_P(Materials, Recovery, testing::ValuesIn(materials), [](const auto& i) {
  return std::string(i.param.name);
});

TEST(Fit, RecoversIndicesOfDielectricAndConductor) {
  const Material plastic{"plastic",
                         "lambert.coupled+ggx/smith_ggx.separable/dielectric",
                         {"alpha=0.2", "eta=1.6", "kd=0.5,0.3,0.1"}};
  const Material copper{"copper", "ggx/smith_ggx.correlated/conductor", {"alpha=0.25", "metal=Cu"}};
  SynthOptions s;
  s.layout = Layout::random;
  for (const auto& m : {plastic, copper}) {
    const auto r = fit_synthetic(m, s);
    each_value(m, r.document, [](const auto& name, double truth, double fitted, double) {
      EXPECT_NEAR(fitted / truth, 1, 1e-4) << name;
    });
  }
}

TEST(Fit, RecoversTheTailOfStudentsTAndTheTiltOfEonsFacets) {
  const Material cloth{"cloth",
                       "eon+student_t/smith_student_t.correlated/schlick",
                       {"alpha=0.2", "tail=0.45", "f0=0.05", "kd=0.3", "r=0.6"}};
  SynthOptions s;
  s.layout = Layout::random;
  const auto r = fit_synthetic(cloth, s);
  each_value(cloth, r.document, [](const auto& name, double truth, double fitted, double) {
    EXPECT_NEAR(fitted / truth, 1, 1e-6) << name;
  });
}

TEST(Fit, HoldsWhatIsFixedAndStaysInsideItsBounds) {
  SynthOptions s;
  s.layout = Layout::random;
  FitOptions o;
  o.fixed = {{"gamma", {2}}};
  o.bounds = {{"alpha", {0.2, 0.5}}};
  const auto r = fit_synthetic(materials[2], s, o);
  EXPECT_EQ(parameter(r.document, "gamma").value[0], 2);
  EXPECT_EQ(parameter(r.document, "gamma").status[0], ParameterStatus::fixed);
  EXPECT_EQ(parameter(r.document, "alpha").value[0], 0.2);  // the truth, 0.15, lies outside
  EXPECT_EQ(parameter(r.document, "alpha").status[0], ParameterStatus::at_bound);
}

TEST(Fit, OfAGreyParameterHasOneValue) {
  SynthOptions s;
  s.layout = Layout::random;
  FitOptions o;
  o.grey = {"f0"};
  const auto r = fit_synthetic(materials[0], s, o);
  ASSERT_EQ(parameter(r.document, "f0").value.size(), 1U);
  EXPECT_NEAR(parameter(r.document, "f0").value[0], 0.05, 1e-7);
}

TEST(Fit, FindsAPeakMuchNarrowerThanTheFirstGuess) {
  const Material needle{"needle", metal, {"alpha=0.0005", "f0=0.5"}};
  FitOptions o;
  o.bin_sensitivity = false;
  const auto r = fit_synthetic(needle, {.layout = Layout::image_slice, .noise = 0.02}, o);
  EXPECT_NEAR(parameter(r.document, "alpha").value[0], 0.0005, 1e-6);
  EXPECT_NEAR(parameter(r.document, "f0").value[0], 0.5, 1e-3);
}

TEST(Fit, DoesNotDependOnTheUnitOfTheWeightsOrTheValues) {
  Table t = synthesize(bind_model(paint, parse_settings(materials[0].settings), 3),
                       {.layout = Layout::random, .noise = 0.05});
  const auto plain = fit(t, {}).document;
  t.weights.assign(t.size(), 1e-20);
  const auto weighted = fit(t, {}).document;
  for (std::size_t p = 0; p < plain.parameters.size(); ++p)
    for (std::size_t c = 0; c < plain.parameters[p].value.size(); ++c) {
      EXPECT_NEAR(weighted.parameters[p].value[c] / plain.parameters[p].value[c], 1, 1e-9);
      EXPECT_NEAR(weighted.parameters[p].std_error[c] / plain.parameters[p].std_error[c], 1, 1e-6);
    }
  // A dim table under the metric that has a unit: kd scales with it.
  Table bright =
      synthesize(bind_model("lambert", {}, 1), {.layout = Layout::random, .noise = 0.05});
  Table dim = bright;
  for (auto& v : dim.values[0]) v *= 1e-6;
  FitOptions o;
  o.model = "lambert";
  o.metric = Metric::l2_cosine;
  EXPECT_NEAR(
      fit(dim, o).document.parameters[0].value[0] / fit(bright, o).document.parameters[0].value[0],
      1e-6, 1e-13);
}

/// Table with each sample as often as its weight says.
Table repeated(Table t) {
  const DirectionList from = *t.list();
  DirectionList to;
  const auto values = t.values;
  for (auto& plane : t.values) plane.clear();
  for (std::size_t i = 0; i < t.weights.size(); ++i)
    for (double k = 0; k < t.weights[i]; ++k) {
      to.theta_i_deg.push_back(from.theta_i_deg[i]);
      to.phi_i_deg.push_back(from.phi_i_deg[i]);
      to.theta_o_deg.push_back(from.theta_o_deg[i]);
      to.phi_o_deg.push_back(from.phi_o_deg[i]);
      for (std::size_t c = 0; c < values.size(); ++c) t.values[c].push_back(values[c][i]);
    }
  t.where = std::move(to);
  t.weights.clear();
  return t;
}

TEST(Fit, OfWholeWeightsIsThatOfATableWithEachSampleAsOften) {
  const BoundModel wrong =
      bind_model("lambert+ggx/smith_ggx.correlated/dielectric",
                 parse_settings(std::vector<std::string>{"alpha=0.6,eta=1.5,kd=0.2,0.1,0.05"}), 3);
  int compared = 0;
  for (const bool right : {true, false})
    for (const bool measured : {true, false})
      for (const Metric metric : {Metric::log, Metric::l2_cosine, Metric::relative}) {
        Table t =
            synthesize(right ? bind_model(paint, parse_settings(materials[0].settings), 3) : wrong,
                       {.layout = Layout::random, .samples = 150, .noise = 0.03});
        if (measured) t.truth.reset();
        for (std::size_t i = 0; i < t.size(); ++i)
          t.weights.push_back(static_cast<double>((7 * i) % 4));
        FitOptions o;
        o.metric = metric;
        const auto a = fit(t, o).document, b = fit(repeated(t), o).document;
        const auto near = [](double x, double y, double part, const std::string& what) {
          EXPECT_EQ(std::isnan(x), std::isnan(y)) << what;
          if (!std::isnan(x)) {
            EXPECT_NEAR(x, y, part * std::abs(y)) << what;
          }
        };
        near(a.cost, b.cost, 1e-9, "cost");
        // Where a misfit is judged the same number twice is one reading that stands there twice.
        const bool are_alike = !a.misfit.told && !b.misfit.told && a.intervals == b.intervals;
        compared += are_alike;
        for (std::size_t p = 0; p < a.parameters.size(); ++p)
          for (std::size_t c = 0; c < a.parameters[p].value.size(); ++c) {
            const auto &x = a.parameters[p], &y = b.parameters[p];
            const std::string what = x.name + " " + std::string(name_of(metric)) +
                                     (measured ? " measured" : "") + (right ? "" : " wrong");
            near(x.value[c], y.value[c], 1e-5, what);
            if (!are_alike) continue;
            EXPECT_EQ(x.status[c], y.status[c]) << what;
            near(x.std_error[c], y.std_error[c], 1e-3, what);
            near(x.ci95_low[c], y.ci95_low[c], 1e-3, what);
            near(x.ci95_high[c], y.ci95_high[c], 1e-3, what);
            near(x.limit[c], y.limit[c], 1e-3, what);
          }
      }
  EXPECT_GE(compared, 3);
}

TEST(Fit, OfTwiceTheWeightKnowsRootTwoMore) {
  Table t = synthesize(bind_model(paint, parse_settings(materials[0].settings), 3),
                       {.layout = Layout::random, .samples = 3000, .noise = 0.03, .seed = 4});
  t.weights.assign(t.size(), 1);
  const auto once = fit(t, {}).document;
  t.weights.assign(t.size(), 2);
  const auto twice = fit(t, {}).document;
  EXPECT_NEAR(twice.cost / once.cost, 2, 1e-6);
  ASSERT_FALSE(once.misfit.told || twice.misfit.told);
  EXPECT_NEAR(parameter(once, "alpha").std_error[0] / parameter(twice, "alpha").std_error[0],
              std::sqrt(2), 0.02);
}

TEST(Fit, OfASpectrumFindsEveryChannelAndItsErrors) {
  constexpr std::size_t channels = 40;  // enough for each to have a block of its own
  Setting kd{"kd", {}}, f0{"f0", {}};
  for (std::size_t c = 0; c < channels; ++c) {
    kd.values.push_back(0.3 + 0.2 * std::sin(static_cast<double>(c) / 5));
    f0.values.push_back(0.06 + 0.03 * std::cos(static_cast<double>(c) / 7));
  }
  const auto truth = bind_model(paint, {{"alpha", {0.2}}, kd, f0}, channels);
  const Table t =
      synthesize(truth, {.layout = Layout::random, .samples = 400, .noise = 0.02, .seed = 5});
  const auto d = fit(t, {}).document;
  EXPECT_EQ(d.solver.termination, "converged");
  ASSERT_EQ(d.correlations.size(), 1 + 2 * channels);
  for (const auto& p : truth.model.parameters)
    for (std::size_t c = 0; c < p.count; ++c) {
      const auto& q = parameter(d, p.name);
      EXPECT_LT(std::abs(q.value[c] - truth.values[p.first + c]), 5 * q.std_error[c])
          << p.name << c;
      EXPECT_LT(q.std_error[c], 0.05 * q.value[c]) << p.name << c;
    }
  // A channel alone, alpha held where all of them put it, has the same values.
  Table one = t;
  one.channels = {t.channels[7]};
  one.values = {t.values[7]};
  FitOptions o;
  o.fixed = {{"alpha", parameter(d, "alpha").value}};
  const auto alone = fit(one, o).document;
  for (const char* name : {"kd", "f0"})
    EXPECT_NEAR(parameter(alone, name).value[0] / parameter(d, name).value[7], 1, 1e-6) << name;
}

TEST(Fit, RefusesMoreFreeParametersThanItCanAccumulate) {
  const std::string lobe = "+gtr/smith_ggx.correlated/conductor";
  const Table t = synthesize(bind_model(paint, {}, 3), {.layout = Layout::random, .samples = 200});
  FitOptions o;
  o.model = "lambert" + lobe + lobe + lobe + lobe + lobe;
  EXPECT_HAS(test::refusal([&] { fit(t, o); }, Exit::usage), "at most 17 can be fitted at once");
  o.model = "lambert" + lobe + lobe + lobe;
  o.fixed = parse_settings(std::vector<std::string>{"eta=1.5,k=3,eta_2=1.5,k_2=3,gamma=2"});
  EXPECT_NO_THROW(fit(t, o));
}

TEST(Fit, RefusesSquaresThatHaveNoFiniteSum) {
  Table t = synthesize(bind_model(paint, {}, 3), {.layout = Layout::random});
  for (auto& v : t.values[0]) v = 1e200;
  FitOptions o;
  o.metric = Metric::l2_cosine;
  EXPECT_THROW(fit(t, o), Error);
}

TEST(Fit, HalfABinChangesAlphaByFourToTwelvePercentAndMoreWhereThePeakIsSharp) {
  GONIO_MANY_FITS();
  const Material sharp{"sharp", paint, {"alpha=0.01", "f0=0.05", "kd=0.2"}};
  const auto change = [](const Material& m, Metric metric) {
    FitOptions o;
    o.metric = metric;
    const auto d = fit_synthetic(m, {}, o).document;
    EXPECT_EQ(d.sensitivity.at(0).other, "edge");
    for (const auto& [name, values] : d.sensitivity.at(0).relative_change)
      if (name == "alpha") return std::abs(values[0]);
    return 0.0;
  };
  for (const Metric m : {Metric::log, Metric::l2_cosine, Metric::relative}) {
    EXPECT_GT(change(materials[0], m), 0.04);
    EXPECT_LT(change(materials[0], m), 0.12);
  }
  EXPECT_GT(change(sharp, Metric::l2_cosine), 0.15);
}

TEST(Fit, OfATableWithoutAUsableValueIsRefused) {
  Table t = synthesize(bind_model(paint, {}, 3), {.layout = Layout::random});
  for (auto& c : t.values)
    for (auto& v : c) v = -1;
  EXPECT_HAS(test::refusal([&] { fit(t, {}); }), fmt::format("{} negative", 3 * t.size()));
}

TEST(Fit, IgnoresMaskedValuesWhateverTheyAre) {
  const BoundModel b = bind_model(paint, parse_settings(std::vector<std::string>{"alpha=0.15"}), 3);
  Table clean = synthesize(b, {.layout = Layout::random}), dirty = clean;
  for (std::size_t i = 0; i < clean.size(); i += 10) {
    clean.values[1][i] = -1;
    dirty.values[1][i] = i % 20 ? std::nan("") : -HUGE_VAL;
  }
  clean.negative_is_noise = dirty.negative_is_noise = false;
  FitOptions o;
  const auto a = fit(clean, o), c = fit(dirty, o);
  EXPECT_EQ(a.model.values, c.model.values);
  EXPECT_EQ(c.document.masked.at("not_finite"), clean.size() / 10);
}

TEST(Fit, SaysWhatAnExpressionLeftOut) {
  const BoundModel b = bind_model(paint, parse_settings(std::vector<std::string>{"alpha=0.3"}), 3);
  const Table whole = synthesize(b, {.layout = Layout::random});
  FitOptions o;
  const auto before = fit(whole, o).document;
  EXPECT_FALSE(before.mask);
  EXPECT_FALSE(before.masked.contains("left_out_by_mask"));
  Table t = whole;
  leave_out(t, "theta_o > 60");
  const auto d = fit(t, o).document;
  EXPECT_EQ(d.mask, "theta_o > 60");
  const auto left_out = d.masked.at("left_out_by_mask");
  EXPECT_GT(left_out, 0U);
  EXPECT_EQ(d.values_used + left_out, before.values_used);
  EXPECT_EQ(d.masked.at("not_finite"), before.masked.at("not_finite"));
  // What the horizon keeps out, too, is not lost from the count.
  Table below = whole;
  auto& list = std::get<DirectionList>(below.where);
  for (std::size_t i = 0; i < 5; ++i) list.theta_o_deg[i] = 90;
  leave_out(below, "theta_o > 60");
  const auto counted = fit(below, o).document;
  EXPECT_EQ(counted.masked.at("below_horizon"), 5U * 3U);
}

TEST(Fit, IsTheSameDocumentForAnyNumberOfThreads) {
  const Layout layout = few(2) > 1 ? Layout::mbsdf : Layout::random;
  const Table t = synthesize(test::paint(), {.layout = layout, .samples = 20'000, .noise = 0.05});
  FitOptions o;
  o.model = to_text(test::paint().model.spec);
  o.robust = true;
  const auto strip = [](FitDocument d) {
    d.solver.phase_ms.clear();
    return to_json(d);
  };
  const auto many = strip(fit(t, o).document);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(strip(fit(t, o).document), many);
}

// ---- Presets
// -------------------------------------------------------------------------------------

Table table_of(const char* model, const std::string& settings, double noise) {
  return synthesize(test::bind(model, settings, 3),
                    {.layout = Layout::random, .samples = 3000, .noise = noise});
}
void expect_near(const FitDocument& d,
                 const std::string& name,
                 const std::vector<double>& truth,
                 double tolerance) {
  const auto& found = parameter(d, name).value;
  ASSERT_EQ(found.size(), truth.size()) << name;
  for (std::size_t c = 0; c < truth.size(); ++c) EXPECT_NEAR(found[c], truth[c], tolerance) << name;
}

TEST(FitOfAPreset, FindsItsOwnParameters) {
  const std::vector<double> colour{0.5, 0.3, 0.1};
  static constexpr std::array metals{0.3, 0.0, 0.9, 1.0};
  for (const double metallic : std::span(metals).first(test::few(metals.size())))
    for (const auto& [model, reflectance] : {std::pair("gltf", 0.0), std::pair("filament", 0.7)}) {
      auto settings = fmt::format("base_color=0.5,0.3,0.1,roughness=0.5,metallic={}", metallic);
      if (reflectance > 0) settings += fmt::format(",reflectance={}", reflectance);
      FitOptions o;
      o.model = model;
      const auto d = fit(table_of(model, settings, 0), o).document;
      SCOPED_TRACE(settings);
      expect_near(d, "base_color", colour, 1e-6);
      expect_near(d, "metallic", {metallic}, 1e-6);
      expect_near(d, "roughness", {0.5}, 1e-6);
      if (reflectance > 0 && metallic < 1) expect_near(d, "reflectance", {reflectance}, 1e-5);
    }
}

TEST(FitOfAPreset, HoldsOnlyWhatItIsAskedTo) {
  FitOptions o;
  o.model = "gltf";
  o.fixed = parse_settings(std::vector<std::string>{"roughness=0.5", "metallic=0"});
  const auto d = fit(table_of("gltf", "base_color=0.5,0.3,0.1,roughness=0.5", 0.01), o).document;
  EXPECT_EQ(parameter(d, "alpha").status.at(0), ParameterStatus::fixed);
  EXPECT_EQ(parameter(d, "metallic").status.at(0), ParameterStatus::fixed);
  EXPECT_EQ(parameter(d, "base_color").status.at(0), ParameterStatus::free);
  expect_near(d, "base_color", {0.5, 0.3, 0.1}, 0.002);
}

class MetricCoverage : public testing::TestWithParam<std::size_t> {};

TEST_P(MetricCoverage, Of95PercentIntervalsLiesBetween90And99Percent) {
  const BoundModel truth =
      bind_model("lambert+ggx/smith_ggx.correlated/schlick",
                 parse_settings(std::vector<std::string>{"alpha=0.15,f0=0.05,kd=0.2,0.1,0.05"}), 3);
  FitOptions o;
  o.metric = static_cast<Metric>(GetParam());
  std::size_t inside = 0, all = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const auto t =
        synthesize(truth, {.layout = Layout::random, .samples = 300, .noise = 0.02, .seed = seed});
    const auto d = fit(t, o).document;
    for (const auto& p : truth.model.parameters)
      for (const auto& q : d.parameters)
        if (q.name == p.name)
          for (std::size_t c = 0; c < p.count; ++c, ++all)
            inside += q.ci95_low[c] <= truth.values[p.first + c] &&
                      truth.values[p.first + c] <= q.ci95_high[c];
  }
  ASSERT_EQ(all, 700U);
  const double coverage = static_cast<double>(inside) / static_cast<double>(all);
  RecordProperty("coverage_percent", static_cast<int>(100 * coverage));
  EXPECT_GE(coverage, 0.90);
  EXPECT_LE(coverage, 0.99);
}

INSTANTIATE_TEST_SUITE_P(Metrics, MetricCoverage, testing::Values(0U, 1U, 2U), [](const auto& i) {
  return std::string(names_of<Metric>[i.param]);
});

/// A goniometer whose gain drifts by 2 % from one incident angle to the next: the values
/// of each share its error.
Table drifting(const BoundModel& truth, unsigned seed) {
  Table t;
  t.format = "csv";
  t.channels = {"r", "g", "b"};
  test::put_on_goniometer(t, truth);
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  std::map<double, double> gain;  // by incident angle
  for (const double in : t.list()->theta_i_deg)
    if (!gain.contains(in)) gain[in] = std::exp(0.02 * normal(engine));
  for (auto& channel : t.values)
    for (std::size_t i = 0; i < channel.size(); ++i)
      channel[i] *= gain[t.list()->theta_i_deg[i]] * std::exp(0.005 * normal(engine));
  return t;
}

TEST(Coverage, HoldsForAHandfulOfValues) {
  const BoundModel truth =
      bind_model("lambert", parse_settings(std::vector<std::string>{"kd=0.3"}), 1);
  FitOptions o;
  o.model = "lambert";
  std::size_t inside = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    const auto t =
        synthesize(truth, {.layout = Layout::random, .samples = 6, .noise = 0.02, .seed = seed});
    const auto kd = fit(t, o).document.parameters[0];
    inside += kd.ci95_low[0] <= 0.3 && 0.3 <= kd.ci95_high[0];
  }
  // A binomial of 400 at 95 % lies in [366, 394] with 99.9 % probability; 1.96 would give about
  // 352.
  EXPECT_GE(inside, 366U);
  EXPECT_LE(inside, 394U);
}

TEST(Coverage, CountsOnlyIncidentAnglesThatHaveAValue) {
  const BoundModel truth =
      bind_model("lambert", parse_settings(std::vector<std::string>{"kd=0.2"}), 1);
  Table t;
  t.format = "csv";
  t.channels = {"f"};
  DirectionList l;
  t.values.resize(1);
  for (int in = 0; in < 41; ++in)
    for (int out = 0; out < 60; out += 2) {
      l.theta_i_deg.push_back(in);
      l.phi_i_deg.push_back(0);
      l.theta_o_deg.push_back(out);
      l.phi_o_deg.push_back(180);
      const double ripple = 1 + 0.02 * (out % 4 == 0 ? 1 : -1);
      t.values[0].push_back(in == 20 ? 0.2 / M_PI * ripple : std::nan(""));
    }
  t.where = std::move(l);
  FitOptions o;
  o.model = "lambert";
  const auto d = fit(t, o).document;
  EXPECT_EQ(d.clusters, 0U);
  EXPECT_NEAR(d.parameters[0].std_error[0], 0.2 * 0.02 / std::sqrt(30), 2e-4);
  EXPECT_EQ(d.warnings.size(), 1U);
}

TEST(Coverage, TakesTheWiderBelowEightIncidentAngles) {
  const BoundModel truth = bind_model("lambert", {}, 1);
  Table t = synthesize(truth, {.layout = Layout::hemisphere, .noise = 0.02});
  t.truth.reset();  // as if measured
  FitOptions o;
  o.model = "lambert";
  const auto error = [&](Intervals intervals) {
    o.intervals = intervals;
    return fit(t, o).document.parameters[0].std_error[0];
  };
  EXPECT_NEAR(error(Intervals::automatic),
              std::max(error(Intervals::independent), error(Intervals::by_angle)), 1e-15);
  o.intervals = Intervals::automatic;
  EXPECT_EQ(fit(t, o).document.clusters, 6U);
  EXPECT_EQ(fit(t, o).document.warnings.size(), 1U);
  for (std::size_t i = 0; i < t.size(); ++i)  // a gain of each angle: it is by angle that is wider
    t.values[0][i] *= 1 + 0.05 * std::sin(20 * t.list()->theta_i_deg[i]);
  EXPECT_EQ(error(Intervals::automatic), error(Intervals::by_angle));
  EXPECT_FALSE(fit(t, o).document.misfit.told);
  o.intervals = Intervals::independent;  // whose errors cannot explain the gains
  EXPECT_TRUE(fit(t, o).document.misfit.told);
}

TEST(Coverage, HoldsForErrorsSharedByAnIncidentAngleOnlyWhenTheyAreClustered) {
  const BoundModel truth =
      bind_model("lambert+ggx/smith_ggx.correlated/schlick",
                 parse_settings(std::vector<std::string>{"alpha=0.3,f0=0.05,kd=0.2,0.1,0.05"}), 3);
  const auto coverage_of_kd = [&](Intervals intervals, unsigned seeds) {
    FitOptions o;
    o.intervals = intervals;
    std::size_t inside = 0;
    for (unsigned seed = 1; seed <= seeds; ++seed) {
      const auto d = fit(drifting(truth, seed), o).document;
      EXPECT_EQ(d.clusters, intervals == Intervals::independent ? 0U : 24U);
      // The drift may be told as a misfit, for which intervals allow.
      if (intervals == Intervals::independent && d.misfit.told) continue;
      const auto& kd = d.parameters[0];
      inside += kd.ci95_low[0] <= 0.2 && 0.2 <= kd.ci95_high[0];
    }
    return inside;
  };
  // A binomial of 100 at 95 % lies in [88, 100] with 99.8 % probability.
  const unsigned most = few(100, 5), least = few(88, 4);
  EXPECT_GE(coverage_of_kd(Intervals::automatic, most), least);  // the table is taken as measured
  EXPECT_LE(coverage_of_kd(Intervals::independent, few(40, 4)), few(24, 4));
}

TEST(Robust, FitsTheBulkWhateverTheMetric) {
  for (const Layout layout : {Layout::in_plane, Layout::hemisphere, Layout::random})
    for (const Metric metric : {Metric::log, Metric::relative, Metric::l2_cosine})
      for (const std::uint64_t seed : {1, 2}) {
        FitOptions o;
        o.metric = metric;
        o.robust = true;
        const auto r = fit_synthetic(
            materials[0], {.layout = layout, .noise = 0.02, .outliers = 0.2, .seed = seed}, o);
        each_value(materials[0], r.document,
                   [&](const auto& name, double truth, double fitted, double) {
                     EXPECT_NEAR(fitted / truth, 1, metric == Metric::log ? 0.02 : 0.3)
                         << name << " " << name_of(layout) << " " << name_of(metric);
                   });
      }
}

TEST(Copies, AreNoMeasurements) {
  const BoundModel truth = bind_model(paint, parse_settings(materials[0].settings), 3);
  Table t = synthesize(truth, {.layout = Layout::mbsdf});
  const std::size_t row = t.grid()->axes[1].size * t.grid()->axes[2].size;
  for (auto& plane : t.values)  // the highlight stays where it was while the light goes on
    for (std::size_t copy = 20; copy < 30; ++copy)
      std::copy_n(&plane[19 * row], row, &plane[copy * row]);
  FitOptions o;
  o.bin_sensitivity = false;
  const auto d = fit(t, o).document;
  EXPECT_NEAR(parameter(d, "alpha").value[0], 0.15, 1e-7);
  EXPECT_GT(d.masked.at("copied"), 0U);
  EXPECT_EQ(d.warnings.size(), 1U);
  o.copies = true;
  const auto kept = fit(t, o).document;
  EXPECT_GT(std::abs(parameter(kept, "alpha").value[0] - 0.15), 0.001);
  EXPECT_EQ(kept.masked.contains("copied"), false);
  EXPECT_NE(kept.warnings, d.warnings);
}

TEST(Copies, OfAMeasuredPaintMadeItPink) {
  GONIO_NEEDS_SHARED(path, "data/mbsdf/carpaint_blue.mbsdf");
  FitOptions o;
  o.metric = Metric::l2_cosine;
  o.bin_sensitivity = false;
  const auto d = fit(read_table(path), o).document;
  EXPECT_NEAR(parameter(d, "alpha").value[0], 0.064, 0.002);
  const auto &f0 = parameter(d, "f0").value, &kd = parameter(d, "kd").value;
  for (const double f : f0) EXPECT_NEAR(f, 0.05, 0.01);  // a clear coat
  EXPECT_GT(kd[2], 0.05);                                // over blue
  EXPECT_LT(kd[1], 0.02);
}

TEST(Fit, OfOneValueKnowsNoError) {
  for (const char* model : {paint, gtr, "ggx/smith_ggx.correlated/conductor"})
    for (const Metric metric : {Metric::log, Metric::l2_cosine, Metric::relative})
      for (const bool robust : {false, true}) {
        FitOptions o;
        o.model = model;
        o.metric = metric;
        o.robust = robust;
        o.certificate = Certify::automatic;
        const auto d = fit(test::list_of({0.3}), o).document;
        EXPECT_EQ(d.solver.termination, "converged");
        for (const auto& p : d.parameters)
          EXPECT_TRUE(std::isnan(p.std_error[0])) << model << " " << p.name;
        EXPECT_FALSE(d.warnings.empty());
      }
}

}  // namespace
}  // namespace gonio
