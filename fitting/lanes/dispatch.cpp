// Picks the instruction set at run time.
#include <algorithm>

#include "fitting/lanes/lanes.h"

namespace gonio {

#define GONIO_SET(set)      \
  namespace set {           \
  LaneKernels lane_table(); \
  }
#include "instruction_sets.inc"
#undef GONIO_SET

const LaneKernels& lane_kernels(std::string_view name) {
#define GONIO_SET(set) set::lane_table(),
  static const std::vector<LaneKernels> sets{
#include "instruction_sets.inc"
  };
#undef GONIO_SET
  const auto set = kernels<float>(name).instruction_set;  // that may be taken here
  return *std::ranges::find(sets, set, &LaneKernels::instruction_set);
}

}  // namespace gonio
