#pragma once
/// \file
/// Channels that a page draws: of a spectrum with thousands a few stand for all, so that a page stays as small as its reader's patience.

#include <cstddef>
#include <optional>
#include <vector>

#include "brdf/model/model.h"
#include "table/table.h"

namespace gonio {

/// All channels; of more than `most` as many, from the first to the last.
std::vector<std::size_t> drawn_channels(std::size_t all, std::size_t most = 12);

/// A table and a model of the channels that are drawn; none where these are all.
std::optional<Table> of_drawn_channels(const Table&);
BoundModel of_drawn_channels(const BoundModel&);

}  // namespace gonio
