#pragma once
/// \file
/// What instructions of SPIR-V compute from values, as steps of a program.

#include <functional>

#include "foreign/glsl_functions.h"
#include "foreign/program.h"
#include "foreign/spirv_module.h"

namespace gonio::foreign {

/// A value, or a pointer to `offset` of a variable.
struct Value {
  Id type = 0;
  Parts parts{};
  int variable = -1;
  std::size_t offset = 0;
  Ref guard = nothing;  ///< lanes that these parts belong to; none: all
  Parts others{};       ///< for lanes beside those: they left a loop before
};

/// The kind of numbers that a type consists of.
Kind kind(const SpirvModule&, Id type);
/// The kind of a step; of none a number's.
Kind kind_of(const Program&, Ref);
/// An integer that is known; refuses one that depends on the sample.
int whole(const Program&, Ref);
/// Part k of a vector, a matrix, an array or a struct, or a pointer to it; refuses one that is not there.
Value step(const Program&, const SpirvModule&, Value, int k);
/// a in lanes of the mask and b in the others; refuses an integer that differs.
Ref choose(Program&, Ref mask, Ref a, Ref b, Kind);

/// The value of an id.
using Known = std::function<const Value&(Id)>;
/// An instruction's result; refuses those that no function of numbers needs.
Value compute(Program&, const SpirvModule&, const Instruction&, const Known&);

}  // namespace gonio::foreign
