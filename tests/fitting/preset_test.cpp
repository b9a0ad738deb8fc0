// Whole models by name: their spec is fitted, and what ties its parameters together is left to
// them.
#include "data_synth/synth.h"
#include "fitting/fit.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

const FittedParameter& parameter(const FitDocument& d, const std::string& name) {
  for (const auto& p : d.parameters)
    if (p.name == name) return p;
  throw std::out_of_range(name);
}

Table gltf_table() {
  SynthOptions o;
  o.layout = Layout::random;
  o.samples = 3000;
  o.noise = 0.01;
  return synthesize(
      bind_model(
          "gltf",
          parse_settings(std::vector<std::string>{"base_color=0.5,0.3,0.1", "roughness=0.5"}), 3),
      o);
}

TEST(FitOfAPreset, FindsTheParametersOfItsSpec) {
  FitOptions o;
  o.model = "gltf";
  const auto d = fit(gltf_table(), o).document;
  EXPECT_EQ(d.model, "lambert.coupled+ggx/smith_ggx.separable/schlick");
  EXPECT_NEAR(parameter(d, "alpha").value.at(0), 0.25, 0.002);
  EXPECT_NEAR(parameter(d, "kd").value.at(2), 0.1, 0.002);
}

TEST(FitOfAPreset, HoldsOnlyWhatItIsAskedTo) {
  FitOptions o;
  o.model = "gltf";
  o.fixed = parse_settings(std::vector<std::string>{"roughness=0.5"});
  const auto d = fit(gltf_table(), o).document;
  EXPECT_EQ(parameter(d, "alpha").status.at(0), ParameterStatus::fixed);
  EXPECT_EQ(parameter(d, "f0").status.at(0), ParameterStatus::free);
  EXPECT_NEAR(parameter(d, "f0").value.at(0), 0.04, 0.001);
  o.fixed = parse_settings(std::vector<std::string>{"metallic=0"});
  EXPECT_ANY_THROW(check(o));  // alone it says nothing of the spec's parameters
}

}  // namespace
}  // namespace gonio
