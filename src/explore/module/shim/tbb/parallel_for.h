#pragma once
// The part of oneTBB that gonio uses, on the one thread that a page has.
#include <algorithm>
#include <concepts>
#include <cstddef>
#include <functional>
#include <optional>
#include <utility>

namespace tbb {

struct task_group_context {
  enum kind { isolated, bound };
  task_group_context(kind = bound) {}
};
struct simple_partitioner {};
struct static_partitioner {};

template <class T>
class blocked_range {
 public:
  blocked_range(T begin, T end, std::size_t grain = 1) : begin_(begin), end_(end), grain_(grain) {}
  T begin() const { return begin_; }
  T end() const { return end_; }
  std::size_t size() const { return static_cast<std::size_t>(end_ - begin_); }
  std::size_t grainsize() const { return grain_; }
  bool empty() const { return !(begin_ < end_); }

 private:
  T begin_, end_;
  std::size_t grain_;
};

template <class I, class Body, class... Rest>
requires std::invocable<const Body&, I>
void parallel_for(I first, I last, const Body& body, Rest&&...) {
  for (I i = first; i < last; ++i) body(i);
}
/// In parts of the grain: bodies may allocate by the size of a part.
template <class T, class Body, class... Rest>
void parallel_for(const blocked_range<T>& all, const Body& body, Rest&&...) {
  const T step = static_cast<T>(std::max<std::size_t>(all.grainsize(), 1024));
  for (T at = all.begin(); at < all.end(); at += step)
    body(blocked_range<T>(at, std::min(all.end(), at + step), all.grainsize()));
}
template <class Range, class Value, class Body, class Join, class... Rest>
Value parallel_reduce(
    const Range& all, const Value& identity, const Body& body, const Join&, Rest&&...) {
  return body(all, identity);
}
template <class Range, class... Less>
void parallel_sort(Range& all, const Less&... less) {
  std::sort(all.begin(), all.end(), less...);
}

/// One value, made where it is first asked for.
template <class T>
class enumerable_thread_specific {
 public:
  enumerable_thread_specific() requires std::default_initializable<T>
      : make_([](std::optional<T>& one) { one.emplace(); }) {}
  template <class Make>
  requires std::invocable<Make&>
  explicit enumerable_thread_specific(Make make)
      : make_([make](std::optional<T>& one) mutable { one.emplace(Made<Make>{make}); }) {}
  T& local() {
    if (!one_) make_(one_);
    return *one_;
  }
  T* begin() { return one_ ? &*one_ : nullptr; }
  T* end() { return one_ ? &*one_ + 1 : nullptr; }

 private:
  /// Makes in place what can be neither copied nor moved.
  template <class Make>
  struct Made {
    Make& make;
    operator T() const { return make(); }
  };
  std::function<void(std::optional<T>&)> make_;
  std::optional<T> one_;
};

class task_group {
 public:
  template <class Body>
  void run(const Body& body) {
    body();
  }
  void wait() {}
};

namespace this_task_arena {
inline int max_concurrency() {
  return 1;
}
}

}  // namespace tbb
