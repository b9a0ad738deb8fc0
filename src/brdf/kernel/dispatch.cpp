// Picks the instruction set at run time.
#include <algorithm>
#include <cstdlib>
#include <initializer_list>

#include "base/error.h"
#include "brdf/kernel/kernels.h"

namespace gonio {

#define GONIO_SET(set)                                                   \
  namespace set {                                                        \
  extern const Kernels<float> table_float;                               \
  extern const Kernels<double> table_double;                             \
  template <Role role, class F>                                          \
  std::span<const TermKernels<F>> terms_of();                            \
  template <FusedGroup group, class F>                                   \
  FusedModels<F> fused_models();                                         \
  template <class F>                                                     \
  std::span<const typename TermKernels<F>::WithGgx> maskings_with_ggx(); \
  template <class F>                                                     \
  std::span<const TermKernels<F>> foreign_terms();                       \
  }
#include "instruction_sets.inc"
#undef GONIO_SET

namespace {

/// A set's kernels with the terms of all roles in one array, room for foreign ones behind them, and the fused models of all groups.
template <class F>
struct Assembled {
  std::vector<TermKernels<F>> terms;
  std::vector<FusedKernel<F>> fused;
  std::vector<NormalKernel<F>> normal;
  Kernels<F> kernels;

  Assembled(const Kernels<F>& columns,
            std::initializer_list<std::span<const TermKernels<F>>> roles,
            std::span<const typename TermKernels<F>::WithGgx> maskings_with_ggx,
            std::initializer_list<FusedModels<F>> groups)
      : kernels(columns) {
    for (const auto& role : roles) terms.insert(terms.end(), role.begin(), role.end());
    auto* masking = terms.data() + roles.begin()->size();
    for (const auto& with_ggx : maskings_with_ggx) (masking++)->with_ggx = with_ggx;
    for (const auto& g : groups) {
      fused.insert(fused.end(), g.values.begin(), g.values.end());
      normal.insert(normal.end(), g.normal.begin(), g.normal.end());
    }
    kernels.terms = terms;
    kernels.fused = fused;
    kernels.normal = normal;
  }
};

struct Set {
  Assembled<float> f;
  Assembled<double> d;
};

/// In the order of the build's list: the best last.
const std::vector<Set>& sets() {
  static const std::vector<Set> all = [] {
    std::vector<Set> v;
#define GONIO_ASSEMBLED(set, F)                                                               \
  {                                                                                           \
    set::table_##F,                                                                           \
        {set::terms_of<Role::ndf, F>(), set::terms_of<Role::masking, F>(),                    \
         set::terms_of<Role::fresnel, F>(), set::terms_of<Role::diffuse, F>(),                \
         set::foreign_terms<F>()},                                                            \
        set::maskings_with_ggx<F>(), {                                                        \
      set::fused_models<FusedGroup::ggx, F>(), set::fused_models<FusedGroup::isotropic, F>(), \
          set::fused_models<FusedGroup::anisotropic, F>(),                                    \
          set::fused_models<FusedGroup::shipped, F>()                                         \
    }                                                                                         \
  }
#define GONIO_SET(set) v.push_back({GONIO_ASSEMBLED(set, float), GONIO_ASSEMBLED(set, double)});
#include "instruction_sets.inc"
#undef GONIO_SET
#undef GONIO_ASSEMBLED
    return v;
  }();
  return all;
}

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

/// Sets that this machine and GONIO_INSTRUCTION_SET leave, the best last.
std::vector<const Set*> here() {
  const char* const most = std::getenv("GONIO_INSTRUCTION_SET");
  const auto name = [](const Set& s) { return s.f.kernels.instruction_set; };
  auto end = sets().end();
  if (most && *most) {
    end = std::ranges::find(sets(), std::string_view(most), name);
    if (end == sets().end()) {
      std::string known;
      for (const auto& s : sets()) known.append(known.empty() ? "" : ", ").append(name(s));
      throw wrong_usage("GONIO_INSTRUCTION_SET: '" + std::string(most) + "', expected one of " +
                        known);
    }
    ++end;
  }
  std::vector<const Set*> left;
  for (auto s = sets().begin(); s != end; ++s)
    if (runs_here(name(*s))) left.push_back(&*s);
  return left;
}

const Set& find(std::string_view name) {
  static const auto all = here();
  if (name.empty()) return *all.back();
  for (const Set* s : all)
    if (s->f.kernels.instruction_set == name) return *s;
  throw wrong_usage("no instruction set '" + std::string(name) + "' here");
}

}  // namespace

template <>
const Kernels<float>& kernels(std::string_view name) {
  return find(name).f.kernels;
}
template <>
const Kernels<double>& kernels(std::string_view name) {
  return find(name).d.kernels;
}

std::vector<std::string> instruction_sets() {
  std::vector<std::string> names;
  for (const Set* s : here()) names.emplace_back(s->f.kernels.instruction_set);
  return names;
}

}  // namespace gonio
