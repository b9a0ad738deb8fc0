#include "table/health/key_counts.h"

#include <map>

#include <gtest/gtest.h>

namespace gonio {
namespace {

/// Keys of which number k occurs k % 12 times, spread over the list.
std::vector<AngleKey<3>> keys_of(long different) {
  std::vector<AngleKey<3>> keys;
  for (long times = 1; times < 12; ++times)
    for (long k = 0; k < different; ++k)
      if (k % 12 >= times) keys.push_back({k % 7, 1'000'000 * k, -k});
  return keys;
}

TEST(KeyCounts, FindEachKeyThatOccursOftenAndHardlyAnother) {
  const auto keys = keys_of(60'000);
  const auto hashes = hashes_of(keys.size(), [&](std::size_t i) { return keys[i]; });
  std::map<AngleKey<3>, std::size_t> times;
  for (const auto& k : keys) ++times[k];
  for (const std::size_t least : {2, 9}) {
    std::vector<bool> found(keys.size());
    for (const std::size_t i : KeyCounts(hashes).among(hashes, least)) found[i] = true;
    std::size_t missed = 0, wrong = 0;
    for (std::size_t i = 0; i < keys.size(); ++i) {
      const bool often = times[keys[i]] >= least;
      missed += often && !found[i];
      wrong += !often && found[i];
    }
    EXPECT_EQ(missed, 0U);
    EXPECT_LT(wrong, keys.size() / 20) << least;
  }
}

TEST(KeyCounts, OfOtherKeysFindThoseThatBothHave) {
  const auto hashes_from = [](long first) {
    return hashes_of(1000, [=](std::size_t i) {
      return AngleKey<2>{first + static_cast<long>(i), 5};
    });
  };
  const auto found = KeyCounts(hashes_from(0)).among(hashes_from(900), 1);
  ASSERT_GE(found.size(), 100U);
  EXPECT_LT(found.size(), 500U);
  for (std::size_t i = 0; i < 100; ++i) EXPECT_EQ(found[i], i);
}

TEST(KeyCounts, OfAKeyThatEachHasStayAtTheirMost) {
  const auto hashes = hashes_of(70'000, [](std::size_t) { return AngleKey<1>{42}; });
  EXPECT_EQ(KeyCounts(hashes).among(hashes, 255).size(), hashes.size());
}

}  // namespace
}  // namespace gonio
