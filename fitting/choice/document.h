#pragma once
/// \file
/// Document of a choice among models, gonio.models/1.

#include <string>

#include "fitting/choice/choice.h"

namespace gonio {

/// Table that models were compared on, as a document names it.
struct ComparedTable {
  std::string path, sha256, format, metric;
  std::string mask = {};  ///< expression of --mask; "": none
};

ComparedTable compared_table(const Table&, const FitOptions&);

std::string to_json(const ModelChoice&, const Advice&, const ComparedTable&);
std::string models_schema();

}  // namespace gonio
