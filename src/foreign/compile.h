#pragma once
/// \file
/// A person's text to valid SPIR-V, by glslang and SPIRV-Tools' validator, in a process of its own with limits of memory, processor
/// time and output, which opens no file.  Nothing is optimised: an optimiser rounds otherwise than the text says.

#include <cstdint>
#include <vector>

#include "foreign/source.h"

namespace gonio::foreign {

/// True where this build can: GONIO_SHADERS, and the libraries were found.
bool can_compile();

/// The floats of GLSL and of .brdf files become doubles first, so that constants keep their digits; HLSL and SPIR-V hold floats.
/// \throws Error  bad input with the line that the compiler names; wrong usage where this build cannot
std::vector<std::uint32_t> compile(const Source&);

}  // namespace gonio::foreign
