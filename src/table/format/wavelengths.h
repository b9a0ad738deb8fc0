#pragma once
/// \file
/// Channels that are wavelengths.

#include <optional>
#include <string_view>
#include <vector>

#include "table/table.h"

namespace gonio {

/// Wavelength that a name is, a number [nm].
std::optional<double> wavelength_of(std::string_view name);
/// The same of a name that may have its unit, as 550nm.
std::optional<double> wavelength_with_unit(std::string_view name);
/// Of all channels; of a table with one that is named "f", of the note "wavelength".  Empty where one is none.
std::vector<double> wavelengths_of(const Table&);

}  // namespace gonio
