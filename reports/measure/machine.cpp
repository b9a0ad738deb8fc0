#include "reports/measure/machine.h"

#include <fstream>
#include <string_view>

#include "brdf/kernel/kernels.h"

#include <benchmark/benchmark.h>

namespace gonio {
namespace {

/// "model name : AMD EPYC", of Linux
std::string cpu_name() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    const auto colon = line.find(": ");
    if (line.starts_with("model name") && colon != line.npos) return line.substr(colon + 2);
  }
  return "";
}

}  // namespace

Machine this_machine() {
  const auto& cpu = benchmark::CPUInfo::Get();
  Machine m{cpu_name(),
            static_cast<std::size_t>(cpu.num_cpus),
            {},
            instruction_sets(),
#ifdef __clang__
            "clang " __clang_version__,
#else
            "g++ " __VERSION__,
#endif
            GONIO_FLAGS};
  for (const auto& c : cpu.caches)
    if (c.type != "Instruction")
      m.caches.push_back(
          {static_cast<std::size_t>(c.level), static_cast<std::size_t>(c.size), c.type});
  return m;
}

}  // namespace gonio
