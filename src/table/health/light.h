#pragma once
/// \file
/// More light than arrives, or next to none: values of another unit.

#include <string>
#include <vector>

#include "table/health/facts.h"

namespace gonio {

/// Says that a table returns more light than arrives, or next to none, and which unit its values may have.
/// \param divided  by a cosine: a scale says nothing then
void warn_of_light(TableFacts&, bool divided, std::vector<std::string>& all);

/// Command that leaves a channel out, in brackets.
std::string without_channel(const Table&, std::size_t channel);

}  // namespace gonio
