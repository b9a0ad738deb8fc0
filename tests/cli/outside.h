#pragma once
/// \file
/// Programs of others that exported files are held against; ./check fetches them.

#include <optional>
#include <string>

#include "support.h"

namespace gonio::test {

/// Interpreter of the environment with Mitsuba, MaterialX and USD.
std::string outside_python();
/// Whether that environment has a package.
bool has_outside(const std::string& package);
/// Whether MaterialX is there, and OpenGL without a window.
bool has_materialx();

/// Call of a script of tests/cli/targets: its words, what it says on both outputs, its exit code.
struct OutsideCall {
  int code;
  std::string out, err;
};
OutsideCall outside(const Folder&, const std::string& script, const std::string& words);

/// Whether Blender is there, which ./check --long fetches.
bool has_blender();
/// Call of blender_values.py.
OutsideCall in_blender(const Folder&, const std::string& words);

/// Messages of Khronos' validator on a glTF file, one a line; none where it is not there.
std::optional<std::string> gltf_messages(const Folder&, const std::string& file);

/// What the code of its target finds wrong with an exported file, by its ending: .gltf, .mtlx or .usda; of .glsl glslang.  Empty where that is
/// nothing, none where the code is not there.
std::optional<std::string> outside_faults(const Folder&, const std::string& file);

}  // namespace gonio::test
