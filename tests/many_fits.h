#pragma once
/// \file
/// Tests of so many fits, or so long integrals, that a sanitizer would take minutes over them.

#include <cstddef>

#include <gtest/gtest.h>

#ifdef __SANITIZE_ADDRESS__
#define GONIO_MANY_FITS() \
  GTEST_SKIP() << "minutes under a sanitizer; its numbers are looked at without one"
#else
#define GONIO_MANY_FITS() static_cast<void>(0)
#endif

namespace gonio::test {

/// Number of cases that a test looks at: all, or the few by which a sanitizer walks the same code.
constexpr std::size_t few([[maybe_unused]] std::size_t all,
                          [[maybe_unused]] std::size_t sanitized = 1) {
#ifdef __SANITIZE_ADDRESS__
  return sanitized;
#else
  return all;
#endif
}

}  // namespace gonio::test
