#pragma once
/// \file
/// Rules by which a number's results are rounded: those of the thread, which enclosures and scripts obey.

#include "number/real.h"

namespace gonio::inline GONIO_ARCH {

/// Rules by which results are rounded.
struct Rounding {
  /// a · b + c may be rounded once in place of twice; not where a · b went through min, max or select.
  bool contracted = false;
  bool flushed = false;    ///< a subnormal, read or computed, may be taken for 0
  bool any_gpu = false;    ///< what Vulkan allows, below; else to nearest, ties to even
  bool infinities = true;  ///< any_gpu: the shader declares SignedZeroInfNanPreserve

  /// Vulkan's bounds for a shader that declares no execution mode, its expressions `precise` unless contracted.
  ///
  ///   + − ×        correctly rounded, to either neighbour: the mode is the implementation's
  ///   ÷            2.5 ulp for divisors of 2^±126, in half 2^±14; else nothing
  ///   √            1 / inversesqrt, which errs by 2 ulp: 4.5 eps together; of 0 it is 0,
  ///                as it is everywhere, though 1 / inversesqrt does not promise it
  ///   exp          3 + 2 |x| ulp, in half 1 + 2 |x|
  ///   log          3 ulp; within [1/2, 2] 2⁻²¹, in half 2⁻⁷
  ///   subnormals   kept or flushed; infinities and NaN: an operation that may make one may give anything
  ///   double       what float has
  ///                             [Vulkan 1.4, appendix 'Vulkan Environment for SPIR-V', 'Precision of
  ///                              Individual Operations' and the rules before it]
  /// Left out: reassociation, which Vulkan allows of what is not `precise`.
  static constexpr Rounding vulkan() {
    return {.flushed = true, .any_gpu = true, .infinities = false};
  }
};

inline thread_local Rounding rounding_now;

/// Rounding of this thread, until it ends.
class RoundingScope {
 public:
  explicit RoundingScope(const Rounding& rule) : before_(rounding_now) { rounding_now = rule; }
  RoundingScope(const RoundingScope&) = delete;
  RoundingScope& operator=(const RoundingScope&) = delete;
  ~RoundingScope() { rounding_now = before_; }

 private:
  Rounding before_;
};

}  // namespace gonio::inline GONIO_ARCH
