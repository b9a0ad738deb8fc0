#pragma once
/// \file
/// A batch in parts, as the programs that share work among machines take it.

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/names.h"

namespace gonio {

/// Who runs the parts.
enum class Engine {
  slurm,    ///< an array of sbatch
  openjd,   ///< a template of Open Job Description, 2023-09
  commands  ///< a command on each line: GNU parallel, OpenCue's cuecmd
};
template <>
inline constexpr std::array<std::string_view, 3> names_of<Engine>{"slurm", "openjd", "commands"};

struct Job {
  std::string program;               ///< path of gonio
  std::string folder;                ///< absolute; where the paths of the words begin
  std::vector<std::string> inputs;   ///< as `gonio fit` takes them
  std::vector<std::string> options;  ///< its options but for those below
  std::string results;               ///< a folder
  std::size_t tables = 0, parts = 1;
  int threads = 1;  ///< of each part
};

/// Text of the job for an engine.  Words that it could not hold are wrong usage: a control character anywhere, and
/// '{{' in a template, where it begins what the engine replaces.
std::string job_text(Engine, const Job&);

/// Command that makes the summary when the parts have ended.
std::string gather_command(const Job&);

}  // namespace gonio
