// Numbers that people's own functions are not run in: no script of a proof and no shader is written
// of them.
#include "base/error.h"
#include "brdf/function/any_function.h"
#include "number/half.h"
#include "number/scripted.h"
#include "number/traced.h"

#include <fmt/format.h>

namespace gonio {
namespace {

[[noreturn]] void refuse_rows(const ForeignTerm& t) {
  throw wrong_usage(
      fmt::format("{}: no proof of a relative error and no shader is written of a file's function",
                  foreign::text_of(t.function->name)));
}

}  // namespace

#define GONIO_NO_ROWS(T)                                                                          \
  template <>                                                                                     \
  void foreign_rows<T>(const ForeignTerm& t, std::span<const T>, std::span<const FrameAngles<T>>, \
                       Quotient<T>*) {                                                            \
    refuse_rows(t);                                                                               \
  }
GONIO_NO_ROWS(Scripted<Half>)
GONIO_NO_ROWS(Scripted<float>)
GONIO_NO_ROWS(Scripted<double>)
GONIO_NO_ROWS(Traced<float>)
GONIO_NO_ROWS(Traced<Half>)

}  // namespace gonio
