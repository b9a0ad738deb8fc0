// Parameters as a document shows them.
#include "fitting/judge/describe.h"

#include <cmath>

#include "fitting/support.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

using test::parameter;

TEST(Description, GivesRoughnessTheErrorAndTheIntervalThatItsSquareHas) {
  const auto truth =
      test::bind("lambert+ggx/smith_ggx.correlated/schlick", "alpha=0.16,f0=0.05,kd=0.2", 1);
  const Table t = synthesize(truth, {.layout = Layout::random});
  FitOptions o;
  o.model = to_text(truth.model.spec);
  const Problem p = pose(t, o);
  Uncertainty u(3);
  for (auto& v : u.verdicts) v.std_error = 0.008, v.t = 2;
  FitDocument d;
  d.channels = t.channels;
  describe(d, p, truth.values, u);
  const auto &alpha = parameter(d, "alpha"), &roughness = parameter(d, "roughness");
  EXPECT_EQ(alpha.value[0], 0.16);
  EXPECT_EQ(alpha.std_error[0], 0.008);
  EXPECT_NEAR(alpha.ci95_low[0], 0.144, 1e-15);
  EXPECT_NEAR(alpha.ci95_high[0], 0.176, 1e-15);
  EXPECT_NEAR(roughness.value[0], 0.4, 1e-15);
  EXPECT_NEAR(roughness.std_error[0], 0.01, 1e-15);  // dα = 2 r dr
  EXPECT_NEAR(roughness.ci95_low[0], std::sqrt(0.144), 1e-15);
  EXPECT_NEAR(roughness.ci95_high[0], std::sqrt(0.176), 1e-15);
  EXPECT_EQ(d.free_names, (std::vector<std::string>{"kd", "alpha", "f0"}));
}

TEST(Description, TellsNoValueOfWhatIsNotIdentifiableAndNoErrorOfWhatIsFixed) {
  const auto truth = test::bind("lambert+ggx/smith_ggx.correlated/schlick", "kd=0.2", 2);
  const Table t = synthesize(truth, {.layout = Layout::random});
  FitOptions o;
  o.model = to_text(truth.model.spec);
  o.fixed = parse_settings(std::vector<std::string>{"alpha=0.3"});
  const Problem p = pose(t, o);
  Uncertainty u(4);
  for (auto& v : u.verdicts) v.std_error = 0.01, v.t = 2;
  const std::size_t lost = p.free.index(truth.model.find("kd")->first + 1);
  u[lost].status = ParameterStatus::not_identifiable;
  FitDocument d;
  d.channels = t.channels;
  describe(d, p, truth.values, u);
  EXPECT_EQ(parameter(d, "kd").value[0], 0.2);
  for (const double x : {parameter(d, "kd").value[1], parameter(d, "kd").std_error[1],
                         parameter(d, "kd").ci95_low[1], parameter(d, "alpha").std_error[0]})
    EXPECT_TRUE(std::isnan(x));
  EXPECT_EQ(parameter(d, "alpha").status[0], ParameterStatus::fixed);
  EXPECT_EQ(d.free_names[lost], "kd." + t.channels[1]);
}

}  // namespace
}  // namespace gonio
