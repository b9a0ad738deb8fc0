#pragma once
/// \file
/// What the catalogue has, as `gonio models` and `gonio.models` list it, and its document.

#include <string>
#include <vector>

#include "answer/term.h"
#include "brdf/catalogue/registry.h"
#include "brdf/model/presets.h"
#include "optics/refractive_index.h"

namespace gonio {

/// Entries of the catalogue, in its order.
struct CatalogueEntries {
  std::vector<const TermEntry*> terms;
  std::vector<const MapEntry*> maps;
  std::vector<const Preset*> presets;
  std::vector<const Evaluated*> evaluated;
  std::vector<const Material*> metals;
};

/// Entries that hold a word in their id, title or source, whatever its case, or have a parameter of that name; "" all.
/// \throws Error  wrong_usage where there is none
CatalogueEntries entries_with(const std::string& word);

/// {"terms", "maps", "models", "metals"}
std::string to_json(const CatalogueEntries&);

}  // namespace gonio
