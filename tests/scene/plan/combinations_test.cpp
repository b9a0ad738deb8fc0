#include "scene/plan/combinations.h"

#include <set>

#include <gtest/gtest.h>

namespace gonio::scene {
namespace {

std::vector<Form> forms(std::initializer_list<int> numbers) {
  std::vector<Form> all;
  for (const int n : numbers) all.push_back(static_cast<Form>(n));
  return all;
}
FormsLeft left_of(std::initializer_list<std::size_t> sizes) {
  FormsLeft left;
  auto size = sizes.begin();
  for (auto& of_effect : left) {
    const std::size_t n = size == sizes.end() ? 1 : *size++;
    for (std::size_t i = 0; i < n; ++i) of_effect.push_back(static_cast<Form>(i));
  }
  return left;
}

TEST(Combinations, AreEachThereOnce) {
  const auto left = left_of({3, 2, 4});
  std::set<std::array<Form, effect_count>> all;
  for (const auto& f : combinations(left)) all.insert(f.form);
  EXPECT_EQ(all.size(), 24U);
  EXPECT_TRUE(all.contains({static_cast<Form>(2), static_cast<Form>(1), static_cast<Form>(3)}));
}

TEST(ThinOut, LeavesFewCombinationsAsTheyAre) {
  auto left = left_of({3, 4, 2});
  thin_out(left, {}, 24);
  EXPECT_EQ(left, left_of({3, 4, 2}));
}

TEST(ThinOut, TakesFormsBetweenTheEndsFirst) {
  auto left = left_of({3, 4, 2});
  thin_out(left, {1, 2, 3}, 12);
  EXPECT_EQ(left[0], forms({0, 2}));
  EXPECT_EQ(left[1], forms({0, 1, 3}));
  EXPECT_EQ(left[2], forms({0, 1}));
}

TEST(ThinOut, ThenLeavesExactWhatSavesLeast) {
  auto left = left_of({2, 3, 2, 1});
  thin_out(left, {5, 1, 2, 0}, 2);
  EXPECT_EQ(left[0], forms({0, 1}));
  EXPECT_EQ(left[1], forms({2}));
  EXPECT_EQ(left[2], forms({1}));
  EXPECT_EQ(left[3], forms({0}));
}

}  // namespace
}  // namespace gonio::scene
