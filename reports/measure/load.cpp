#include "reports/measure/load.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <string>

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

namespace gonio {
namespace {

double seconds_of(int who) {
  rusage used{};
  if (::getrusage(who, &used) != 0) return 0;
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

}  // namespace

std::optional<OthersWork::Seconds> OthersWork::worked() {
  // "cpu  user nice system idle iowait irq softirq steal …", in ticks
  std::ifstream in("/proc/stat");
  std::string cpu;
  std::array<double, 8> ticks{};
  if (!(in >> cpu) || cpu != "cpu") return {};
  for (double& t : ticks)
    if (!(in >> t)) return {};
  const auto [user, nice, system, idle, iowait, irq, softirq, steal] = ticks;
  const double all = user + nice + system + irq + softirq + steal;
  return Seconds{all / static_cast<double>(::sysconf(_SC_CLK_TCK)),
                 seconds_of(RUSAGE_SELF) + seconds_of(RUSAGE_CHILDREN)};
}

OthersWork::OthersWork() : before_(worked()) {}

std::optional<double> OthersWork::processors() const {
  const auto now = worked();
  const double passed = begin_.seconds();
  if (!before_ || !now || passed <= 0) return {};
  const double others = (now->all - before_->all) - (now->own - before_->own);
  return std::max(0.0, others / passed);
}

std::string load_text(std::optional<double> others, std::size_t threads) {
  constexpr double told_from = 0.25;
  if (!others || *others < told_from) return {};
  return fmt::format(
      "Other programs kept {:.1f} of the {} processors busy meanwhile: times are longer than on a "
      "quiet machine.",
      *others, threads);
}

}  // namespace gonio
