// Picks the instruction set at run time.
#include <algorithm>
#include <vector>

#include "base/error.h"
#include "stability/kernel/half_columns.h"

namespace gonio::stability {

#define GONIO_SET(set)                               \
  namespace set {                                    \
  extern const HalfKernels half_columns;             \
  template <Role role>                               \
  std::span<const HalfByRules> half_terms_of();      \
  std::span<const HalfByRules> foreign_half_terms(); \
  }
#include "instruction_sets.inc"
#undef GONIO_SET

namespace {

/// A set's kernels with the terms of all roles in one array.
struct Assembled {
  std::vector<HalfByRules> terms;
  HalfKernels kernels;

  Assembled(const HalfKernels& columns, std::initializer_list<std::span<const HalfByRules>> roles)
      : kernels(columns) {
    for (const auto& role : roles) terms.insert(terms.end(), role.begin(), role.end());
    kernels.terms = terms;
  }
};

const std::vector<Assembled>& sets() {
  static const std::vector<Assembled> all = [] {
    std::vector<Assembled> v;
#define GONIO_SET(set)                                                                    \
  v.push_back({set::half_columns,                                                         \
               {set::half_terms_of<Role::ndf>(), set::half_terms_of<Role::masking>(),     \
                set::half_terms_of<Role::fresnel>(), set::half_terms_of<Role::diffuse>(), \
                set::foreign_half_terms()}});
#include "instruction_sets.inc"
#undef GONIO_SET
    return v;
  }();
  return all;
}

}  // namespace

const HalfKernels& half_kernels(std::string_view name) {
  const auto set = kernels<float>(name).instruction_set;  // that may be taken here
  return std::ranges::find(sets(), set, [](const auto& s) { return s.kernels.instruction_set; })
      ->kernels;
}

}  // namespace gonio::stability
