#pragma once
/// \file
/// What reading a file says.

#include <string>

#include "refusal.h"
#include "support.h"
#include "table/format/formats.h"

#include <sys/mman.h>
#include <unistd.h>

namespace gonio::test {

/// Line that a file is refused with; "" of one that is read.
inline std::string complaint(const std::string& path) {
  return refusal([&] { read_table(path); });
}
/// Of bytes, through a file that no disk is asked for: thousands a second.
inline std::string complaint_about(const std::string& bytes) {
  static const int file = ::memfd_create("gonio-test", 0);
  EXPECT_EQ(::ftruncate(file, 0), 0);
  EXPECT_EQ(::pwrite(file, bytes.data(), bytes.size(), 0), static_cast<ssize_t>(bytes.size()));
  return complaint("/proc/self/fd/" + std::to_string(file));
}
#define EXPECT_COMPLAINT(path, part) EXPECT_HAS(complaint(path), part)

}  // namespace gonio::test
