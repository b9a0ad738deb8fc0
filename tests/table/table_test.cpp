#include "table/table.h"

#include <cmath>

#include "support.h"
#include "table/example.h"

namespace gonio {
namespace {

using namespace test;
using std::numbers::pi;

double angle_deg(const Grid& g, std::size_t axis, double i) {
  return g.axes[axis].angle(i, g.bins) / degree;
}

TEST(Bins, GiveMerlsDocumentedAngles) {
  const Grid centre = merl_grid(Bins::centre), edge = merl_grid(Bins::edge);
  for (const double i : {0.0, 1.0, 17.0, 89.0}) {
    EXPECT_NEAR(angle_deg(centre, 0, i), (i + 0.5) * (i + 0.5) / 90, 1e-12);
    EXPECT_NEAR(angle_deg(edge, 0, i), i * i / 90, 1e-12);
    for (const std::size_t axis : {1U, 2U}) {
      EXPECT_NEAR(angle_deg(centre, axis, i), i + 0.5, 1e-12);
      EXPECT_NEAR(angle_deg(edge, axis, i), i, 1e-12);
    }
  }
}

TEST(Bins, GiveMbsdfsDocumentedAngles) {
  const Grid centre = mbsdf_grid(45, 90, Bins::centre), edge = mbsdf_grid(45, 90, Bins::edge);
  for (const std::size_t axis : {0U, 1U}) {
    EXPECT_NEAR(angle_deg(centre, axis, 3), 7, 1e-12);
    EXPECT_NEAR(angle_deg(edge, axis, 3), 6, 1e-12);
  }
  for (const Grid& g : {centre, edge}) {
    EXPECT_EQ(angle_deg(g, 2, 0), 0);
    EXPECT_NEAR(angle_deg(g, 2, 89), 180, 1e-12) << "both ends are samples";
  }
}

TEST(Axis, IndexIsTheInverseOfAngle) {
  for (const Grid& g : {merl_grid(Bins::centre), merl_grid(Bins::edge),
                        merl_grid(Bins::centre, false), mbsdf_grid(7, 9, Bins::edge)})
    for (const Axis& axis : g.axes)
      for (double i = 0; i < static_cast<double>(axis.size); i += 0.75)
        EXPECT_NEAR(axis.index(axis.angle(i, g.bins), g.bins), i, 1e-9) << axis.name;
}

TEST(Interpolator, GivesTheStoredValueAtEverySample) {
  for (const Table& t : {merl_example(), merl_example(0.2, Bins::centre, false),
                         merl_example(0.2, Bins::edge), mbsdf_example(), slice_example()}) {
    const Interpolator f(t);
    const SampleAngles at(t);
    for (std::size_t i = 0; i < t.size(); i += 1 + t.size() / 3001) {
      const auto a = at(i);
      // theta_h and theta_d = 0 have no azimuth; within rounding of the horizon nothing is said.
      if (!(a.nol > 1e-9 && a.nov > 1e-9) || a.sin2_theta_h < 1e-20 || a.voh > 1 - 1e-12) continue;
      const double v = t.values[0][i];
      EXPECT_NEAR(f(at.directions(i), 0) / v, 1, 1e-9) << t.format << " sample " << i;
    }
  }
}

TEST(Interpolator, KnowsTheTwoWaysOfANonReciprocalTableApart) {
  Table t = merl_example(0.2, Bins::centre, false);
  for (std::size_t i = 0; i < t.size(); ++i) t.values[0][i] = t.grid()->unravel(i)[2] < 180 ? 1 : 2;
  const Interpolator f(t);
  const DirectionPair there = directions({30 * degree, 0, 20 * degree, 70 * degree});
  EXPECT_NEAR(f(there, 0), 1, 1e-12);
  EXPECT_NEAR(f({there.wo, there.wi}, 0), 2, 1e-12);
}

TEST(Interpolator, IsSmoothAcrossTheSeamOfPhi) {
  for (const bool reciprocal : {true, false}) {
    const Table t = merl_example(0.2, Bins::centre, reciprocal);
    const Interpolator f(t);
    for (const double turn : {0.0, 180.0}) {
      const auto at = [&](double phi_deg) {
        return f(directions({20 * degree, 0, 30 * degree, (turn + phi_deg) * degree}), 0);
      };
      EXPECT_NEAR(at(-1e-7), at(1e-7), 1e-9);
    }
  }
}

TEST(Interpolator, SaysNothingWhereThereIsNothing) {
  Table t = mbsdf_example();
  for (auto& v : t.values[0]) v = std::nan("");
  EXPECT_TRUE(std::isnan(Interpolator(t)({direction(0.5, 0), direction(0.6, 2)}, 0)));
  EXPECT_TRUE(std::isnan(Interpolator(csv_example())({direction(0.5, 0), direction(0.6, 2)}, 0)));
}

}  // namespace
}  // namespace gonio
