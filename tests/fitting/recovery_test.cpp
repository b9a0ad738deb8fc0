// What was put in comes out: parameters recovered from synthesized tables.
#include <cmath>

#include "base/error.h"
#include "data_synth/synth.h"
#include "fitting/fit.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

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

const FittedParameter& parameter(const FitDocument& d, const std::string& name) {
  for (const auto& p : d.parameters)
    if (p.name == name) return p;
  throw std::out_of_range(name);
}

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
  return fit(synthesize(bind_model(m.model, parse_settings(m.settings), 3), s), o);
}

class Recovery : public testing::TestWithParam<Material> {};

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
  for (std::size_t l = 0; l < layout_names.size(); ++l)
    for (std::size_t k = 0; k < metric_names.size(); ++k) {
      SynthOptions s;
      s.layout = static_cast<Layout>(l);
      if (s.layout == Layout::merl) continue;  // above
      FitOptions o;
      o.metric = static_cast<Metric>(k);
      o.bin_sensitivity = false;
      const auto r = fit_synthetic(GetParam(), s, o);
      each_value(GetParam(), r.document,
                 [&](const auto& name, double truth, double fitted, double) {
                   EXPECT_NEAR(fitted / truth, 1, 1e-5)
                       << name << " " << layout_names[l] << " " << metric_names[k];
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

TEST(Fit, WithHuberSurvivesOutliersThatBendThePlainFit) {
  SynthOptions s;
  s.layout = Layout::random;
  s.noise = 0.02;
  s.outliers = 0.05;
  FitOptions plain, robust;
  robust.robust = true;
  const double truth = 0.15;
  const FitDocument a = fit_synthetic(materials[0], s, plain).document;
  const FitDocument b = fit_synthetic(materials[0], s, robust).document;
  const double bent = parameter(a, "alpha").value[0];
  const auto& p = parameter(b, "alpha");
  EXPECT_LT(std::abs(p.value[0] - truth), 4 * p.std_error[0]);
  EXPECT_LT(std::abs(p.value[0] - truth), std::abs(bent - truth));
}

TEST(Fit, SaysThatAWidthWithoutALobeIsNotIdentifiable) {
  // η = 1 reflects nothing: the table is Lambertian and says nothing of alpha.
  const Material m{"lambert",
                   "lambert+ggx/smith_ggx.correlated/dielectric",
                   {"alpha=0.2", "eta=1", "kd=0.5,0.3,0.1"}};
  SynthOptions s;
  s.layout = Layout::random;
  for (const double noise : {0.0, 0.02}) {
    s.noise = noise;
    const auto d = fit_synthetic(m, s).document;
    EXPECT_EQ(parameter(d, "alpha").status[0], ParameterStatus::not_identifiable) << noise;
    EXPECT_TRUE(std::isnan(parameter(d, "alpha").value[0]));
    EXPECT_NEAR(parameter(d, "kd").value[0], 0.5, noise > 0 ? 0.01 : 1e-6);
  }
}

TEST(Fit, SaysThatALobeIsNotIdentifiableWhereDiffuseAloneDoesAsWell) {
  // Schlick's F is 1 at 90° whatever f0 is: this lobe cannot vanish from a Lambertian table.
  for (const Layout layout : {Layout::hemisphere, Layout::in_plane})
    for (const char* diffuse : {"lambert", "lambert.coupled"})
      for (const double noise : {0.0, 0.02}) {
        const auto table = synthesize(
            bind_model("lambert", parse_settings(std::vector<std::string>{"kd=0.6,0.5,0.4"}), 3),
            {.layout = layout, .noise = noise});
        FitOptions o;
        o.model = std::string(diffuse) + "+ggx/smith_ggx.correlated/schlick";
        const auto d = fit(table, o).document;
        for (const char* name : {"alpha", "roughness", "f0"}) {
          EXPECT_EQ(parameter(d, name).status[0], ParameterStatus::not_identifiable)
              << diffuse << " " << noise << " " << name;
          EXPECT_TRUE(std::isnan(parameter(d, name).value[0]));
        }
        EXPECT_NEAR(parameter(d, "kd").value[0], 0.6, 0.01) << diffuse << " " << noise;
        ASSERT_FALSE(d.warnings.empty());
        EXPECT_TRUE(d.warnings.back().starts_with("without its lobe")) << d.warnings.back();
      }
}

TEST(Fit, SaysThatThePeakIsNotResolved) {
  const auto warned = [](const char* alpha) {
    const Material m{"mirror", "lambert+ggx/smith_ggx.correlated/schlick", {alpha, "kd=0.1"}};
    const auto d = fit_synthetic(m, {.layout = Layout::mbsdf, .noise = 0.02}).document;
    return std::ranges::any_of(d.warnings, [](const std::string& w) {
      return w.starts_with("the table does not resolve its highlight");
    });
  };
  EXPECT_TRUE(warned("alpha=0.01"));
  EXPECT_FALSE(warned("alpha=0.3"));
}

TEST(Fit, SaysThatWhatIsLeftIsMoreThanNoise) {
  const auto warned = [](const char* model) {
    const auto table = synthesize(
        bind_model("lambert+gtr/smith_ggx.correlated/schlick",
                   parse_settings(std::vector<std::string>{"alpha=0.3,gamma=1.3,f0=0.05,kd=0.2"}),
                   1),
        {.layout = Layout::in_plane, .noise = 0.005});
    FitOptions o;
    o.model = model;
    const auto d = fit(table, o).document;
    return std::ranges::any_of(d.warnings, [](const std::string& w) {
      return w.find("most of it is the model's error") != std::string::npos;
    });
  };
  EXPECT_TRUE(warned("lambert+ggx/smith_ggx.correlated/schlick"));
  EXPECT_FALSE(warned("lambert+gtr/smith_ggx.correlated/schlick"));
}

TEST(Fit, KeepsALobeThatTheTableNeeds) {
  for (const double f0 : {0.02, 0.04}) {
    const Material faint{"faint",
                         "lambert+ggx/smith_ggx.correlated/schlick",
                         {"alpha=0.5", "kd=0.8", "f0=" + std::to_string(f0)}};
    const auto d = fit_synthetic(faint, {.layout = Layout::mbsdf, .noise = 0.02}).document;
    EXPECT_EQ(parameter(d, "alpha").status[0], ParameterStatus::free) << f0;
  }
}

TEST(Fit, FindsAPeakMuchNarrowerThanTheFirstGuess) {
  const Material needle{"needle", metal, {"alpha=0.0005", "f0=0.5"}};
  FitOptions o;
  o.bin_sensitivity = false;
  const auto r = fit_synthetic(needle, {.layout = Layout::image_slice, .noise = 0.02}, o);
  EXPECT_NEAR(parameter(r.document, "alpha").value[0], 0.0005, 1e-6);
  EXPECT_NEAR(parameter(r.document, "f0").value[0], 0.5, 1e-3);
}

TEST(Fit, AtTheEndOfItsRangeIsAtABoundAndNotUnidentifiable) {
  Table t = synthesize(bind_model("lambert", {}, 1), {.layout = Layout::random, .samples = 5});
  t.values[0] = {0.3, 0.5, 0.9, 1.4, 1.9};  // kd = 1 gives 0.318
  FitOptions o;
  o.model = "lambert";
  const auto d = fit(t, o).document;
  EXPECT_EQ(d.parameters[0].status[0], ParameterStatus::at_bound);
  EXPECT_EQ(d.parameters[0].value[0], 1);
}

TEST(Fit, KnowsNoErrorsWithoutADegreeOfFreedomAndSaysSo) {
  Table t = synthesize(bind_model("lambert", {}, 1), {.layout = Layout::random, .samples = 1});
  FitOptions o;
  o.model = "lambert";
  const auto d = fit(t, o).document;
  EXPECT_NEAR(d.parameters[0].value[0], 0.2, 1e-6);
  EXPECT_TRUE(std::isnan(d.parameters[0].std_error[0]));
  ASSERT_FALSE(d.warnings.empty());
  EXPECT_NE(d.warnings[0].find("1 values cannot tell"), std::string::npos) << d.warnings[0];
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

TEST(Fit, RefusesMoreFreeParametersThanItCanAccumulate) {
  const std::string lobe = "+gtr/smith_ggx.correlated/conductor";
  const Table t = synthesize(bind_model(paint, {}, 3), {.layout = Layout::random, .samples = 200});
  FitOptions o;
  o.model = "lambert" + lobe + lobe + lobe;
  EXPECT_THROW(fit(t, o), Error);
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

TEST(Fit, SaysWhenTheModelDoesNotDescribeTheTable) {
  const Table t = synthesize(bind_model(metal, parse_settings(materials[1].settings), 3),
                             {.layout = Layout::random});
  FitOptions o;
  o.model = "lambert";
  const auto d = fit(t, o).document;
  ASSERT_FALSE(d.warnings.empty());
  EXPECT_NE(d.warnings[0].find("does not describe"), std::string::npos);
  EXPECT_TRUE(fit_synthetic(materials[1], {.layout = Layout::random}).document.warnings.empty());
}

TEST(Fit, HalfABinChangesAlphaByFourToTwelvePercentAndMoreWhereThePeakIsSharp) {
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
  try {
    fit(t, {});
    FAIL();
  } catch (const std::exception& e) {
    EXPECT_NE(std::string(e.what()).find("negative"), std::string::npos) << e.what();
  }
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

}  // namespace
}  // namespace gonio
