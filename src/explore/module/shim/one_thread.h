#pragma once
// Read before every file: libc++ for WASI is built without threads, and then has no mutex.
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
}
#endif
#endif
#endif
