// Picks the instruction set at run time.
#include <algorithm>
#include <vector>

#include "scene/kernel/layer.h"

namespace gonio::scene {

#define GONIO_SET(set)                            \
  namespace set {                                 \
  extern const LayerKernels<float> layer_float;   \
  extern const LayerKernels<double> layer_double; \
  }
#include "instruction_sets.inc"
#undef GONIO_SET

namespace {

template <class F>
const LayerKernels<F>& found(const std::vector<const LayerKernels<F>*>& sets,
                             std::string_view name) {
  const auto set = kernels<F>(name).instruction_set;  // that may be taken here
  return **std::ranges::find(sets, set, [](const auto* s) { return s->instruction_set; });
}

}  // namespace

template <>
const LayerKernels<float>& layer_kernels(std::string_view name) {
#define GONIO_SET(set) &set::layer_float,
  static const std::vector<const LayerKernels<float>*> sets{
#include "instruction_sets.inc"
  };
#undef GONIO_SET
  return found(sets, name);
}
template <>
const LayerKernels<double>& layer_kernels(std::string_view name) {
#define GONIO_SET(set) &set::layer_double,
  static const std::vector<const LayerKernels<double>*> sets{
#include "instruction_sets.inc"
  };
#undef GONIO_SET
  return found(sets, name);
}

}  // namespace gonio::scene
