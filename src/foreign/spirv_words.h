#pragma once
/// \file
/// SPIR-V's own numbers of instructions and functions, from its headers.

#include <spirv/unified1/GLSL.std.450.h>
#define SPV_ENABLE_UTILITY_CODE
#include <spirv/unified1/spirv.hpp>
