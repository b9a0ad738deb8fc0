// What a model can say in two ways has one answer.
#include "fitting/solve/order.h"

#include "fitting/fit.h"
#include "fitting/support.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

constexpr auto two = "lambert+ggx/smith_ggx.correlated/schlick+ggx/smith_ggx.correlated/schlick";

FitDocument fitted(const char* model, const char* settings, FitOptions o = {}) {
  o.model = model;
  const Table t =
      synthesize(test::bind(model, settings, 1), {.layout = Layout::random, .samples = 2000});
  return fit(t, o).document;
}
void expect_values(const FitDocument& d, const std::vector<std::pair<const char*, double>>& all) {
  for (const auto& [name, value] : all)
    EXPECT_NEAR(test::parameter(d, name).value[0] / value, 1, 1e-6) << name;
}

TEST(Order, OfLobesOfLikeTermsIsThatOfTheirWidths) {
  for (const char* truth : {"alpha=0.4,f0=0.2,alpha_2=0.05,f0_2=0.04,kd=0.1",
                            "alpha=0.05,f0=0.04,alpha_2=0.4,f0_2=0.2,kd=0.1"}) {
    const auto d = fitted(two, truth);
    expect_values(d, {{"alpha", 0.05}, {"f0", 0.04}, {"alpha_2", 0.4}, {"f0_2", 0.2}, {"kd", 0.1}});
    EXPECT_NE(test::parameter(d, "alpha_2").reason[0], "");
    EXPECT_EQ(test::parameter(d, "alpha").reason[0], "");
  }
}

TEST(Order, OfThreeLobesIsThatOfTheirWidths) {
  const auto d = fitted(
      "ggx/smith_ggx.correlated/schlick+ggx/smith_ggx.correlated/schlick+ggx/smith_ggx.correlated/"
      "schlick",
      "alpha=0.6,f0=0.3,alpha_2=0.03,f0_2=0.02,alpha_3=0.2,f0_3=0.1");
  expect_values(d, {{"alpha", 0.03},
                    {"f0", 0.02},
                    {"alpha_2", 0.2},
                    {"f0_2", 0.1},
                    {"alpha_3", 0.6},
                    {"f0_3", 0.3}});
}

TEST(Order, LeavesLobesThatAreNotAlike) {
  FitOptions o;
  o.fixed = parse_settings(std::vector<std::string>{"alpha=0.4"});
  expect_values(fitted(two, "alpha=0.4,f0=0.2,alpha_2=0.05,f0_2=0.04,kd=0.1", o),
                {{"alpha_2", 0.05}, {"f0_2", 0.04}});
  constexpr auto other =
      "ggx/smith_ggx.correlated/schlick+beckmann/smith_beckmann.correlated/schlick";
  expect_values(fitted(other, "alpha=0.4,f0=0.2,alpha_2=0.05,f0_2=0.04"),
                {{"alpha", 0.4}, {"alpha_2", 0.05}});
}

TEST(Order, LeavesTheLobeWhoseInterfaceTheDiffuseLiesBelow) {
  for (const bool coupled : {false, true}) {
    const std::string lobe = "ggx/smith_ggx.correlated/schlick",
                      model = (coupled ? "lambert.coupled+" : "lambert+") + lobe + "+" + lobe;
    const auto wide_first =
        test::bind(model.c_str(), "alpha=0.4,f0=0.2,alpha_2=0.05,f0_2=0.04,kd=0.3", 1);
    const Table t = synthesize(wide_first, {.layout = Layout::random, .samples = 100});
    FitOptions o;
    o.model = to_text(wide_first.model.spec);
    Problem p = pose(t, o);
    const auto data = fit_data<double>(sampling_for(p, t, t.bins()));
    Fitted f{wide_first, no_huber, {}};
    f.solution.at =
        Accumulator<double>(p.start.model, data, p.free).normal_equations(wide_first.values);
    put_in_order(p, f);
    EXPECT_EQ(f.model.values == wide_first.values, coupled);
  }
}

TEST(Order, ChangesNeitherTheCostNorItsDerivatives) {
  constexpr auto model =
      "lambert+ggx_aniso/smith_ggx_aniso.correlated/schlick+ggx_aniso/smith_ggx_aniso.correlated/"
      "schlick";
  const auto truth = test::bind(
      model,
      "alpha_x=0.2,alpha_y=0.5,f0=0.3,alpha_x_2=0.05,alpha_y_2=0.1,f0_2=0.05,kd=0.2,tangent=310",
      1);
  const Table t = synthesize(truth, {.layout = Layout::random, .samples = 500, .noise = 0.1});
  FitOptions o;
  o.model = model;
  Problem p = pose(t, o);
  const auto data = fit_data<double>(Sampling(t, t.bins(), Metric::log, 0, false, false, true));
  const Accumulator<double> accumulate(p.start.model, data, p.free);
  Fitted f{truth, no_huber, {}};
  f.solution.at = accumulate.normal_equations(truth.values);
  put_in_order(p, f);
  const auto at = [&](const char* name) { return f.model.values[truth.model.find(name)->first]; };
  EXPECT_EQ(at("alpha_x"), 0.1);
  EXPECT_EQ(at("alpha_y"), 0.05);
  EXPECT_EQ(at("f0"), 0.05);
  EXPECT_EQ(at("alpha_x_2"), 0.5);
  EXPECT_EQ(at("tangent"), 40);
  const auto expected = accumulate.normal_equations(f.model.values);
  EXPECT_NEAR(expected.cost, f.solution.at.cost, 1e-10 * expected.cost);
  for (std::size_t i = 0; i < p.free.size(); ++i) {
    const double scale = std::sqrt(expected.h(i, i) * expected.cost);
    EXPECT_NEAR(f.solution.at.g[i], expected.g[i], 1e-9 * scale) << i;
    for (std::size_t j = 0; j < p.free.size(); ++j)
      EXPECT_NEAR(f.solution.at.h(i, j), expected.h(i, j),
                  1e-9 * std::sqrt(expected.h(i, i) * expected.h(j, j)))
          << i << " " << j;
  }
  const std::size_t turn = p.free.index(truth.model.tangent()->first);
  EXPECT_EQ(p.bounds.low[turn], -50);
  EXPECT_EQ(p.bounds.high[turn], 130);
}

}  // namespace
}  // namespace gonio
