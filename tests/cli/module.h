#pragma once
/// \file
/// The module for Python, as a shell calls it.

#include <string>

namespace gonio::test {

/// Interpreter that finds the module; empty where the module is not built or NumPy is missing.
std::string python();

}  // namespace gonio::test
