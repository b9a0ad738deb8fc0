#include "cli/line/terminal.h"

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <cstdio>
#include <memory>
#include <mutex>
#include <stop_token>
#include <thread>

#include "base/file.h"
#include "base/json/reader.h"
#include "base/numbers.h"
#include "cli/line/command.h"
#include "table/format/metadata.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/ioctl.h>
#include <tbb/global_control.h>
#include <unistd.h>

namespace gonio::cli {

namespace {

/// Columns of the terminal that a stream is; of none, as many as there are.
std::size_t columns(int stream) {
  if (::isatty(stream) != 1) return std::string::npos;
  winsize size{};
  constexpr std::size_t usual = 80, least = 40;
  const bool known = ::ioctl(stream, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? std::max<std::size_t>(size.ws_col, least) : usual;
}

/// True of a byte that begins a character in UTF-8, each taken for one place on a line.
bool begins(char c) {
  return (c & 0xC0) != 0x80;
}
std::size_t width(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count_if(text, begins));
}

/// Beginning of a text that has room in so many places.
std::string_view beginning(std::string_view text, std::size_t places) {
  std::size_t seen = 0, end = 0;
  while (end < text.size() && (!begins(text[end]) || seen++ < places)) ++end;
  return text.substr(0, end);
}

std::string minutes(long seconds) {
  return fmt::format("{}:{:02}", seconds / 60, seconds % 60);
}

}  // namespace

/// The line, and the thread that keeps its clock.
class Progress::Line {
 public:
  Line() : clock_([this](const std::stop_token& stop) { keep_time(stop); }) {}
  void show(const std::string& what) {
    const std::lock_guard lock(mutex_);
    what_ = printable(what);
    since_ = {};
    write(what_ + " …");
  }
  void clear() {
    const std::lock_guard lock(mutex_);
    what_.clear();
    write("");
  }

 private:
  void keep_time(const std::stop_token& stop) {
    constexpr double long_enough = 2;
    std::unique_lock lock(mutex_);
    while (!stop.stop_requested()) {
      wake_.wait_for(lock, stop, std::chrono::seconds(1), [] { return false; });
      const double took = since_.seconds();
      if (!what_.empty() && took >= long_enough)
        write(fmt::format("{} … {}", what_, minutes(static_cast<long>(took))));
    }
  }
  /// In one line: what goes on in the next stays there.
  static void write(const std::string& text) {
    const std::string line = "\r\033[K" + std::string(beginning(text, columns(STDERR_FILENO) - 1));
    std::fputs(line.c_str(), stderr);
  }

  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::string what_;  ///< empty where there is no line
  Stopwatch since_;
  std::jthread clock_;  // ends before what it reads
};

Progress::Progress(bool quiet) {
  if (!quiet && ::isatty(STDERR_FILENO) == 1) line_ = std::make_unique<Line>();
}
Progress::~Progress() {
  clear();
}
void Progress::clear() {
  if (line_) line_->clear();
}
void Progress::operator()(const std::string& what) {
  if (line_) line_->show(what);
}

void print_document(const nlohmann::ordered_json& document) {
  fmt::print("{}", gonio::text_of(document));
}

std::string time_left(const Stopwatch& begin, std::size_t done, std::size_t all) {
  if (done == 0) return "";
  const auto left = static_cast<long>(
      std::ceil(begin.seconds() / static_cast<double>(done) * static_cast<double>(all - done)));
  return fmt::format(", {} left", minutes(left));
}

void TimedProgress::operator()(std::size_t done) {
  progress_(fmt::format("{} {} of {}{}", what_, done, all_, time_left(begin_, done, all_)));
}

void say_below(const std::string& head, const std::string& text) {
  const std::size_t most = columns(STDOUT_FILENO);
  std::string line = head;
  const std::size_t indent = width(head) < most / 2 ? width(head) : 8;
  bool empty = true;
  for (const auto& word : split(text, ' ')) {
    if (!empty && width(line) + 1 + width(word) > most) {
      say("{}\n", line);
      line = std::string(indent, ' ');
      empty = true;
    }
    if (!empty) line += ' ';
    line += word;
    empty = false;
  }
  say("{}\n", line);
}

std::string percent(double share) {
  return fmt::format("{:.3g} %", 100 * share);
}
std::string percent(std::size_t part, std::size_t whole) {
  return percent(whole ? static_cast<double>(part) / static_cast<double>(whole) : 0);
}

std::string with_error(double value, double error, double low, double high) {
  if (std::isnan(value)) return "–";
  if (std::isnan(error)) return fmt::format("{:.6g}", value);
  if (!(error > 0)) return fmt::format("{:.10g} ± 0", value);
  const double below = value - low, above = high - value;
  // Of few values an interval is wider than the error says, and at the end of a range it is cut.
  constexpr double uneven = 1.5, least = 1.9, most = 2.8, seen = 1e-3;
  const auto [narrow, wide] = std::minmax(below, above);
  if (wide > seen * std::abs(value) &&
      (wide > std::min(uneven * narrow, most * error) || narrow < least * error))
    return fmt::format("{:.3g} (95 %: {:.3g} to {:.3g})", value,
                       low < 1e-6 * high && low > 0 ? 0.0 : low, high);
  const int digits = std::clamp(1 - static_cast<int>(std::floor(std::log10(error))), 0, 15);
  if (digits == 15) return fmt::format("{:.12g} ± {:.1e}", value, error);
  return fmt::format("{:.{}f} ± {:.{}f}", value, digits, error, digits);
}

void add_set(Command& c, std::vector<std::string>& words) {
  c.option("--set", words, "Parameters: NAME=VALUE …; a colour is one number or r,g,b").at_most(64);
}

void add_bins(Command& c, std::optional<Bins>& bins) {
  c.option("--bins", bins,
           "Where a sample sits in its bin: centre or edge (default: as the file says, or centre)");
}

std::array<std::size_t, 2> two_numbers(const std::string& word,
                                       const char* option,
                                       std::size_t low,
                                       std::size_t high,
                                       bool one_for_both) {
  auto parts = split(word, ',');
  if (parts.size() == 1 && one_for_both) parts.push_back(parts[0]);
  std::array<std::size_t, 2> numbers{};
  for (std::size_t k = 0; k < 2; ++k) {
    const auto n = parts.size() == 2 ? number_from<std::size_t>(parts[k]) : std::nullopt;
    if (!n || *n < low || *n > high)
      throw wrong_usage(fmt::format("{} {}: two whole numbers as 3,4, each from {} to {}", option,
                                    word, low, high));
    numbers[k] = *n;
  }
  return numbers;
}

void add_output(Command& c, Common& o) {
  c.flag("--json", o.json, "One JSON document on standard output");
  c.flag("--quiet", o.quiet, "No progress");
}

void add_follow_paths(Command& c, Common& o) {
  c.flag("--follow-paths", o.follow_paths,
         "Documents may name files outside their folder: of those whom you trust");
}

void add_jobs(Command& c, Common& o) {
  c.option("--jobs,-j", o.jobs, "Threads (default: all)").in(1, 4096);
}

void check_outputs(const std::vector<std::string>& inputs,
                   const std::vector<std::string>& outputs) {
  for (const auto& in : inputs) {
    expect_there(in);
    will_read(in);
    will_read(side_path(in));
  }
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    if (outputs[i].empty()) continue;
    if (outputs[i] == "-")
      throw wrong_usage("'-' is no file to write; on standard output is what --json prints");
    expect_no_input(outputs[i]);
    for (std::size_t k = 0; k < i; ++k)
      if (!outputs[k].empty() && same_place(outputs[i], outputs[k]))
        throw wrong_usage(fmt::format("{} is named for two outputs", outputs[i]));
  }
}

void use(const Common& o) {
  static std::unique_ptr<tbb::global_control> control;
  if (o.jobs > 0)
    control = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                    static_cast<std::size_t>(o.jobs));
  if (o.follow_paths) follow_paths();
}

int threads_in_use() {
  return static_cast<int>(
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

}  // namespace gonio::cli
