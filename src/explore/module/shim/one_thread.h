#pragma once
// Read before every file: libc++ for WASI is built without threads, and then has neither of these.
#ifdef __cplusplus
#include <version>
#ifdef _LIBCPP_HAS_THREADS
#if !_LIBCPP_HAS_THREADS
#include <mutex>
namespace std {
struct mutex {
  void lock() {}
  void unlock() {}
  bool try_lock() { return true; }
};
struct thread {
  thread() = default;
  template <class Body>
  explicit thread(const Body& body) {
    body();
  }
  bool joinable() const { return false; }
  void join() {}
};
}
#endif
#endif
#endif
