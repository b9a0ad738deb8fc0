#pragma once
/// \file
/// Channels that are wavelengths.

#include <optional>
#include <string_view>
#include <vector>

#include "table/table.h"

namespace gonio {

/// Wavelength that a channel's name is [nm]: 550, or 550nm.
std::optional<double> wavelength_of(std::string_view channel);
/// Of all channels; of a table with one that is named "f", of the note "wavelength".  Empty where one is none.
std::vector<double> wavelengths_of(const Table&);

}  // namespace gonio
