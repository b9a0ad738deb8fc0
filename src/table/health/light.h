#pragma once
/// \file
/// More light than arrives, or next to none: values of another unit.

#include <string>
#include <vector>

#include "table/health/facts.h"

namespace gonio {

/// How much light a table returns, in words, and what unit the values may have that return so much, with the command that reads
/// them so; "" where none is likely.
struct LightWarning {
  std::string text, guess;
};
/// Of more light than arrives, or next to none.
/// \param divided  by a cosine: a scale says nothing then
std::vector<LightWarning> warnings_of_light(TableFacts&, bool divided);

/// Command that leaves a channel out, in brackets.
std::string without_channel(const Table&, std::size_t channel);

}  // namespace gonio
