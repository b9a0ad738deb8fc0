#pragma once
/// \file
/// What a person's file has, as `gonio models FILE` lists it, and its document.

#include <string>
#include <vector>

#include "base/json/reader.h"
#include "foreign/function.h"
#include "number/counted.h"

namespace gonio {

struct FileFunction {
  foreign::Entry entry;
  std::optional<foreign::Function> function;  ///< none: refused
  Operations operations;                      ///< of one sample, all channels
};

struct FileFunctions {
  std::string file, sha256;
  std::vector<FileFunction> functions;
};

/// The functions of a file that give a number or a colour, or the one that is named.
FileFunctions file_functions(const std::string& name);
std::string to_json(const FileFunctions&);
/// As a person reads it, a paragraph for each function.
std::string text_of(const FileFunctions&);

/// Adds the files that a spec takes functions from, with their hashes, where there are any.
void add_own_files(Json& document, const std::string& spec);

}  // namespace gonio
