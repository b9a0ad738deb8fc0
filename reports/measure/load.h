#pragma once
/// \file
/// Work of other programs while something is timed, which makes it take longer.

#include <cstddef>
#include <optional>
#include <string>

#include "base/stopwatch.h"

namespace gonio {

/// Time that the processors worked for all programs but this one and those that it started and waited for.
class OthersWork {
 public:
  OthersWork();
  /// Processors that it kept busy since the construction, on average; no value where the system does not tell.
  std::optional<double> processors() const;

 private:
  struct Seconds {
    double all, own;
  };
  static std::optional<Seconds> worked();

  std::optional<Seconds> before_;
  Stopwatch begin_;
};

/// Sentence that says that others worked meanwhile; empty where they kept less than a quarter of a processor busy, or
/// nothing is known of them.
std::string load_text(std::optional<double> others, std::size_t threads);

}  // namespace gonio
