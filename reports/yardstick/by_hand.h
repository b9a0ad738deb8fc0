#pragma once
/// \file
/// Models written out by hand, each for its own combination and nothing else, as an engineer would for a
/// renderer: what composed and fused models are measured against.  Never used to compute a result.

#include <span>
#include <string_view>

#include "brdf/kernel/kernels.h"

namespace gonio {

template <class F>
struct HandWritten {
  std::string_view spec;
  std::size_t channels;
  /// \param values  of compose(spec, channels), in its order   \param out  a column for each channel
  void (*value)(const Block<F>&, const F* values, F* const* out);
};

/// Lower bound of the time of GGX under Smith in cache: for each sample one division and two roots, out =
/// NoH/(√NoL + √NoV), the only operations of it that take long.
template <class F>
struct RootsAndDivision {
  void (*value)(const Block<F>&, F* out);
};

/// Both in an instruction set.
template <class F>
struct ByHand {
  std::span<const HandWritten<F>> models;
  RootsAndDivision<F> bound;
};
/// Models and bound for the best set that this machine and build have, or the named one.
template <class F>
const ByHand<F>& by_hand(std::string_view instruction_set = {});

}  // namespace gonio
