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

TEST(Nearest, BeginWithANameThatSomebodyDidNotFinish) {
  constexpr std::array<std::string_view, 4> known{"none", "hammon", "smith_ggx.separable",
                                                  "smith_ggx.correlated"};
  EXPECT_EQ(nearest("smith", known).front(), "smith_ggx.separable");
  EXPECT_EQ(nearest("smith", known)[1], "smith_ggx.correlated");
  EXPECT_EQ(nearest("s", known).front(), "none") << "a letter says too little";
}

TEST(Nearest, OfLongNamesCompareTheirBeginnings) {
  const std::string a(1'000'000, 'a'), b(1'000'000, 'b');
  EXPECT_EQ(nearest(a, std::array<std::string_view, 2>{b, a}).front(), a);
}

}  // namespace
}  // namespace gonio
