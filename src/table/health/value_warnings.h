#pragma once
/// \file
/// What a table's values may be other than f in 1/sr.

#include <string>
#include <vector>

#include "table/health/facts.h"

namespace gonio {

/// Sentences, each with what to do: more light than arrives, or next to none; a cosine left in; directions
/// whose exchange changes values; zeros that noise or digits made; one channel below 0.
struct ValueWarning {
  std::string text;
  bool of_unit;  ///< light, a cosine, angles or an offset: no model is to blame for what it misses
                 ///< then
  bool of_scale = false;   ///< light: not of a table whose scale is free
  std::string guess = {};  ///< what unit that may be, which follows the text
  std::string metric =
      {};  ///< which metric minds it less, which follows the text where that is not the fit's

  std::string whole() const { return text + metric + guess; }
};
std::vector<ValueWarning> value_warnings(TableFacts&);

/// True of a reader's warning that a model answers which reproduces the table: of light that comes back the way it came.
inline bool is_answered_by_a_fit(const std::string& warning) {
  return warning.find("azimuths are counted otherwise") != warning.npos;
}

}  // namespace gonio
