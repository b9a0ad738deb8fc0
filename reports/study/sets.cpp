// Finds the kernels of an instruction set.
#include <map>

#include "brdf/kernel/kernels.h"
#include "reports/study/kernels.h"

namespace gonio {

#define GONIO_SET(set)                                         \
  namespace set {                                              \
  extern const std::span<const SamplingKernel> sampling_table; \
  extern const std::span<const LookupKernel> lookup_table;     \
  }
#include "instruction_sets.inc"
#undef GONIO_SET

StudyKernels study_kernels(std::string_view name) {
  static const std::map<std::string_view, StudyKernels> sets{
#define GONIO_SET(set) {#set, {set::sampling_table, set::lookup_table}},
#include "instruction_sets.inc"
#undef GONIO_SET
  };
  return sets.at(kernels<float>(name).instruction_set);
}

}  // namespace gonio
