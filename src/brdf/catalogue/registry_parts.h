#pragma once
/// \file
/// How the registry takes further entries: of foreign terms alone.

#include "brdf/catalogue/registry.h"

namespace gonio {

/// Sets an entry behind the catalogue's own; spans of catalogue() that were given out stay as they are.
void set_term(std::size_t term, const TermEntry&);

}  // namespace gonio
