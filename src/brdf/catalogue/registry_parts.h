#pragma once
/// \file
/// How the registry takes further entries: of foreign terms alone.

#include "brdf/catalogue/registry.h"

namespace gonio {

/// Appends to catalogue(); spans of it that were given out stay as they are.
void append_term(const TermEntry&);

}  // namespace gonio
