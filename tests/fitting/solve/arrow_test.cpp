// Matrices in arrow form hold what the dense ones hold, in less room.
#include "fitting/solve/arrow.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

std::shared_ptr<const ArrowLayout> two_channels() {
  return std::make_shared<const ArrowLayout>(std::vector<std::size_t>{0},
                                             std::vector<std::vector<std::size_t>>{{1, 3}, {2, 4}});
}

TEST(ArrowMatrix, HoldsWhatIsAddedOnBothSidesOfTheDiagonal) {
  ArrowMatrix m(two_channels());
  EXPECT_EQ(m.entries().size(), 1 + 2 * (4 + 2U));
  m.add(0, 0, 1);
  m.add(0, 3, 2);
  m.add(3, 0, 3);
  m.add(1, 3, 4);
  m.add(4, 4, 5);
  EXPECT_EQ(m(0, 0), 1);
  EXPECT_EQ(m(0, 3), 5);
  EXPECT_EQ(m(3, 0), 5);
  EXPECT_EQ(m(1, 3), 4);
  EXPECT_EQ(m(3, 1), 4);
  EXPECT_EQ(m(4, 4), 5);
  EXPECT_EQ(m(1, 2), 0);  // of two channels
  ArrowMatrix twice = m;
  twice += m;
  twice *= 10;
  EXPECT_EQ(twice(3, 1), 80);
}

TEST(ArrowMatrix, GivesTheRowsAndColumnsOfSomeUnknowns) {
  ArrowMatrix m(two_channels());
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t k = i; k < 5; ++k)
      if (m.layout().at(i, k) != ArrowLayout::none) m.add(i, k, static_cast<double>(10 * i + k));
  for (const std::vector<std::size_t>& some :
       {std::vector<std::size_t>{0, 2, 3, 4}, std::vector<std::size_t>{1, 2, 3, 4},
        std::vector<std::size_t>{4}, std::vector<std::size_t>{}}) {
    const auto layout = std::make_shared<const ArrowLayout>(m.layout().part(some));
    const ArrowMatrix part = m.part(layout, some);
    ASSERT_EQ(part.size(), some.size());
    for (std::size_t i = 0; i < some.size(); ++i)
      for (std::size_t k = 0; k < some.size(); ++k)
        EXPECT_EQ(part(i, k), m(some[i], some[k])) << some[i] << some[k];
  }
}

TEST(ArrowMatrix, GrowsLinearlyWithTheChannels) {
  const auto entries = [](std::size_t channels) {
    std::vector<std::vector<std::size_t>> arms;
    for (std::size_t c = 0; c < channels; ++c) arms.push_back({1 + 2 * c, 2 + 2 * c});
    return ArrowLayout({0}, arms).entries();
  };
  EXPECT_EQ(entries(4000) - entries(2000), entries(2000) - entries(0));
}

}  // namespace
}  // namespace gonio
