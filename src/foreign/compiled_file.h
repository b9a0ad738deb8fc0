#pragma once
/// \file
/// Files of functions, each compiled once in a run.

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "foreign/program.h"
#include "foreign/source.h"
#include "foreign/spirv_module.h"

namespace gonio::foreign {

/// OpTypePointer
inline constexpr std::uint32_t spirv_pointer = 32;

struct Compiled {
  Source source;
  std::unique_ptr<const SpirvModule> module;
  std::map<std::string, Id> functions;                 ///< that give a number or a colour, by name
  std::map<std::string, Id> void_functions;            ///< a stage's main among them
  std::vector<std::pair<std::string, Id>> shadowed{};  ///< whose name a later one has
};

/// The file, compiled once in a run.  \throws Error  bad input
std::shared_ptr<const Compiled> file_of(const std::string& path);

[[noreturn]] void refuse(const std::string& file, const Refused&);
/// Refuses a file without a function that can be named.
[[noreturn]] void refuse_nameless(const Compiled&, const std::string& path);

}  // namespace gonio::foreign
