#include "stability/places.h"

#include <cmath>
#include <limits>

namespace gonio::stability {
namespace {

TEST(Places, OfNeighboursAreOneApartInEveryNumber) {
  for (const auto number : {Number::half, Number::float_, Number::double_, Number::mixed})
    for (const bool parameter : {true, false}) {
      EXPECT_EQ(place_of(number, 0, parameter), 0);
      EXPECT_EQ(place_of(number, -0.0, parameter), 0);
      for (const std::int64_t at : {-2000, -1025, -1, 0, 1, 1023, 1024, 1025, 2047, 2048, 15360}) {
        const double x = at_place(number, at, parameter),
                     next = at_place(number, at + 1, parameter);
        EXPECT_LT(x, next);
        EXPECT_EQ(place_of(number, x, parameter), at);
      }
    }
  EXPECT_EQ(at_place(Number::half, 1, false), 0x1p-24);
  EXPECT_EQ(at_place(Number::half, 0x3c00, false), 1);
  EXPECT_EQ(at_place(Number::half, 0x7bff, false), 65504);
  EXPECT_EQ(at_place(Number::mixed, 0x3c00, true), 1);
  EXPECT_EQ(place_of(Number::mixed, 1, false), 0x3f800000);
  EXPECT_EQ(at_place(Number::float_, place_of(Number::float_, 1, false) - 1, false), 1 - 0x1p-24);
  EXPECT_EQ(at_place(Number::double_, place_of(Number::double_, -1, false) - 1, false),
            std::nextafter(-1, -2));
}

TEST(Places, WithinARangeAreThoseOfItsNumbers) {
  const auto within = [](double low, double high) {
    const auto p = places_within(Number::half, {low, high}, true);
    return std::pair(at_place(Number::half, p.first, true), at_place(Number::half, p.last, true));
  };
  EXPECT_EQ(within(0.25, 1), std::pair(0.25, 1.0));
  EXPECT_EQ(within(0.24999, 1.0001), std::pair(0.25, 1.0));
  EXPECT_EQ(within(-1, 0), std::pair(-1.0, 0.0));
  EXPECT_EQ(within(1e-8, 1).first, 0x1p-24);
  EXPECT_EQ(within(1.0001, 1.0002), std::pair(1.0, 1.0));  // none: the next
}

}  // namespace
}  // namespace gonio::stability
