#pragma once
/// \file
/// SPIR-V to straight-line code: the function is run once on symbols.
///
/// A call is entered, a variable holds nodes, vectors are scalars.  A branch whose condition is known is taken; one that depends on
/// the sample is taken on both sides under masks, and its results meet in `select`.  A loop is run as long as its end is known.

#include <functional>
#include <string>
#include <vector>

#include "foreign/program.h"
#include "foreign/spirv_module.h"

namespace gonio::foreign {

/// What an argument, a uniform or a global variable of that name holds at the start: `size` scalars.
using Binding =
    std::function<std::vector<Ref>(Program&, const std::string& name, std::size_t size, Kind)>;

/// Something that a person should know although the function runs.
struct Note {
  int line;
  std::string text;
};

struct Translation {
  Program program;  ///< its outputs are the scalars of the function's result
  std::vector<Note> notes;
};

/// \throws Refused  with the line of the first instruction that no pure function of numbers has
Translation translate(const SpirvModule&, Id function, const Binding&);

}  // namespace gonio::foreign
