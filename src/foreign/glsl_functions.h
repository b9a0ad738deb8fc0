#pragma once
/// \file
/// Functions of GLSL as steps of a program, scalar by scalar.

#include <cstddef>
#include <vector>

#include "foreign/program.h"
#include "foreign/spirv_module.h"

namespace gonio::foreign {

/// Scalars of a value.
using Parts = std::vector<Ref>;

/// x^y; whole exponents from 2 to 16 as products: closer, and what a compiler makes of them.
Ref power(Program&, Ref x, Ref y);
Ref clamp(Program&, Ref x, Ref low, Ref high);
/// Σ a[from_a + k step_a] b[from_b + k] over k < n.
Ref dot(Program&,
        const Parts& a,
        const Parts& b,
        std::size_t from_a,
        std::size_t from_b,
        std::size_t n,
        std::size_t step_a = 1);
Ref dot(Program&, const Parts& a, const Parts& b);
Ref length(Program&, const Parts&);
/// A function of the set GLSL.std.450, by its number; refuses those that no function of numbers needs.
Parts glsl_function(Program&, Id function, const std::vector<Parts>& arguments);

}  // namespace gonio::foreign
