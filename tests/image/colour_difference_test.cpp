#include "image/colour_difference.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace gonio {
namespace {

/// Sharma, Wu and Dalal 2005, The CIEDE2000 color-difference formula, Table 1: made to tell errors of
/// implementations.
struct Pair {
  Lab x, y;
  double difference;
};
constexpr Pair published[] = {{{50, 2.6772, -79.7751}, {50, 0, -82.7485}, 2.0425},
                              {{50, 3.1571, -77.2803}, {50, 0, -82.7485}, 2.8615},
                              {{50, 2.8361, -74.0200}, {50, 0, -82.7485}, 3.4412},
                              {{50, -1.3802, -84.2814}, {50, 0, -82.7485}, 1.0000},
                              {{50, -1.1848, -84.8006}, {50, 0, -82.7485}, 1.0000},
                              {{50, -0.9009, -85.5211}, {50, 0, -82.7485}, 1.0000},
                              {{50, 0, 0}, {50, -1, 2}, 2.3669},
                              {{50, -1, 2}, {50, 0, 0}, 2.3669},
                              {{50, 2.4900, -0.0010}, {50, -2.4900, 0.0009}, 7.1792},
                              {{50, 2.4900, -0.0010}, {50, -2.4900, 0.0010}, 7.1792},
                              {{50, 2.4900, -0.0010}, {50, -2.4900, 0.0011}, 7.2195},
                              {{50, 2.4900, -0.0010}, {50, -2.4900, 0.0012}, 7.2195},
                              {{50, -0.0010, 2.4900}, {50, 0.0009, -2.4900}, 4.8045},
                              {{50, -0.0010, 2.4900}, {50, 0.0010, -2.4900}, 4.8045},
                              {{50, -0.0010, 2.4900}, {50, 0.0011, -2.4900}, 4.7461},
                              {{50, 2.5, 0}, {50, 0, -2.5}, 4.3065},
                              {{50, 2.5, 0}, {73, 25, -18}, 27.1492},
                              {{50, 2.5, 0}, {61, -5, 29}, 22.8977},
                              {{50, 2.5, 0}, {56, -27, -3}, 31.9030},
                              {{50, 2.5, 0}, {58, 24, 15}, 19.4535},
                              {{50, 2.5, 0}, {50, 3.1736, 0.5854}, 1.0000},
                              {{50, 2.5, 0}, {50, 3.2972, 0}, 1.0000},
                              {{50, 2.5, 0}, {50, 1.8634, 0.5757}, 1.0000},
                              {{50, 2.5, 0}, {50, 3.2592, 0.3350}, 1.0000},
                              {{60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}, 1.2644},
                              {{63.0109, -31.0961, -5.8663}, {62.8187, -29.7946, -4.0864}, 1.2630},
                              {{61.2901, 3.7196, -5.3901}, {61.4292, 2.2480, -4.9620}, 1.8731},
                              {{35.0831, -44.1164, 3.7933}, {35.0232, -40.0716, 1.5901}, 1.8645},
                              {{22.7233, 20.0904, -46.6940}, {23.0331, 14.9730, -42.5619}, 2.0373},
                              {{36.4612, 47.8580, 18.3852}, {36.2715, 50.5065, 21.2231}, 1.4146},
                              {{90.8027, -2.0831, 1.4410}, {91.1528, -1.6435, 0.0447}, 1.4441},
                              {{90.9257, -0.5406, -0.9208}, {88.6381, -0.8985, -0.7239}, 1.5381},
                              {{6.7747, -0.2908, -2.4247}, {5.8714, -0.0985, -2.2286}, 0.6377},
                              {{2.0776, 0.0795, -1.1350}, {0.9033, -0.0636, -0.5514}, 0.9082}};

TEST(ColourDifference, IsThatOfThePublishedPairsBothWays) {
  for (const auto& p : published) {
    EXPECT_NEAR(delta_e_2000(p.x, p.y), p.difference, 5e-5);
    EXPECT_NEAR(delta_e_2000(p.y, p.x), p.difference, 5e-5);
  }
}

TEST(Lab, OfWhiteIsHundredAndOfGreyIsGrey) {
  const std::array white{0.95, 1.0, 1.09};
  const Lab w = lab(white, white), half = lab({0.095, 0.1, 0.109}, white),
            dark = lab({0, 0, 0}, white);
  EXPECT_NEAR(w.l, 100, 1e-12);
  EXPECT_NEAR(half.l, 116 * std::cbrt(0.1) - 16, 1e-12);
  EXPECT_NEAR(std::hypot(half.a, half.b), 0, 1e-12);
  EXPECT_NEAR(dark.l, 0, 1e-12);
}

TEST(Lab, HasNoJumpWhereTheCubeRootBegins) {
  const double at = 216.0 / 24389;
  const Lab below = lab({at - 1e-12, at - 1e-12, at - 1e-12}, {1, 1, 1}),
            above = lab({at + 1e-12, at + 1e-12, at + 1e-12}, {1, 1, 1});
  EXPECT_NEAR(below.l, 8, 1e-8);
  EXPECT_NEAR(above.l, 8, 1e-8);
}

TEST(Itp, OfGreyHasNoColourAndThePublishedSignal) {
  const auto white = itp({203, 203, 203});
  EXPECT_NEAR(white.i, 0.5807, 1e-4) << "BT.2408: 203 cd/m² are 58 % of the signal";
  for (const double light : {0.0, 0.1, 100.0, 10'000.0}) {
    const auto grey = itp({light, light, light});
    EXPECT_NEAR(grey.t, 0, 1e-6);
    EXPECT_NEAR(grey.p, 0, 1e-6);
  }
  EXPECT_NEAR(itp({10'000, 10'000, 10'000}).i, 1, 1e-12);
  EXPECT_LT(itp({0, 0, 0}).i, 1e-6);
}

TEST(Itp, TellsHuesAndLightsBeyondADisplaysWhite) {
  EXPECT_LT(itp({203, 180, 20}).t, 0) << "yellow";
  EXPECT_GT(itp({20, 20, 203}).t, 0) << "blue";
  EXPECT_GT(itp({203, 20, 20}).p, 0) << "red";
  EXPECT_LT(itp({20, 203, 20}).p, 0) << "green";
  const auto of = [](double light) { return itp({light, light, light}); };
  // One step of 720 in the signal is about 1 % of the light there.
  EXPECT_NEAR(delta_e_itp(of(203), of(203 * 1.01)), 0.72, 0.2);
  EXPECT_GT(delta_e_itp(of(2000), of(3000)), 20);
}

}  // namespace
}  // namespace gonio
