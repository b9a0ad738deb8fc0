#include "scene/plan/combinations.h"

#include <set>

#include <gtest/gtest.h>

namespace gonio::scene {
namespace {

FormsLeft left_of(std::initializer_list<std::size_t> sizes) {
  FormsLeft left;
  auto size = sizes.begin();
  for (auto& forms : left) {
    const std::size_t n = size == sizes.end() ? 1 : *size++;
    for (std::size_t i = 0; i < n; ++i) forms.push_back(i);
  }
  return left;
}

TEST(Combinations, AreEachThereOnce) {
  const auto left = left_of({3, 2, 4});
  std::set<std::array<std::size_t, effect_count>> all;
  for (const auto& f : combinations(left)) all.insert(f.form);
  EXPECT_EQ(all.size(), 24U);
  EXPECT_TRUE(all.contains({2, 1, 3}));
}

TEST(ThinOut, LeavesFewCombinationsAsTheyAre) {
  auto left = left_of({3, 4, 2});
  thin_out(left, {}, 24);
  EXPECT_EQ(left, left_of({3, 4, 2}));
}

TEST(ThinOut, TakesFormsBetweenTheEndsFirst) {
  auto left = left_of({3, 4, 2});
  thin_out(left, {1, 2, 3}, 12);
  EXPECT_EQ(left[0], (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(left[1], (std::vector<std::size_t>{0, 1, 3}));
  EXPECT_EQ(left[2], (std::vector<std::size_t>{0, 1}));
}

TEST(ThinOut, ThenLeavesExactWhatSavesLeast) {
  auto left = left_of({2, 3, 2, 1});
  thin_out(left, {5, 1, 2, 0}, 2);
  EXPECT_EQ(left[0], (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(left[1], (std::vector<std::size_t>{2}));
  EXPECT_EQ(left[2], (std::vector<std::size_t>{1}));
  EXPECT_EQ(left[3], (std::vector<std::size_t>{0}));
}

}  // namespace
}  // namespace gonio::scene
