#include "geometry/half_difference.h"

#include <random>

#include "constants.h"

namespace gonio {
namespace {

using test::eps;
using test::pi;

double distance(const Direction& a, const Direction& b) {
  return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}
double length(const Direction& a) {
  return std::sqrt(dot(a, a));
}

class HalfDifferenceAngles : public testing::Test {
 protected:
  double uniform(double low, double high) {
    return std::uniform_real_distribution(low, high)(random_);
  }
  /// Anywhere, and often where it hurts: at the pole, at grazing, nearly opposite.
  double zenith() {
    switch (random_() % 4) {
      case 0:
        return std::exp(uniform(std::log(1e-9), std::log(1e-2)));
      case 1:
        return pi / 2 - std::exp(uniform(std::log(1e-9), std::log(1e-2)));
      default:
        return uniform(0, pi / 2);
    }
  }
  HalfDifference draw() { return {zenith(), uniform(-pi, pi), zenith(), uniform(-pi, pi)}; }

 private:
  std::mt19937_64 random_{3};
};

TEST_F(HalfDifferenceAngles, AreThoseOfTheDefinitionInThePlaneOfIncidence) {
  // wi and wo in the xz plane at 70° and −10°: h at 30°, 40° away from both.
  const auto a = half_difference({direction(70 * degree, 0), direction(10 * degree, pi)});
  EXPECT_NEAR(a.theta_h, 30 * degree, 4 * eps);
  EXPECT_NEAR(a.phi_h, 0, 4 * eps);
  EXPECT_NEAR(a.theta_d, 40 * degree, 4 * eps);
  EXPECT_NEAR(std::remainder(a.phi_d, 2 * pi), 0, 4 * eps);
}

TEST_F(HalfDifferenceAngles, FollowTheFormulaOfTheHeader) {
  for (int trial = 0; trial < 1000; ++trial) {
    HalfDifference a = draw();
    a.phi_h = 0;
    const auto p = directions(a);
    const double u = std::cos(a.theta_h) * std::cos(a.theta_d);
    const double w = std::sin(a.theta_h) * std::sin(a.theta_d) * std::cos(a.phi_d);
    EXPECT_NEAR(p.wi.z, u - w, 4 * eps);
    EXPECT_NEAR(p.wo.z, u + w, 4 * eps);
  }
}

TEST_F(HalfDifferenceAngles, DirectionsAreUnitVectorsWithTheirHalfVectorBetweenThem) {
  for (int trial = 0; trial < 1000; ++trial) {
    const auto a = draw();
    const auto p = directions(a);
    EXPECT_NEAR(length(p.wi), 1, 8 * eps);
    EXPECT_NEAR(length(p.wo), 1, 8 * eps);
    const Direction h = direction(a.theta_h, a.phi_h);
    EXPECT_NEAR(dot(p.wi, h), std::cos(a.theta_d), 8 * eps);
    EXPECT_NEAR(dot(p.wo, h), std::cos(a.theta_d), 8 * eps);
    const double c = 2 * std::cos(a.theta_d);
    EXPECT_LT(
        distance({p.wi.x + p.wo.x, p.wi.y + p.wo.y, p.wi.z + p.wo.z}, {c * h.x, c * h.y, c * h.z}),
        8 * eps);
  }
}

TEST_F(HalfDifferenceAngles, RoundTripThroughDirections) {
  for (int trial = 0; trial < 2000; ++trial) {
    const auto a = draw();
    const auto p = directions(a);
    const auto b = half_difference(p);
    // An angle is lost as the vector it turns shrinks: cos θ_d is the length of wi + wo.
    const double lost = 16 * eps / std::cos(a.theta_d);
    EXPECT_NEAR(b.theta_h, a.theta_h, lost);
    EXPECT_NEAR(b.theta_d, a.theta_d, lost);
    EXPECT_NEAR(std::remainder(b.phi_h - a.phi_h, 2 * pi) * std::sin(a.theta_h), 0, lost);
    const auto q = directions(b);
    EXPECT_LT(distance(p.wi, q.wi), 16 * eps);
    EXPECT_LT(distance(p.wo, q.wo), lost);
  }
}

TEST_F(HalfDifferenceAngles, RoundTripFromDirections) {
  for (int trial = 0; trial < 2000; ++trial) {
    const DirectionPair p{direction(zenith(), uniform(-pi, pi)),
                          direction(zenith(), uniform(-pi, pi))};
    const auto a = half_difference(p);
    EXPECT_TRUE(0 <= a.theta_h && a.theta_h <= pi / 2);
    EXPECT_TRUE(0 <= a.theta_d && a.theta_d <= pi / 2);
    const auto q = directions(a);
    const double lost = 16 * eps / std::cos(a.theta_d);
    EXPECT_LT(distance(p.wi, q.wi), 16 * eps);
    EXPECT_LT(distance(p.wo, q.wo), lost);
  }
}

TEST_F(HalfDifferenceAngles, SwappingTheDirectionsTurnsPhiDByHalfATurn) {
  for (int trial = 0; trial < 500; ++trial) {
    const DirectionPair p{direction(uniform(0.1, 1.4), uniform(-pi, pi)),
                          direction(uniform(0.1, 1.4), uniform(-pi, pi))};
    const auto a = half_difference(p), b = half_difference({p.wo, p.wi});
    EXPECT_NEAR(a.theta_h, b.theta_h, 1e-14);
    EXPECT_NEAR(a.theta_d, b.theta_d, 1e-13);
    EXPECT_NEAR(std::remainder(a.phi_d - b.phi_d - pi, 2 * pi) * std::sin(a.theta_d), 0, 1e-13);
  }
}

TEST_F(HalfDifferenceAngles, AreZeroWhereTheyAreUndefined) {
  const Direction n{0, 0, 1};
  const auto normal = half_difference({n, n});
  EXPECT_EQ(normal.theta_h, 0);
  EXPECT_EQ(normal.phi_h, 0);
  EXPECT_EQ(normal.theta_d, 0);
  EXPECT_EQ(normal.phi_d, 0);
  const auto mirror = half_difference({direction(0.5, 0), direction(0.5, pi)});
  EXPECT_NEAR(mirror.theta_h, 0, eps);
  EXPECT_NEAR(mirror.theta_d, 0.5, 4 * eps);
}

// ---- Angles -------------------------------------------------------------------------------------

TEST_F(HalfDifferenceAngles, GiveTheSameCosinesAsTheDirections) {
  for (int trial = 0; trial < 2000; ++trial) {
    const auto a = draw();
    const auto x = angles(directions(a));
    const auto y = angles(SinCos(a.theta_h), SinCos(a.theta_d), std::cos(a.phi_d));
    EXPECT_NEAR(x.nol, y.nol, 8 * eps);
    EXPECT_NEAR(x.nov, y.nov, 8 * eps);
    EXPECT_NEAR(x.voh, y.voh, 8 * eps);
    const double lost = 16 * eps / y.voh;
    EXPECT_NEAR(x.noh, y.noh, lost);
    EXPECT_NEAR(x.sin2_theta_h, y.sin2_theta_h, lost);
  }
}

TEST_F(HalfDifferenceAngles, KeepSinSquaredAtThePeak) {
  const HalfDifference at{1e-5, 0, 0.7, 0};
  for (int trial = 0; trial < 200; ++trial) {
    HalfDifference a = at;
    a.phi_h = uniform(-pi, pi);
    a.phi_d = uniform(-pi, pi);
    const long double sine = std::sin(static_cast<long double>(a.theta_h));
    const auto expected = static_cast<double>(sine * sine);
    EXPECT_NEAR(angles(SinCos(a.theta_h), SinCos(a.theta_d), std::cos(a.phi_d)).sin2_theta_h,
                expected, 4 * eps * expected);

    // From directions: as exact as the directions are, which are rounded at 1 (eps/1e-5 of θ_h).
    const auto p = directions(a);
    const auto x = angles(p);
    EXPECT_NEAR(x.sin2_theta_h, expected, 8 * eps / 1e-5 * expected);
    const long double hx = static_cast<long double>(p.wi.x) + p.wo.x;
    const long double hy = static_cast<long double>(p.wi.y) + p.wo.y;
    const long double hz = static_cast<long double>(p.wi.z) + p.wo.z;
    const auto exact = static_cast<double>((hx * hx + hy * hy) / (hx * hx + hy * hy + hz * hz));
    EXPECT_NEAR(x.sin2_theta_h, exact, 1e-12 * exact);
    EXPECT_GT(std::abs((1 - x.noh * x.noh) / exact - 1), 1e-8) << "the form that cancels";
  }
}

TEST_F(HalfDifferenceAngles, OfOppositeDirectionsAreFinite) {
  const Direction d = direction(0.4, 0.3);
  const auto a = angles({d, {-d.x, -d.y, -d.z}});
  EXPECT_EQ(a.voh, 0);
  EXPECT_EQ(a.noh, 0);
  EXPECT_EQ(a.sin2_theta_h, 1);
  EXPECT_EQ(a.nol, -a.nov);
}

/// dω_h/dω_l at fixed v, by how a small square of directions around l moves its half vectors.
double half_vector_stretch(const Direction& l, const Direction& v) {
  const Direction s = std::abs(l.z) < 0.9 ? Direction{0, 0, 1} : Direction{1, 0, 0};
  const auto cross = [](const Direction& a, const Direction& b) {
    return Direction{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  };
  const auto normalised = [](const Direction& a) {
    const double n = length(a);
    return Direction{a.x / n, a.y / n, a.z / n};
  };
  const Direction t1 = normalised(cross(s, l)), t2 = cross(l, t1);
  const auto half = [&](const Direction& t, double h) {
    const auto a = half_difference({normalised({l.x + h * t.x, l.y + h * t.y, l.z + h * t.z}), v});
    return direction(a.theta_h, a.phi_h);
  };
  const auto slope = [&](const Direction& t) {
    const double h = 1e-5;
    const Direction a = half(t, h), b = half(t, -h);
    return Direction{(a.x - b.x) / (2 * h), (a.y - b.y) / (2 * h), (a.z - b.z) / (2 * h)};
  };
  return length(cross(slope(t1), slope(t2)));
}

TEST_F(HalfDifferenceAngles, StretchSolidAngleByOneOverFourVoH) {
  for (int trial = 0; trial < 200; ++trial) {
    const Direction l = direction(uniform(0, 1.5), uniform(-pi, pi));
    const Direction v = direction(uniform(0, 1.5), uniform(-pi, pi));
    const double voh = angles({l, v}).voh;
    EXPECT_NEAR(half_vector_stretch(l, v) * 4 * voh, 1, 1e-7);
  }
}

TEST(HalfVector, TurnsByOneFourthOfTheSolidAngleOverVoh) {  // dω_h = dω_l/(4 VoH)
  const auto h = [](const Direction& l, const Direction& v) {
    const double x = l.x + v.x, y = l.y + v.y, z = l.z + v.z, length = std::hypot(x, y, z);
    return Direction{x / length, y / length, z / length};
  };
  const double step = 1e-5;
  for (const double theta_l : {0.2, 0.8, 1.4})
    for (const double phi_l : {0.0, 1.0, 3.0})
      for (const double theta_v : {0.0, 0.5, 1.3}) {
        const auto l = direction(theta_l, phi_l), v = direction(theta_v, 0.3);
        const auto change = [&](double theta, double phi) {  // of h, by steps along l's θ and φ
          const auto a = h(direction(theta_l + theta, phi_l + phi), v);
          const auto b = h(direction(theta_l - theta, phi_l - phi), v);
          return Direction{(a.x - b.x) / (2 * step), (a.y - b.y) / (2 * step),
                           (a.z - b.z) / (2 * step)};
        };
        const auto a = change(step, 0), b = change(0, step);
        const double area = std::hypot(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z,
                                       a.x * b.y - a.y * b.x);  // dω_h/(dθ_l dφ_l)
        const double voh = dot(v, h(l, v));
        EXPECT_NEAR(area / std::sin(theta_l) * 4 * voh, 1, 1e-8)
            << theta_l << " " << phi_l << " " << theta_v;
      }
}

}  // namespace
}  // namespace gonio
