#pragma once
/// \file
/// Functions of texts that are written to a file first.

#include <string>

#include "foreign/compile.h"
#include "foreign/function.h"
#include "refusal.h"
#include "support.h"

namespace gonio::foreign {

#define SKIP_WITHOUT_SHADERS \
  if (!can_compile()) GTEST_SKIP() << "this build reads no shaders"

/// The function of a text that is written to a file first.
struct Written {
  test::Folder folder;
  std::string path;
  explicit Written(const std::string& text, const std::string& name = "my.glsl")
      : path(folder.write(name, text)) {}
  Function function(const std::string& rest = "") const {
    return read_function(parse_name(path + rest));
  }
  std::string refused(const std::string& rest = "", Exit code = Exit::bad_input) const {
    return test::refusal([&] { function(rest); }, code);
  }
};

}  // namespace gonio::foreign
