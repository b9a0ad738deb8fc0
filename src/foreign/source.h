#pragma once
/// \file
/// A person's file: what language it is in, the text to compile, and the parameters that the file itself declares.

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "number/parameter.h"

namespace gonio::foreign {

enum class Language { glsl, hlsl, spirv };

/// A parameter's bounds and default, as a .brdf file or a comment "// alpha 0.001 1 0.2" declares them.
struct Declared {
  std::string name;
  Range range{0, 1};
  std::vector<double> start{};  ///< one, of a colour three; none: not said
  bool is_bool = false;
  int line = 0;

  bool is_fixed() const { return range.low == range.high; }
};

struct Source {
  std::string path;
  Language language = Language::glsl;
  bool explorer = false;  ///< a .brdf file
  std::string text;       ///< to compile, its lines numbered as the person's
  std::string sha256;     ///< of the file
  std::vector<Declared> declared{};

  void declare(Declared);
  /// The first of a name.
  const Declared* find(std::string_view name) const;

 private:
  std::map<std::string, std::size_t, std::less<>> first_;  ///< among those declared, by name
};

/// True of a name that ends as these files do: .brdf, .glsl, .frag, .hlsl, .spv.
bool is_source_name(std::string_view path);
/// \throws Error  bad input: not there, more than a megabyte, an include, a parameter that is none
Source read_source(const std::string& path);
/// The same of a text that is no file's.  \param path  tells the language, and names it in errors
Source source_of(const std::string& path, const std::string& content);

}  // namespace gonio::foreign
