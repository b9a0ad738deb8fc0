#pragma once
/// \file
/// The machine and the build that something is measured with.

#include <cstddef>
#include <string>
#include <vector>

namespace gonio {

struct Machine {
  std::string cpu;      ///< as it calls itself; empty where it does not
  std::size_t threads;  ///< that run at once
  struct Cache {
    std::size_t level, bytes;
    std::string type;  ///< "Data", "Unified"
  };
  std::vector<Cache> caches;                  ///< without those of instructions
  std::vector<std::string> instruction_sets;  ///< of the kernels that run here, the plainest first
  std::string compiler, flags;
  bool native_half = false;  ///< arithmetic in half, AVX512-FP16, which no kernel uses
};
Machine this_machine();

}  // namespace gonio
