#include "reports/measure/machine.h"

#include <filesystem>
#include <fstream>
#include <string_view>
#include <thread>

#include "brdf/kernel/kernels.h"

#include <fmt/format.h>

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

/// Caches of the first processor for data, as Linux lists them; their sizes read "48K".
std::vector<Machine::Cache> data_caches() {
  std::vector<Machine::Cache> out;
  for (int i = 0;; ++i) {
    const std::filesystem::path at = fmt::format("/sys/devices/system/cpu/cpu0/cache/index{}", i);
    Machine::Cache c{};
    std::size_t size = 0;
    char unit = 0;
    if (!(std::ifstream(at / "level") >> c.level)) return out;
    if (!(std::ifstream(at / "type") >> c.type) || c.type == "Instruction") continue;
    if (!(std::ifstream(at / "size") >> size >> unit)) continue;
    c.bytes = size << (unit == 'M' ? 20 : unit == 'K' ? 10 : 0);
    out.push_back(c);
  }
}

}  // namespace

Machine this_machine() {
  return {cpu_says("model name"),
          std::thread::hardware_concurrency(),
          data_caches(),
          instruction_sets(),
#ifdef __clang__
          "clang " __clang_version__,
#else
          "g++ " __VERSION__,
#endif
          GONIO_FLAGS,
          cpu_says("flags").find("avx512_fp16") != std::string::npos};
}

}  // namespace gonio
