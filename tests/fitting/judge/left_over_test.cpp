// Residuals value by value: readings that stand twice are one.
#include "fitting/judge/left_over.h"

#include <cmath>
#include <functional>
#include <random>

#include "fitting/fit.h"
#include "fitting/goniometer.h"
#include "fitting/support.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

constexpr const char* spec = "lambert+ggx/smith_ggx.correlated/schlick";

/// Some directions of a right table with noise, and each reading once more as another program may write it.
Table twice(const std::function<void(DirectionList&)>& otherwise) {
  Table once;
  once.channels = {"f"};
  test::put_on_goniometer(once, test::bind(spec, "alpha=0.2,f0=0.05,kd=0.2", 1));
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  for (double& v : once.values[0]) v *= std::exp(0.02 * normal(random));
  once.truth.reset();
  Table both = once;
  DirectionList more = *once.list();
  otherwise(more);
  auto& to = std::get<DirectionList>(both.where);
  const auto append = [](auto& all, const auto& some) {
    all.insert(all.end(), some.begin(), some.end());
  };
  append(to.theta_i_deg, more.theta_i_deg), append(to.phi_i_deg, more.phi_i_deg);
  append(to.theta_o_deg, more.theta_o_deg), append(to.phi_o_deg, more.phi_o_deg);
  append(both.values[0], once.values[0]);
  return both;
}

TEST(LeftOver, AReadingThatStandsTwiceCountsOnce) {
  const std::pair<const char*, std::function<void(DirectionList&)>> ways[] = {
      {"again", [](DirectionList&) {}},
      {"mirrored",
       [](DirectionList& l) {
         for (double& phi : l.phi_o_deg) phi = 360 - phi;
       }},
      {"exchanged", [](DirectionList& l) { std::swap(l.theta_i_deg, l.theta_o_deg); }}};
  for (const auto& [name, way] : ways) {
    const Table t = twice(way);
    FitOptions o;
    o.model = spec;
    const auto d = fit(t, o).document;
    EXPECT_FALSE(d.misfit.told) << name << ": " << d.misfit.size << " p " << d.misfit.p;
  }
}

}  // namespace
}  // namespace gonio
