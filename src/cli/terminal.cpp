#include "cli/terminal.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "cli/command.h"

namespace gonio::cli {

Progress::Progress(bool quiet) : on_(!quiet && ::isatty(STDERR_FILENO) == 1) {}
Progress::~Progress() { clear(); }
void Progress::clear() {
  if (on_) std::fputs("\r\033[K", stderr);
}
void Progress::operator()(const std::string& what) {
  if (on_) fmt::print(stderr, "\r\033[K{} …", what);
}

std::string with_error(double value, double error) {
  if (std::isnan(value)) return "–";
  if (std::isnan(error)) return fmt::format("{:.6g}", value);
  if (!(error > 0)) return fmt::format("{:.10g} ± 0", value);
  const int digits = std::clamp(1 - static_cast<int>(std::floor(std::log10(error))), 0, 15);
  if (digits == 15) return fmt::format("{:.12g} ± {:.1e}", value, error);
  return fmt::format("{:.{}f} ± {:.{}f}", value, digits, error, digits);
}

void add_jobs(CLI::App* c, int& jobs) {
  c->add_option("--jobs,-j", jobs, "Threads (default: all)")->check(CLI::Range(1, 4096));
}

void use_jobs(int jobs) {
  static std::unique_ptr<tbb::global_control> control;
  if (jobs > 0)
    control = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                    static_cast<std::size_t>(jobs));
}

}  // namespace gonio::cli
