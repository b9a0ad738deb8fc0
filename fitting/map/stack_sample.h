#pragma once
/// \file
/// Some texels of a stack, read from all over it.

#include "fitting/map/sample.h"
#include "stack/stack_reader.h"

namespace gonio {

/// Some 256 texels in squares of four, fewer of many images.
TexelSample small_sample(const StackReader&);
/// Squares of 33, whose loops have up to 32 texels a side.
TexelSample sample_in_pieces(const StackReader&);

}  // namespace gonio
