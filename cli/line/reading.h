#pragma once
/// \file
/// How the functions of people's own files are to be read: options of every command that takes a model.

#include <optional>
#include <string>
#include <vector>

#include "cli/line/command_line.h"

namespace gonio::cli {

struct ReadingWords {
  std::vector<std::string> arguments, bounds;
  std::optional<std::string> includes;
};

/// --argument NAME=DIRECTION …, --includes WHAT; \param bounds  and --bounds NAME=LOW,HIGH[,DEFAULT] …
void add_reading(Command&, ReadingWords&, bool bounds = true);
/// The spec with these options in the names of its files: "my.glsl:f" → "my.glsl:f{includes=pi}".
/// \throws Error  wrong usage where there are options and no file
std::string read_as(const std::string& spec, const ReadingWords&);
/// True of a word that names a table's file, where a model's would do: no spec, no function of a shader, no document of a fit.
bool names_table(const std::string& word);

}  // namespace gonio::cli
