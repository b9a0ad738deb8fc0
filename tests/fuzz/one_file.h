#pragma once
/// \file
/// Any bytes as a file that a reader is given: it reads them or says bad_input in one line, and nothing else happens.

#include <cstdint>
#include <cstdlib>
#include <string>

#include "base/error.h"

#include <sys/mman.h>
#include <unistd.h>

namespace gonio::fuzz {

/// \param read  takes the file's path
template <class Read>
int read_as_file(const std::uint8_t* data, std::size_t size, Read&& read) {
  static const int file = ::memfd_create("input", 0);
  static const std::string path = "/proc/self/fd/" + std::to_string(file);
  if (::ftruncate(file, 0) != 0 || ::pwrite(file, data, size, 0) != static_cast<ssize_t>(size))
    std::abort();
  try {
    read(path);
  } catch (const Error& e) {
    if (e.code() != Exit::bad_input || std::string(e.what()).find('\n') != std::string::npos)
      std::abort();
  }
  return 0;
}

}  // namespace gonio::fuzz
