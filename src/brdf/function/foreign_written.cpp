// People's own functions in numbers that write down what is done to them: for shaders and for
// proofs.
#include "base/error.h"
#include "brdf/function/foreign_function.h"
#include "number/half.h"
#include "number/scripted.h"
#include "number/traced.h"

#include <fmt/format.h>

namespace gonio::foreign::inline GONIO_ARCH {
namespace {

constexpr std::string_view name_of_call(Call f) {
  constexpr std::string_view names[]{"pow", "atan2", "exp2", "log2", "sin",
                                     "cos", "asin",  "acos", "atan", "floor"};
  return names[static_cast<std::size_t>(f)];
}

}  // namespace

/// Powers are written by exp and log, as GLSL defines their precision.  \throws Error  wrong usage of what gonio shader has no word for
template <class F>
struct Functions<Traced<F>> {
  using T = Traced<F>;
  static TracedMask less_equal(const T& a, const T& b) { return !(b < a); }
  static TracedMask equal(const T& a, const T& b) { return !(a < b) && !(b < a); }
  template <Call f>
  static T call(const T& x, const T& y) {
    if constexpr (f == Call::pow) return exp(y * log(x));
    if constexpr (f == Call::exp2) return exp(x * log(T(2)));
    if constexpr (f == Call::log2) return log(x) / log(T(2));
    if (x.is_known())
      return T(static_cast<F>(called<double>(f, static_cast<double>(x.known()),
                                             y.is_known() ? static_cast<double>(y.known()) : 0)));
    throw wrong_usage(fmt::format(
        "{}: gonio shader writes + - * / sqrt exp log pow min max and choices; the file's own text "
        "stays as it is: --language glsl of a GLSL file, without --set, --inputs and --derivatives",
        name_of_call(f)));
  }
};

/// A comparison is decided where the whole domain decides it alike; a script holds + − × ÷ √ only.
template <class F>
struct Functions<Scripted<F>> {
  using T = Scripted<F>;
  static EnclosureMask less_equal(const T& a, const T& b) { return !(b < a); }
  static EnclosureMask equal(const T& a, const T& b) { return !(a < b) && !(b < a); }
  template <Call f>
  static T call(const T& x, const T&) {
    if (auto* script = Script::now())
      script->refuse(fmt::format("{}, which Gappa does not know", name_of_call(f)));
    return log(x);
  }
};

}  // namespace gonio::foreign::inline GONIO_ARCH

namespace gonio {

GONIO_FOREIGN_ROWS(Scripted<Half>)
GONIO_FOREIGN_ROWS(Scripted<float>)
GONIO_FOREIGN_ROWS(Scripted<double>)
GONIO_FOREIGN_ROWS(Traced<float>)
GONIO_FOREIGN_ROWS(Traced<Half>)

}  // namespace gonio
