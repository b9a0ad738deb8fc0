#pragma once
/// \file
/// Output as a person at a terminal sees it.

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>

#include "base/stopwatch.h"
#include "base/text.h"

#include <fmt/format.h>
#include <nlohmann/json_fwd.hpp>

namespace gonio::cli {

/// One line on stderr that says what is being done, only if stderr is a terminal.  What takes longer than two
/// seconds is told with its time, which goes on by itself: "solving … 0:12".
class Progress {
 public:
  explicit Progress(bool quiet);
  ~Progress();
  void operator()(const std::string& what);
  /// Takes the line away, before something is printed.
  void clear();

 private:
  class Line;
  std::unique_ptr<Line> line_;  ///< none where nothing is shown
};

/// Argument of say(): text, whose may be a file's, is made printable; all else stays.
template <class T>
using Said =
    std::conditional_t<std::is_convertible_v<const T&, std::string_view>, std::string, const T&>;

/// Lines for a person on standard output.  Only the format itself can move a terminal's cursor.
template <class... T>
void say(fmt::format_string<Said<T>...> format, const T&... arguments) {
  [[maybe_unused]] const auto harmless = []<class A>(const A& a) -> Said<A> {
    if constexpr (std::is_same_v<Said<A>, std::string>)
      return printable(a);
    else
      return a;
  };
  fmt::print(format, harmless(arguments)...);
}

/// The one document that --json puts on standard output; bytes that are no text are replaced.
void print_document(const nlohmann::ordered_json&);

/// Time still needed if the rest goes as what was done: ", 1:05 left"; empty before the
/// first is done.
std::string time_left(const Stopwatch& begin, std::size_t done, std::size_t all);

/// "auditing 12 of 70, 0:08 left"
class TimedProgress {
 public:
  TimedProgress(bool quiet, std::string what, std::size_t all)
      : progress_(quiet), what_(std::move(what)), all_(all) {
    (*this)(0);
  }
  void operator()(std::size_t done);
  void clear() { progress_.clear(); }

 private:
  Progress progress_;
  std::string what_;
  std::size_t all_;
  Stopwatch begin_;
};

/// Line that begins with `head`; at a terminal that is too narrow for it `text` goes on below itself.
void say_below(const std::string& head, const std::string& text);

/// "12.5 %"
std::string percent(double share);
std::string percent(std::size_t part, std::size_t whole);

/// "0.15003 ± 0.00012": as many digits as the error leaves; "0.15" if the error is unknown;
/// "0.12 (95 %: 0 to 0.38)" where the interval is not that of the error.
std::string with_error(double value, double error, double low, double high);

}  // namespace gonio::cli
