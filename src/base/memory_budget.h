#pragma once
/// \file
/// Memory that works share which go on at once.

#include <algorithm>
#include <condition_variable>
#include <memory>
#include <mutex>

namespace gonio {

/// Memory that the process may take [bytes].
double memory_allowed();

/// Memory that works share which go on at once.
class MemoryBudget {
 public:
  explicit MemoryBudget(double bytes) : all_(bytes), left_(bytes) {}
  /// Runs a work that needs so much; it waits while others have that.  One that needs more than there is has it all, alone.
  template <class Work>
  void with(double bytes, Work&& work) {
    const double taken = std::min(bytes, all_);
    {
      std::unique_lock lock(mutex_);
      freed_.wait(lock, [&] { return left_ >= taken; });
      left_ -= taken;
    }
    const auto give_back = [&](void*) {
      {
        const std::lock_guard lock(mutex_);
        left_ += taken;
      }
      freed_.notify_all();
    };
    const std::unique_ptr<void, decltype(give_back)> at_the_end(this, give_back);
    work();
  }

 private:
  const double all_;
  double left_;
  std::mutex mutex_;
  std::condition_variable freed_;
};

}  // namespace gonio
