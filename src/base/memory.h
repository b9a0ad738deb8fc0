#pragma once
/// \file
/// Memory for large arrays.

#include <cstddef>
#include <new>
#include <utility>

namespace gonio {

/// 64-byte aligned, not filled: its pages are first touched by whoever writes them, on all threads.
/// From 4 MB on in huge pages where the system has them, which a program that fills an array once
/// spends a third of the time on.  Throws std::bad_alloc.
void* allocate_array(std::size_t bytes);
void free_array(void*) noexcept;

/// A vector's allocator on allocate_array(): elements without a value are not filled.
template <class T>
struct ArrayAllocator {
  using value_type = T;
  ArrayAllocator() = default;
  template <class U>
  ArrayAllocator(const ArrayAllocator<U>&) {}  // NOLINT: allocators convert

  T* allocate(std::size_t n) {
    if (n > static_cast<std::size_t>(-1) / sizeof(T)) throw std::bad_array_new_length();
    return static_cast<T*>(allocate_array(n * sizeof(T)));
  }
  void deallocate(T* p, std::size_t) noexcept { free_array(p); }
  template <class U>
  void construct(U* p) {
    ::new (static_cast<void*>(p)) U;
  }
  template <class U, class... Arguments>
  void construct(U* p, Arguments&&... a) {
    ::new (static_cast<void*>(p)) U(std::forward<Arguments>(a)...);
  }
  bool operator==(const ArrayAllocator&) const = default;
};

}  // namespace gonio
