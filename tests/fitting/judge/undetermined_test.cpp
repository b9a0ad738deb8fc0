// What the data say nothing of is not told as a number.
#include "fitting/judge/undetermined.h"

#include <cmath>
#include <numbers>
#include <random>
#include <span>

#include "base/quantile.h"
#include "fitting/fit.h"
#include "fitting/judge/warnings.h"
#include "fitting/support.h"
#include "many_fits.h"
#include "table/sample_mask.h"
#include "tables.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace gonio {
namespace {

using test::parameter;

const SampleCounts counted{.used = 200, .samples = 200};

FitResult fit_synthetic(const char* model, const std::string& settings, const SynthOptions& s) {
  FitOptions o;
  o.model = model;
  return fit(synthesize(test::bind(model, settings, 3), s), o);
}

TEST(Undetermined, SaysThatAWidthWithoutALobeIsNotIdentifiable) {
  // η = 1 reflects nothing: the table is Lambertian and says nothing of alpha.
  SynthOptions s;
  s.layout = Layout::random;
  for (const double noise : {0.0, 0.02}) {
    s.noise = noise;
    const auto d = fit_synthetic("lambert+ggx/smith_ggx.correlated/dielectric",
                                 "alpha=0.2,eta=1,kd=0.5,0.3,0.1", s)
                       .document;
    EXPECT_EQ(parameter(d, "alpha").status[0], ParameterStatus::not_identifiable) << noise;
    EXPECT_TRUE(std::isnan(parameter(d, "alpha").value[0]));
    EXPECT_NEAR(parameter(d, "kd").value[0], 0.5, noise > 0 ? 0.01 : 1e-6);
  }
}

TEST(Undetermined, SaysThatALobeIsNotIdentifiableWhereDiffuseAloneDoesAsWell) {
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
        FitFacts facts;
        facts.needless = true;
        ASSERT_FALSE(d.warnings.empty());
        EXPECT_EQ(d.warnings.back(), warnings(o, table, d, facts).back());
      }
}

TEST(Undetermined, KeepsALobeThatTheTableNeeds) {
  for (const double f0 : {0.02, 0.04}) {
    const auto d = fit_synthetic("lambert+ggx/smith_ggx.correlated/schlick",
                                 "alpha=0.5,kd=0.8,f0=" + std::to_string(f0),
                                 {.layout = Layout::mbsdf, .noise = 0.02})
                       .document;
    EXPECT_EQ(parameter(d, "alpha").status[0], ParameterStatus::free) << f0;
  }
}

TEST(Undetermined, AsksForMoreThanTheLargestOfNNormalDeviatesMayGive) {
  // Values a factor e^±spread off: the more they scatter, the less it means what alpha does to the
  // fit.
  const auto truth = test::bind("ggx/smith_ggx.correlated/schlick", "alpha=0.3,f0=0.5", 1);
  const Table exact = synthesize(truth, {.layout = Layout::random, .samples = 200});
  const double count = 200;
  struct Looked {
    double deviates;  ///< how many χ² alpha is worth
    ParameterStatus status;
  };
  const auto look = [&](double spread) {
    Table t = exact;
    for (std::size_t i = 0; i < t.size(); ++i) t.values[0][i] *= std::exp(i % 2 ? spread : -spread);
    FitOptions o;
    o.model = to_text(truth.model.spec);
    o.fixed = parse_settings(std::vector<std::string>{"f0=0.5"});
    const Problem p = pose(t, o);
    const Sampling s(t, Bins::centre, Metric::log, 0, false);
    const auto data = fit_data<double>(s);
    const Accumulator<double> accumulate(p.start.model, data, p.free);
    Fitted f{truth, no_huber, {}, false, data.groups};
    const auto cost_at = [&](double alpha) {
      auto v = truth.values;
      v[truth.model.find("alpha")->first] = alpha;
      return accumulate.normal_equations(v).cost;
    };
    double most = 0;
    const double low = p.bounds.low[0], high = p.bounds.high[0];
    for (const double part : {0.0, 0.03, 0.1, 0.3, 0.6, 1.0})
      most = std::max(most, std::abs(cost_at(low + part * (high - low)) - cost_at(0.3)));
    Uncertainty u(1);
    u[0].std_error = 0.1;
    find_undetermined(p, data, f, counted, false, u);
    return Looked{2 * most / (2 * cost_at(0.3) / count), u[0].status};
  };
  const auto with = [&](double deviates) {
    double low = 1e-3, high = 300;  // of the spread
    for (int i = 0; i < 60; ++i) {
      const double middle = std::sqrt(low * high);
      (look(middle).deviates > deviates ? low : high) = middle;
    }
    EXPECT_NEAR(look(low).deviates, deviates, 0.01 * deviates);
    return look(low).status;
  };
  const double luck = 3.84 + 2 * std::log(count);  // 14.4
  EXPECT_EQ(with(0.9 * luck), ParameterStatus::not_identifiable);
  EXPECT_EQ(with(1.1 * luck), ParameterStatus::free);
}

TEST(Undetermined, KnowsALobeWhoseValuesReachDownToNothing) {
  // Logarithms of values below 1e-50 follow kd without bound: that says nothing of other
  // parameters.
  struct Lobe {
    const char *ndf, *settings;
  };
  const Lobe lobes[] = {{"beckmann/smith_beckmann.correlated/schlick", "alpha=0.5,f0=0.5"},
                        {"beckmann/smith_beckmann.correlated/schlick", "alpha=0.3,f0=0.9"},
                        {"gtr/smith_ggx.correlated/schlick", "alpha=0.005,gamma=4,f0=0.5"}};
  for (const auto& [ndf, settings] : std::span(lobes).first(test::few(std::size(lobes))))
    for (const Layout layout : {Layout::in_plane, Layout::hemisphere}) {
      const auto truth = test::bind(ndf, settings, 3);
      FitOptions o;
      o.model = "lambert+" + to_text(truth.model.spec);
      const auto d = fit(synthesize(truth, {.layout = layout, .noise = 0.02}), o).document;
      EXPECT_NEAR(d.residuals.log_rms, 0.02, 0.003) << settings;
      for (const auto& p : truth.model.parameters) {
        const auto& q = parameter(d, p.name);
        EXPECT_EQ(q.status[0], ParameterStatus::free) << settings << " " << p.name;
        EXPECT_NEAR(q.value[0], truth.values[p.first], 5 * q.std_error[0])
            << settings << " " << p.name;
      }
      const auto& kd = parameter(d, "kd");
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_EQ(kd.status[c], ParameterStatus::upper_limit) << settings;
        EXPECT_LT(kd.limit[c], 1e-4) << settings;
        EXPECT_GT(kd.limit[c], kd.value[c]) << settings;
      }
    }
}

TEST(Undetermined, LimitsHoldAsOftenAsTheySay) {
  // kd at the edge of what the noise hides.
  const double kd = 0.0015;
  const auto truth = test::bind("lambert+ggx/smith_ggx.correlated/schlick",
                                fmt::format("alpha=0.4,f0=0.3,kd={}", kd), 1);
  FitOptions o;
  o.model = to_text(truth.model.spec);
  std::size_t limits = 0, holds = 0, all = 0;
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    const auto d =
        fit(synthesize(truth,
                       {.layout = Layout::random, .samples = 80, .noise = 0.1, .seed = seed}),
            o)
            .document;
    const auto& q = parameter(d, "kd");
    ++all;
    if (q.status[0] == ParameterStatus::upper_limit) {
      ++limits;
      EXPECT_TRUE(std::isnan(q.std_error[0]));
      holds += kd <= q.limit[0];
    } else {
      holds += q.ci95_low[0] <= kd && kd <= q.ci95_high[0];
    }
  }
  EXPECT_GE(limits, 15U);
  EXPECT_LE(limits, 135U);
  // A binomial of 150 at 95 % lies in [133, 149] with 99.8 % probability.
  EXPECT_GE(holds, 133U);
}

TEST(Undetermined, TakesTheCostsOwnIntervalWhereItIsNoParabola) {
  // A tail's exponent: the larger, the less of it is left to see.
  const auto truth =
      test::bind("lambert+gtr/smith_ggx.correlated/schlick", "alpha=0.2,gamma=2,f0=0.1,kd=0.1", 1);
  FitOptions o;
  o.model = to_text(truth.model.spec);
  std::vector<double> longer;
  for (std::uint64_t seed = 1; seed <= 9; ++seed) {
    const auto d =
        fit(synthesize(truth,
                       {.layout = Layout::random, .samples = 60, .noise = 0.15, .seed = seed}),
            o)
            .document;
    const auto& gamma = parameter(d, "gamma");
    if (gamma.status[0] != ParameterStatus::free) continue;
    longer.push_back((gamma.ci95_high[0] - gamma.value[0]) / (gamma.value[0] - gamma.ci95_low[0]));
  }
  ASSERT_GE(longer.size(), 5U);
  EXPECT_GT(median(longer), 1.1);
}

/// Seeds of so many whose intervals of a parameter hold the truth, of those that state one.
struct Held {
  unsigned stated = 0, inside = 0;
};
Held held(const char* model,
          const std::string& settings,
          const char* name,
          SynthOptions synth,
          unsigned seeds) {
  const auto truth = test::bind(model, settings, 1);
  Held h;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    synth.seed = seed;
    FitOptions o;
    o.model = model;
    const auto d = fit(synthesize(truth, synth), o).document;
    const auto& q = parameter(d, name);
    if (std::isnan(q.ci95_low[0])) continue;
    ++h.stated;
    const double x = truth.values[truth.model.find(name)->first];
    h.inside += q.ci95_low[0] <= x && x <= q.ci95_high[0];
  }
  return h;
}

TEST(Undetermined, WhatHasALimitMovesTheOthersToo) {
  GONIO_MANY_FITS();
  // k = 0 has no slope: held there, it would hold eta, too.
  const SynthOptions in_plane{.layout = Layout::in_plane, .noise = 0.02};
  const auto metal = held("ggx/smith_ggx.correlated/conductor", "alpha=0.3,eta=9,k=1", "eta",
                          {.layout = Layout::random, .samples = 200, .noise = 0.02}, 16);
  EXPECT_GE(metal.inside + 2, metal.stated);
  const auto clear =
      held("ggx/smith_ggx.correlated/conductor", "alpha=0.3,eta=1.5,k=0.05", "eta", in_plane, 16);
  EXPECT_GE(clear.inside + 2, clear.stated);
  const auto dark = held("lambert+ggx/smith_ggx.correlated/schlick", "alpha=0.6,f0=0.001,kd=0.5",
                         "kd", in_plane, 16);
  EXPECT_GE(dark.inside + 2, dark.stated);
}

TEST(Undetermined, WhatALobeThatIsNotKnownMayTakeIsInTheDiffusesInterval) {
  // Viewed near the normal a wide highlight is as flat as the diffuse term.
  constexpr const char* paint = "lambert+ggx/smith_ggx.correlated/schlick";
  unsigned not_known = 0, inside = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Table t = synthesize(test::bind(paint, "alpha=0.7,f0=0.04,kd=0.5", 1),
                         {.layout = Layout::hemisphere, .noise = 0.02, .seed = seed});
    leave_out(t, "theta_i > 20 or theta_o > 40");
    FitOptions o;
    o.model = paint;
    o.intervals = Intervals::independent;
    const auto d = fit(t, o).document;
    if (parameter(d, "alpha").status[0] != ParameterStatus::not_identifiable) continue;
    const auto& kd = parameter(d, "kd");
    ++not_known;
    inside += kd.ci95_low[0] <= 0.5 && 0.5 <= kd.ci95_high[0];
  }
  EXPECT_GE(not_known, 5u);
  EXPECT_GE(inside, not_known - 1);
}

/// f = 0.02 with 10 % noise, lit and seen within 10° of the normal: no diffuse term differs there from another.
Table matte_near_the_normal(std::uint64_t seed) {
  DirectionList l;
  for (double out = 0; out < 11; out += 2)
    for (double phi = 0; phi < 360; phi += 20) {
      l.theta_i_deg.push_back(10);
      l.phi_i_deg.push_back(0);
      l.theta_o_deg.push_back(out);
      l.phi_o_deg.push_back(phi);
    }
  Table t;
  t.format = "csv";
  t.channels = {"f"};
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  auto& f = t.values.emplace_back();
  for (std::size_t i = 0; i < l.theta_i_deg.size(); ++i)
    f.push_back(0.02 * std::exp(0.1 * normal(random)));
  t.where = std::move(l);
  return t;
}

FittedParameter kd_near_the_normal(const char* model, std::uint64_t seed) {
  FitOptions o;
  o.model = model;
  o.intervals = Intervals::independent;
  return parameter(fit(matte_near_the_normal(seed), o).document, "kd");
}

TEST(Undetermined, DiffuseHoldsWhateverAnUnknownWidthOfItsOwnIs) {
  for (const char* model : {"oren_nayar", "eon"}) {
    unsigned inside = 0;
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      const auto kd = kd_near_the_normal(model, seed);
      inside += kd.status[0] != ParameterStatus::free ||
                (kd.ci95_low[0] <= 0.0628 && 0.0629 <= kd.ci95_high[0]);
    }
    EXPECT_GE(inside, 8u) << model;
  }
}

TEST(Undetermined, ALobeIsNeedlessThoughItTookTheDiffuseTermsLight) {
  // Its kd of 0 is no place to begin the fit without the lobe from.
  constexpr const char* model = "lambert+beckmann/smith_beckmann.correlated/schlick";
  unsigned at_odds = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const auto kd = kd_near_the_normal(model, seed);
    at_odds += kd.status[0] == ParameterStatus::upper_limit && kd.limit[0] < 0.0628;
  }
  EXPECT_EQ(at_odds, 0u);
}

TEST(Undetermined, DiffuseThatIsNotThereLeavesTheLobesIntervalsWhole) {
  GONIO_MANY_FITS();
  const SynthOptions in_plane{.layout = Layout::in_plane, .noise = 0.02};
  for (const char* name : {"eta", "k"}) {
    const auto h = held("lambert+gtr/cook_torrance/conductor",
                        "alpha=0.07,gamma=6.4,eta=2,k=5.7,kd=0", name, in_plane, 12);
    EXPECT_GE(h.inside + 2, h.stated) << name;
  }
}

TEST(Undetermined, AnIntervalReachesTheEndThatIsNextToIt) {
  const auto h = held("lambert+ggx/smith_ggx.correlated/dielectric", "alpha=0.1,eta=1.5,kd=0", "kd",
                      {.layout = Layout::in_plane, .noise = 0.05}, 20);
  EXPECT_GE(h.inside + 2, h.stated);
}

TEST(Undetermined, TwoSamplesTellNoInterval) {
  Table t = synthesize(
      test::bind("lambert+ggx/smith_ggx.correlated/schlick", "alpha=0.3,f0=0.05,kd=0.3", 3),
      {.layout = Layout::random, .samples = 2, .noise = 0.02});
  FitOptions o;
  const auto d = fit(t, o).document;
  for (const auto& q : d.parameters)
    for (std::size_t c = 0; c < q.value.size(); ++c)
      EXPECT_TRUE(std::isnan(q.ci95_low[c])) << q.name;
}

/// Fit of a model to 200 samples of its own.
struct OwnFit {
  OwnFit(const BoundModel& truth, double noise)
      : table(synthesize(truth, {.layout = Layout::random, .samples = 200, .noise = noise})),
        options{.model = to_text(truth.model.spec)},
        p(pose(table, options)),
        data(fit_data<double>(Sampling(table, Bins::centre, Metric::log, 0, false))),
        f(minimise(p, data, truth, no_huber)) {
    f.groups = data.groups;
  }
  OwnFit(const OwnFit&) = delete;
  OwnFit& operator=(const OwnFit&) = delete;

  const Table table;
  const FitOptions options;
  const Problem p;
  const FitData<double> data;
  Fitted f;
};

TEST(Undetermined, AnIntervalAsWideAsTheRangeIsNoValueUnlessItIsTheMisfits) {
  const OwnFit own(test::bind("ggx/smith_ggx.correlated/schlick", "alpha=0.3,f0=0.5", 1), 0.02);
  for (const bool widened : {false, true}) {
    Uncertainty u(2);
    for (auto& v : u.verdicts) v.std_error = 10, v.t = 2, v.freedom = 100, v.variance = 1e9;
    find_undetermined(own.p, own.data, own.f, counted, widened, u);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(u[i].status,
                widened ? ParameterStatus::unbounded : ParameterStatus::not_identifiable);
      EXPECT_EQ(u[i].reason.find("at the end of its range"), std::string::npos) << u[i].reason;
      EXPECT_FALSE(u[i].reason.empty());
    }
  }
}

TEST(Undetermined, WhatStandsAtABoundIsUnboundedWhereOnlyAMisfitLeavesItOpen) {
  const OwnFit own(
      test::bind("lambert+ggx/smith_ggx.correlated/schlick", "alpha=0.3,f0=0.5,kd=0", 1), 0);
  for (const bool widened : {false, true}) {
    Uncertainty u(3);
    for (auto& v : u.verdicts) v.std_error = 1e-6, v.t = 2, v.freedom = 100, v.variance = 1e-12;
    u[0].status = ParameterStatus::at_bound, u[0].variance = 1e9;
    find_undetermined(own.p, own.data, own.f, counted, widened, u);
    EXPECT_EQ(u[0].status, widened ? ParameterStatus::unbounded : ParameterStatus::not_identifiable)
        << u[0].reason;
    if (widened) {
      EXPECT_EQ(u[0].reason,
                "best value for this model, at the end of its range; the model is too wrong to "
                "bound it");
    }
  }
}

TEST(Undetermined, AMisfitThatLeavesOneValueOfALobeOpenBoundsNoneOfThem) {
  const auto truth = test::bind("lambert+beckmann/smith_beckmann.correlated/schlick",
                                "alpha=0.2,f0=0.05,kd=0.3", 1);
  Table t;
  t.format = "csv";
  t.channels = {"f"};
  DirectionList l;
  for (double in = 5; in < 80; in += 8)
    for (double out = 0; out < 80; out += 8)
      for (double phi = 0; phi <= (out > 0 ? 180 : 0); phi += 15) {
        l.theta_i_deg.push_back(in);
        l.phi_i_deg.push_back(0);
        l.theta_o_deg.push_back(out);
        l.phi_o_deg.push_back(phi);
      }
  t.where = std::move(l);
  test::put_values(t, truth);
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (double& f : t.values[0])  // a scale that no F of 1 at 90° allows
    f *= 0.001 * std::exp(0.02 * normal(random));
  FitOptions o;
  o.model = to_text(truth.model.spec);
  const auto d = fit(t, o).document;
  ASSERT_TRUE(d.misfit.told);
  ASSERT_EQ(parameter(d, "f0").status[0], ParameterStatus::unbounded);
  EXPECT_EQ(parameter(d, "alpha").status[0], ParameterStatus::unbounded)
      << parameter(d, "alpha").value[0];
}

TEST(Undetermined, WhatIsPushedAgainstItsBoundByMoreThanNoiseHasNoLimit) {
  constexpr double n = 200;
  const Table noisy = synthesize(test::bind("lambert", "kd=1", 1),
                                 {.layout = Layout::random, .samples = 200, .noise = 0.05});
  double mean = 0, squares = 0;  // of logarithms of kd, whose bound is at 0
  for (const double v : noisy.values[0]) mean += std::log(v * std::numbers::pi) / n;
  for (const double v : noisy.values[0])
    squares += std::pow(std::log(v * std::numbers::pi) - mean, 2);
  const double error = std::sqrt(squares / (n - 1) / n);
  const auto status_at = [&](double errors_beyond) {
    Table t = noisy;
    for (double& v : t.values[0]) v *= std::exp(errors_beyond * error - mean);
    FitOptions o;
    o.model = "lambert";
    return parameter(fit(t, o).document, "kd").status[0];
  };
  EXPECT_EQ(status_at(-3), ParameterStatus::free);
  for (const double errors : {0.5, 1.5})
    EXPECT_EQ(status_at(errors), ParameterStatus::lower_limit) << errors;
  for (const double errors : {2.5, 4.0, 30.0})
    EXPECT_EQ(status_at(errors), ParameterStatus::at_bound) << errors;
}

}  // namespace
}  // namespace gonio
