#include "base/whole_loop.h"

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

namespace gonio {
namespace {

/// do_it() on four threads, however many cores there are.
template <class Do>
void on_four_threads(const Do& do_it) {
  const tbb::global_control four(tbb::global_control::max_allowed_parallelism, 4);
  tbb::task_arena(4).execute(do_it);
}

/// Waits until so many have come.  One thread alone never would: it gives up, and the test sees that.
void meet(std::atomic<int>& here, int count) {
  ++here;
  for (int k = 0; here < count && k < 100'000'000; ++k) std::this_thread::yield();
}

TEST(WholeLoop, CallsEachOnce) {
  std::vector<int> calls(1000);
  for_each_whole(calls.size(), [&](std::size_t i) { ++calls[i]; });
  EXPECT_EQ(calls, std::vector<int>(1000, 1));
  for_each_whole(0, [](std::size_t) { FAIL(); });
}

TEST(WholeLoop, ThrowsWhatTheLowestThrewThoughItIsTheLast) {
  for (int again = 0; again < 20; ++again)
    on_four_threads([] {
      std::atomic<int> here = 0, gone = 0;
      try {
        for_each_whole(2, [&](std::size_t i) {
          meet(here, 2);
          if (i == 1) {
            ++gone;
            throw std::runtime_error("1");
          }
          meet(gone, 2);
          for (int k = 0; k < 1000; ++k) std::this_thread::yield();
          throw std::runtime_error("0");
        });
        FAIL();
      } catch (const std::runtime_error& e) {
        EXPECT_STREQ(e.what(), "0");
      }
    });
}

TEST(WholeLoop, LeavesLoopsWithinItWholeWhereAnotherBodyThrows) {
  on_four_threads([] {
    std::atomic<int> here = 0, gone = 0;
    std::vector<int> filled(10'000);
    EXPECT_THROW(for_each_whole(2,
                                [&](std::size_t i) {
                                  meet(here, 2);
                                  if (i == 1) {
                                    ++gone;
                                    throw std::runtime_error("one");
                                  }
                                  meet(gone, 2);
                                  tbb::parallel_for(std::size_t{0}, filled.size(),
                                                    [&](std::size_t k) { filled[k] = 1; });
                                }),
                 std::runtime_error);
    EXPECT_EQ(std::ranges::count(filled, 1), 10'000);
  });
}

TEST(WholeLoop, IsWholeWhereALoopAroundItIsCancelled) {
  on_four_threads([] {
    std::vector<int> filled(10'000);
    tbb::task_group_context around;
    tbb::parallel_for(
        0, 1,
        [&](int) {
          around.cancel_group_execution();
          for_each_whole(filled.size(), [&](std::size_t k) { filled[k] = 1; });
        },
        around);
    EXPECT_EQ(std::ranges::count(filled, 1), 10'000);
  });
}

}  // namespace
}  // namespace gonio
