// Picks the instruction set at run time.
#include "base/error.h"
#include "brdf/kernels.h"

namespace gonio {

#define GONIO_SET(set)                       \
  namespace set {                            \
  extern const Kernels<float> table_float;   \
  extern const Kernels<double> table_double; \
  }
#include "instruction_sets.inc"
#undef GONIO_SET

namespace {

struct Set {
  const Kernels<float>* f;
  const Kernels<double>* d;
};
// In the order of the build's list: the best last.
constexpr Set sets[] = {
#define GONIO_SET(set) {&set::table_float, &set::table_double},
#include "instruction_sets.inc"
#undef GONIO_SET
};

bool runs_here(std::string_view set) {
#if defined(__x86_64__)
  if (set == "avx2") return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (set == "avx512")
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd") &&
           __builtin_cpu_supports("avx512vl");
#endif
  static_cast<void>(set);
  return true;
}

const Set& find(std::string_view name) {
  const Set* best = nullptr;
  for (const auto& s : sets) {
    const auto set = s.f->instruction_set;
    if (runs_here(set) && (name.empty() || name == set)) best = &s;
  }
  if (!best) throw wrong_usage("no instruction set '" + std::string(name) + "' here");
  return *best;
}

}  // namespace

template <>
const Kernels<float>& kernels(std::string_view name) {
  return *find(name).f;
}
template <>
const Kernels<double>& kernels(std::string_view name) {
  return *find(name).d;
}

std::vector<std::string> instruction_sets() {
  std::vector<std::string> names;
  for (const auto& s : sets)
    if (runs_here(s.f->instruction_set)) names.emplace_back(s.f->instruction_set);
  return names;
}

}  // namespace gonio
