// Finds the models by hand of an instruction set.
#include <map>

#include "reports/yardstick/by_hand.h"

namespace gonio {

#define GONIO_SET(set)                        \
  namespace set {                             \
  extern const ByHand<float> by_hand_float;   \
  extern const ByHand<double> by_hand_double; \
  }
#include "instruction_sets.inc"
#undef GONIO_SET

template <>
const ByHand<float>& by_hand(std::string_view name) {
  static const std::map<std::string_view, const ByHand<float>*> sets{
#define GONIO_SET(set) {#set, &set::by_hand_float},
#include "instruction_sets.inc"
#undef GONIO_SET
  };
  return *sets.at(kernels<float>(name).instruction_set);
}
template <>
const ByHand<double>& by_hand(std::string_view name) {
  static const std::map<std::string_view, const ByHand<double>*> sets{
#define GONIO_SET(set) {#set, &set::by_hand_double},
#include "instruction_sets.inc"
#undef GONIO_SET
  };
  return *sets.at(kernels<double>(name).instruction_set);
}

}  // namespace gonio
