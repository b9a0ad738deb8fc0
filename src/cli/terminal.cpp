#include "cli/terminal.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "base/file.h"
#include "cli/command.h"
#include "table/format/metadata.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/ioctl.h>
#include <tbb/global_control.h>
#include <unistd.h>

namespace gonio::cli {

Progress::Progress(bool quiet) : on_(!quiet && ::isatty(STDERR_FILENO) == 1) {}
Progress::~Progress() {
  clear();
}
void Progress::clear() {
  if (on_) std::fputs("\r\033[K", stderr);
}
void Progress::operator()(const std::string& what) {
  if (on_) fmt::print(stderr, "\r\033[K{} …", printable(what));
}

void print_document(const nlohmann::ordered_json& document) {
  fmt::print("{}\n", document.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
}

std::string time_left(std::chrono::steady_clock::time_point begin,
                      std::size_t done,
                      std::size_t all) {
  if (done == 0) return "";
  const std::chrono::duration<double> so_far = std::chrono::steady_clock::now() - begin;
  const auto left = static_cast<long>(
      std::ceil(so_far.count() / static_cast<double>(done) * static_cast<double>(all - done)));
  return fmt::format(", {}:{:02} left", left / 60, left % 60);
}

void TimedProgress::operator()(std::size_t done) {
  progress_(fmt::format("{} {} of {}{}", what_, done, all_, time_left(begin_, done, all_)));
}

namespace {

/// Columns of the terminal; without one, as many as there are.
std::size_t columns() {
  if (::isatty(STDOUT_FILENO) != 1) return std::string::npos;
  winsize size{};
  constexpr std::size_t usual = 80, least = 40;
  const bool known = ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? std::max<std::size_t>(size.ws_col, least) : usual;
}

/// Places on a line that UTF-8 takes.
std::size_t width(std::string_view text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

}  // namespace

void say_below(const std::string& head, const std::string& text) {
  const std::size_t most = columns();
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

void add_bins(Command& c, std::optional<std::string>& name) {
  c.option("--bins", name,
           "Where a sample sits in its bin: centre or edge (default: as the file says, or centre)")
      .one_of(names_of<Bins>);
}

void add_output(Command& c, Common& o) {
  c.flag("--json", o.json, "One JSON document on standard output");
  c.flag("--quiet", o.quiet, "No progress");
}

void add_jobs(Command& c, Common& o) {
  c.option("--jobs,-j", o.jobs, "Threads (default: all)").in(1, 4096);
}

void check_outputs(const std::vector<std::string>& inputs,
                   const std::vector<std::string>& outputs) {
  namespace fs = std::filesystem;
  const auto same = [](const std::string& a, const std::string& b) {
    std::error_code ignored;
    return fs::weakly_canonical(a, ignored) == fs::weakly_canonical(b, ignored);
  };
  std::ranges::for_each(inputs, expect_there);
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    if (outputs[i].empty()) continue;
    if (outputs[i] == "-")
      throw wrong_usage("'-' is no file to write; on standard output is what --json prints");
    for (const auto& in : inputs)
      if (same(outputs[i], in) || same(outputs[i], side_path(in)))
        throw wrong_usage(fmt::format("{} is an input; it would be overwritten", outputs[i]));
    for (std::size_t k = 0; k < i; ++k)
      if (!outputs[k].empty() && same(outputs[i], outputs[k]))
        throw wrong_usage(fmt::format("{} is named for two outputs", outputs[i]));
  }
}

void use_jobs(int jobs) {
  static std::unique_ptr<tbb::global_control> control;
  if (jobs > 0)
    control = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                    static_cast<std::size_t>(jobs));
}

}  // namespace gonio::cli
