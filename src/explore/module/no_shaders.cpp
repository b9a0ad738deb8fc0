// What a page has not: files of shaders, and kernels for the functions in them. Everything that
// would read one is refused by name.
#include "base/error.h"
#include "brdf/cost/model_operations.h"
#include "brdf/function/any_function.h"
#include "brdf/kernel/kernels.h"
#include "brdf/model/own_files.h"
#include "foreign/function.h"
#include "number/counted.h"

namespace gonio::foreign {

bool is_name(std::string_view) {
  return false;
}
bool is_there(std::string_view) {
  return false;
}
Name parse_name(std::string_view name) {
  throw wrong_usage("'" + std::string(name) + "': a page reads no shaders");
}

}  // namespace gonio::foreign

namespace gonio {

bool names_own_file(std::string_view) {
  return false;
}
std::vector<OwnFile> own_files(const std::vector<std::string>&, const std::string&) {
  return {};
}
Operations operations_of(const foreign::Function&, std::size_t) {
  return {};
}
template <>
void foreign_rows(const ForeignTerm&,
                  std::span<const Counted<double>>,
                  std::span<const FrameAngles<Counted<double>>>,
                  Quotient<Counted<double>>*) {}

}  // namespace gonio

namespace gonio::simd128 {

template <class F>
std::span<const TermKernels<F>> foreign_terms();
template <>
std::span<const TermKernels<float>> foreign_terms<float>() {
  return {};
}
template <>
std::span<const TermKernels<double>> foreign_terms<double>() {
  return {};
}

}  // namespace gonio::simd128
