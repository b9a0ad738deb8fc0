// One rule says which samples share an incident angle, whoever asks.
#include "fitting/sample/incident_angles.h"

#include <cmath>
#include <set>

#include "fitting/support.h"
#include "table/example.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

Sampling sampling(const Table& t) {
  return {t, Bins::centre, Metric::l2_cosine, 0, false};
}
double cosine(double theta_deg) {
  return std::cos(theta_deg * degree);
}

TEST(IncidentKeys, OfAListAreToldApartToAThousandthOfADegree) {
  Table t = test::list_of({1, 1, 1, 1});
  std::get<DirectionList>(t.where).theta_i_deg = {30, 30.0002, 30.002, 60};
  const IncidentKeys keys(sampling(t));
  EXPECT_EQ(keys.count(), 3U);
  EXPECT_EQ(keys(0, cosine(30)), keys(1, cosine(30.0002)));
  EXPECT_NE(keys(1, cosine(30.0002)), keys(2, cosine(30.002)));
  for (std::size_t i = 0; i < 4; ++i) {
    const double theta = t.list()->theta_i_deg[i];
    EXPECT_EQ(keys.near(cosine(theta)), keys(i, cosine(theta))) << theta;
  }
  EXPECT_EQ(keys.near(cosine(90)), keys(3, cosine(60)));
  EXPECT_EQ(keys.near(cosine(0)), keys(0, cosine(30)));
}

TEST(IncidentKeys, OfManyAreWholeDegrees) {
  std::vector<double> values(2000, 1.0);
  Table t = test::list_of(values);
  const IncidentKeys keys(sampling(t));
  std::set<std::size_t> met;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double nol = cosine(t.list()->theta_i_deg[i]);
    met.insert(keys(i, nol));
    EXPECT_EQ(keys.near(nol), keys(i, nol)) << i;
  }
  EXPECT_NEAR(static_cast<double>(met.size()), 60, 1);  // from 10 to 70°
  EXPECT_LE(*met.rbegin(), keys.count());
}

TEST(IncidentKeys, OfAGridAreItsRowsAndACopyHasThatOfTheFirst) {
  constexpr std::size_t thetas = 5, phis = 4;
  Table t = test::mbsdf_example(thetas, phis);
  const std::size_t width = thetas * phis;
  for (auto& plane : t.values)
    std::copy_n(plane.begin() + static_cast<std::ptrdiff_t>(2 * width), width,
                plane.begin() + static_cast<std::ptrdiff_t>(3 * width));
  const Sampling s = sampling(t);
  const IncidentKeys keys(s);
  for (std::size_t row = 0; row < thetas; ++row) {
    const double nol = std::cos(s.angles().theta_i(row * width));
    EXPECT_EQ(keys(row * width, nol), row == 3 ? 2 : row);
    EXPECT_EQ(keys.near(nol), keys(row * width, nol)) << row;
  }
}

TEST(IncidentKeys, OfHalfAndDifferenceAnglesAreWholeDegrees) {
  const Table t = synthesize(test::bind("lambert", "kd=0.2", 3), {});
  const IncidentKeys keys(sampling(t));
  for (const double theta : {0.0, 12.0, 12.5, 44.9, 89.0}) {
    EXPECT_EQ(keys(0, cosine(theta)), keys.near(cosine(theta)));
    EXPECT_EQ(keys(0, cosine(theta), keys.near(cosine(theta))), keys.near(cosine(theta)));
  }
  EXPECT_EQ(keys.near(cosine(12)), keys.near(cosine(12.5)));
  EXPECT_NE(keys.near(cosine(12)), keys.near(cosine(13)));
}

}  // namespace
}  // namespace gonio
