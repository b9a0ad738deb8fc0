#pragma once
/// \file
/// Compute programs that call a shader's function, for whoever runs it or counts what it became.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "shader/language.h"
#include "shader/traced_formula.h"

namespace gonio::shader {

/// A program of 64 invocations a group.  Each reads a row of floats from binding 0: the function's parameters, a colour's
/// three, then its angles, or of directions n, l, v and of an anisotropic model t and b.  It writes the function's results as
/// floats to binding 1.
std::string compute_program(const TracedFormula&, Language, bool of_directions = false);

/// Instructions of an optimised SPIR-V module, by kind; one on a vector counts once.
struct Instructions {
  /// add: sums and differences; mul: products, of a vector by a number too; other: what is none of the others, as loads, copies
  /// and parts of vectors
  static constexpr std::array<std::string_view, 11> kinds{
      "add", "mul", "fma", "div", "sqrt", "exp", "log", "min_max", "compare", "select", "other"};
  std::array<std::size_t, kinds.size()> by_kind{};

  /// Of all kinds but `other`.
  std::size_t arithmetic() const;
};
/// Those of a module's functions.  \param words  as SPIR-V's specification has them, header included
Instructions count_instructions(std::span<const std::uint32_t> words);

/// Instructions of the program that calls the function once, compiled by glslangValidator and optimised by `spirv-opt -O`; no
/// value where one of them is not on PATH.
std::optional<Instructions> compiled_instructions(const TracedFormula&);

}  // namespace gonio::shader
