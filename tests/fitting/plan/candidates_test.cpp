#include "fitting/plan/candidates.h"

#include <cmath>
#include <set>
#include <tuple>

#include "fitting/plan/plan_next.h"
#include "fitting/support.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

using test::bind;

TEST(Candidates, AreDirectionsThatAnInstrumentCanTake) {
  for (const bool in_plane : {false, true}) {
    const DirectionList l = candidates(in_plane);
    ASSERT_GT(l.theta_i_deg.size(), in_plane ? most_planned : 2000U);
    std::set<std::tuple<double, double, double>> distinct;
    for (std::size_t i = 0; i < l.theta_i_deg.size(); ++i) {
      const double in = l.theta_i_deg[i], out = l.theta_o_deg[i], phi = l.phi_o_deg[i];
      EXPECT_TRUE(distinct.insert({in, out, phi}).second) << in << ' ' << out << ' ' << phi;
      EXPECT_EQ(l.phi_i_deg[i], 0);
      for (const double theta : {in, out}) {
        EXPECT_GE(theta, 0);
        EXPECT_LE(theta, 80);
      }
      const double apart = std::acos(std::min(1.0, dot(direction(in * degree, 0),
                                                       direction(out * degree, phi * degree)))) /
                           degree;
      EXPECT_GT(apart, 9.7) << "to a tenth of a degree";
      EXPECT_TRUE(!in_plane || phi == 0 || phi == 180) << phi;
      for (const double angle : {in, out, phi})
        EXPECT_NEAR(10 * angle, std::round(10 * angle), 1e-9);
    }
    EXPECT_TRUE(distinct.contains({45, 45, 180})) << "a mirror direction";
  }
}

TEST(Candidates, LieInThePlaneOfIncidenceWhereTheTableDoes) {
  const BoundModel m = bind("lambert", "kd=0.3", 3);
  EXPECT_TRUE(is_in_plane_of_incidence(synthesize(m, {.layout = Layout::in_plane})));
  for (const Layout out_of_it : {Layout::hemisphere, Layout::merl, Layout::mbsdf})
    EXPECT_FALSE(is_in_plane_of_incidence(synthesize(m, {.layout = out_of_it})));
  Table turned = synthesize(m, {.layout = Layout::in_plane});
  DirectionList l = *turned.list();
  for (auto* phi : {&l.phi_i_deg, &l.phi_o_deg})
    for (auto& x : *phi) x += 37;
  turned.where = l;
  EXPECT_TRUE(is_in_plane_of_incidence(turned)) << "whichever way the plane lies";
  DirectionList normal{{0.5, 0.5, 0.5}, {0, 0, 0}, {30, 30, 30}, {0, 90, 200}};
  turned.where = normal;
  for (auto& v : turned.values) v.resize(3);
  EXPECT_FALSE(is_in_plane_of_incidence(turned)) << "light along the normal has no plane";
}

}  // namespace
}  // namespace gonio
