#pragma once
/// \file
/// Tables that were computed and not measured.

#include "table/table.h"

namespace gonio {

/// True where a list's values at one incident direction are one constant in all of several outgoing
/// directions, another one at other directions: such a table was computed, from a reflectance by angle,
/// and shows no lobe.
bool one_value_per_angle(const Table&);

}  // namespace gonio
