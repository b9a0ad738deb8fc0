// What the data say nothing of is not told as a number.
#include "fitting/judge/undetermined.h"

#include <cmath>

#include "fitting/fit.h"
#include "fitting/support.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

using test::parameter;

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
        ASSERT_FALSE(d.warnings.empty());
        EXPECT_TRUE(d.warnings.back().starts_with("without its lobe")) << d.warnings.back();
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
    o.model = truth.model.spec;
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
    Uncertainty u;
    u.status = {ParameterStatus::free};
    u.std_error = {0.1};
    find_undetermined(p, data, f, 200, u);
    return Looked{2 * most / (2 * cost_at(0.3) / count), u.status[0]};
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

}  // namespace
}  // namespace gonio
