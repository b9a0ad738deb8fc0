// Finds the kernels of an instruction set, and what they stand for.
#include <array>
#include <cmath>
#include <map>

#include "brdf/kernel/kernels.h"
#include "reports/study/fast_model.h"
#include "reports/study/kernels.h"

namespace gonio {

#define GONIO_SET(set)                                         \
  namespace set {                                              \
  extern const std::span<const FastKernel> fast_table;         \
  extern const std::span<const SamplingKernel> sampling_table; \
  extern const std::span<const LookupKernel> lookup_table;     \
  }
#include "instruction_sets.inc"
#undef GONIO_SET

StudyKernels study_kernels(std::string_view name) {
  static const std::map<std::string_view, StudyKernels> sets{
#define GONIO_SET(set) {#set, {set::fast_table, set::sampling_table, set::lookup_table}},
#include "instruction_sets.inc"
#undef GONIO_SET
  };
  return sets.at(kernels<float>(name).instruction_set);
}

double exact_operation(std::string_view operation, double x) {
  if (operation == "reciprocal root") return 1 / std::sqrt(x);
  if (operation == "reciprocal") return 1 / x;
  if (operation == "exponential") return std::exp(x);
  if (operation == "power") return std::pow(x, -static_cast<double>(fast_gamma));
  return std::pow(x, 5);
}

namespace {

template <Facets facets>
void shade(const VectorColumns& x, const float* p, std::span<double> out) {
  const FastModel<double, facets> model{double{p[0]}, double{p[1]}};
  const auto at = [](const std::array<const float*, 3>& columns, std::size_t i) {
    return std::array{double{columns[0][i]}, double{columns[1][i]}, double{columns[2][i]}};
  };
  for (std::size_t i = 0; i < x.n; ++i)
    out[i] = model(at(x.light, i), at(x.view, i), false, ByProducts());
}

}  // namespace

void exact_shaded(std::string_view operation,
                  const VectorColumns& x,
                  const float* p,
                  std::span<double> out) {
  if (operation == "exponential")
    shade<Facets::beckmann>(x, p, out);
  else if (operation == "power")
    shade<Facets::gtr>(x, p, out);
  else
    shade<Facets::ggx>(x, p, out);
}

}  // namespace gonio
