#pragma once
/// \file
/// Loops on all threads whose bodies hold loops of their own, and may throw.

#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>

#include <tbb/parallel_for.h>
#include <tbb/task_group.h>

namespace gonio {

/// Calls one(i) for each i < n on all threads.  Throws what the lowest i threw, whatever the threads; of those above it some are
/// left out.
///
/// A body of tbb::parallel_for that throws cancels all that runs below that loop: loops within the other bodies then end early and
/// in silence, and who reads their results reads what was never written.  Here no exception leaves a body before all that have begun
/// are at their end, and no loop around this one ends it early.
template <class One>
void for_each_whole(std::size_t n, const One& one) {
  std::atomic<std::size_t> lowest = n;  // that threw
  std::mutex mutex;
  std::exception_ptr error;
  tbb::task_group_context own(tbb::task_group_context::isolated);
  const auto guarded = [&](std::size_t i) {
    if (i > lowest) return;
    try {
      one(i);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (i >= lowest) return;
      lowest = i;
      error = std::current_exception();
    }
  };
  tbb::parallel_for(std::size_t{0}, n, guarded, own);
  if (error) std::rethrow_exception(error);
}

}  // namespace gonio
