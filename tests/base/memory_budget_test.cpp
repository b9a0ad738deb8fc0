#include "base/memory_budget.h"

#include <atomic>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace gonio {
namespace {

TEST(MemoryBudget, IsNeverExceededAndRunsEverything) {
  MemoryBudget budget(10);
  std::atomic<int> taken = 0, most = 0, ran = 0;
  std::vector<std::jthread> lanes;
  for (int i = 0; i < 12; ++i)
    lanes.emplace_back([&, needed = i == 0 ? 50 : 3] {
      const int counted = needed > 10 ? 10 : needed;
      budget.with(needed, [&] {
        const int now = taken += counted;
        for (int was = most; was < now && !most.compare_exchange_weak(was, now);) {
        }
        std::this_thread::yield();
        taken -= counted;
        ++ran;
      });
    });
  lanes.clear();
  EXPECT_EQ(ran, 12) << "one that needs more than there is has it alone";
  EXPECT_LE(most, 10);
}

TEST(MemoryBudget, IsGivenBackByWorkThatFails) {
  MemoryBudget budget(1);
  EXPECT_THROW(budget.with(1, [] { throw 1; }), int);
  bool ran = false;
  budget.with(1, [&] { ran = true; });
  EXPECT_TRUE(ran);
}

}  // namespace
}  // namespace gonio
