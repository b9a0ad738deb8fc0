#pragma once
/// \file
/// What a person at a terminal sees.

#include <string>

namespace gonio::cli {

/// One line on stderr that says what is being done, only if stderr is a terminal.
class Progress {
 public:
  explicit Progress(bool quiet);
  ~Progress();
  void operator()(const std::string& what);
  /// Takes the line away, before something is printed.
  void clear();

 private:
  bool on_;
};

/// "0.15003 ± 0.00012": as many digits as the error leaves; "0.15" if the error is unknown.
std::string with_error(double value, double error);

}  // namespace gonio::cli
