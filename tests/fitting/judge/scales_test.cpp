// Scales of incident angles are an instrument's, whatever a metal's two indices make of them.
#include "fitting/judge/scales.h"

#include <cmath>
#include <map>
#include <random>

#include "fitting/fit.h"
#include "fitting/support.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

constexpr const char* metal = "ggx/smith_ggx.correlated/conductor";

/// Values of a metal, each incident angle with a gain of its own.
Table with_gains(std::uint64_t seed, double spread) {
  Table t = synthesize(test::bind(metal, "alpha=0.25,eta=1.2,k=4", 1),
                       {.layout = Layout::hemisphere, .noise = 0.01, .seed = seed});
  t.truth.reset();  // as if measured
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::map<double, double> gain;
  for (std::size_t i = 0; i < t.size(); ++i) {
    double& g = gain[t.list()->theta_i_deg[i]];
    if (g == 0) g = std::exp(spread * normal(random));
    t.values[0][i] *= t.list()->theta_i_deg[i] > 50 ? std::nan("") : g;
  }
  return t;
}

FitDocument of_model(const Table& t, const char* model) {
  FitOptions o;
  o.model = model;
  o.certificate = Certify::none;
  return fit(t, o).document;
}

TEST(Scales, OfAMetalsIncidentAnglesAreNoMisfit) {
  for (std::uint64_t seed = 21; seed <= 28; ++seed)
    EXPECT_FALSE(of_model(with_gains(seed, 0.05), metal).misfit.told) << seed;
}

TEST(Scales, OfAMetalsIncidentAnglesHideNoOtherDistribution) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
    EXPECT_TRUE(of_model(with_gains(seed, 0.04), "beckmann/smith_beckmann.correlated/conductor")
                    .misfit.told)
        << seed;
}

}  // namespace
}  // namespace gonio
