#pragma once
/// \file
/// What reading a file says.

#include <string>

#include "base/error.h"
#include "support.h"
#include "table/format/formats.h"

#include <sys/mman.h>
#include <unistd.h>

namespace gonio::test {

/// "" if it reads; else one line with bad_input's exit code.
inline std::string complaint(const std::string& path) {
  try {
    read_table(path);
    return "";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), Exit::bad_input);
    EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
    return e.what();
  }
}
/// Of bytes, through a file that no disk is asked for: thousands a second.
inline std::string complaint_about(const std::string& bytes) {
  static const int file = ::memfd_create("gonio-test", 0);
  EXPECT_EQ(::ftruncate(file, 0), 0);
  EXPECT_EQ(::pwrite(file, bytes.data(), bytes.size(), 0), static_cast<ssize_t>(bytes.size()));
  return complaint("/proc/self/fd/" + std::to_string(file));
}
#define EXPECT_COMPLAINT(path, part) \
  EXPECT_NE(complaint(path).find(part), std::string::npos) << "instead: " << complaint(path)

}  // namespace gonio::test
