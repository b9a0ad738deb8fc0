#include "reports/measure/machine.h"

#include <fstream>
#include <string_view>

#include "brdf/kernel/kernels.h"

#include <benchmark/benchmark.h>

namespace gonio {
namespace {

/// What Linux says of the first processor, "model name : AMD EPYC"; empty: nothing.
std::string cpu_says(std::string_view what) {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    const auto colon = line.find(": ");
    if (line.starts_with(what) && colon != line.npos) return line.substr(colon + 2);
  }
  return "";
}

}  // namespace

Machine this_machine() {
  const auto& cpu = benchmark::CPUInfo::Get();
  Machine m{cpu_says("model name"),
            static_cast<std::size_t>(cpu.num_cpus),
            {},
            instruction_sets(),
#ifdef __clang__
            "clang " __clang_version__,
#else
            "g++ " __VERSION__,
#endif
            GONIO_FLAGS,
            cpu_says("flags").find("avx512_fp16") != std::string::npos};
  for (const auto& c : cpu.caches)
    if (c.type != "Instruction")
      m.caches.push_back(
          {static_cast<std::size_t>(c.level), static_cast<std::size_t>(c.size), c.type});
  return m;
}

}  // namespace gonio
