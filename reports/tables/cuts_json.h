#pragma once
/// \file
/// Cuts in a page's JSON.  Dear to compile: for .cpp files only.

#include "reports/picture/json_numbers.h"
#include "reports/tables/cuts.h"

namespace gonio {

PageJson page_json(const Cut&);

}  // namespace gonio
