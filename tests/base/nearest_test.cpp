#include "base/nearest.h"

#include <array>
#include <string>

#include <gtest/gtest.h>

namespace gonio {
namespace {

TEST(Nearest, AreThreeAtMostTheNearestFirstThoseAlikeInTheirOrder) {
  constexpr std::array<std::string_view, 4> known{"gold", "goad", "chalk", "cold"};
  EXPECT_EQ(nearest("gild", known), (std::vector<std::string_view>{"gold", "goad", "cold"}));
  EXPECT_EQ(nearest("chalk", known).front(), "chalk");
  EXPECT_TRUE(nearest("gold", {}).empty());
}

TEST(Nearest, OfLongNamesCompareTheirBeginnings) {
  const std::string a(1'000'000, 'a'), b(1'000'000, 'b');
  EXPECT_EQ(nearest(a, std::array<std::string_view, 2>{b, a}).front(), a);
}

}  // namespace
}  // namespace gonio
