#pragma once
/// \file
/// Locks of files that were asked for in vain: flock in place of the library's, as src/base calls it.  For one file of a program.

#include <sys/file.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace gonio::test {

inline int refused_locks = 0;  ///< that another had

}  // namespace gonio::test

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wshadow"  // a structure has that name, too
extern "C" int flock(int file, int how) noexcept {
  const auto status = static_cast<int>(::syscall(SYS_flock, file, how));
  if (status != 0) ++gonio::test::refused_locks;
  return status;
}
#pragma GCC diagnostic pop
