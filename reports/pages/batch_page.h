#pragma once
/// \file
/// Page of the fits of many tables in one look.

#include <string>

#include "fitting/batch/batch_document.h"

namespace gonio {

std::string batch_page_html(const BatchSummary&, const std::string& title);

}  // namespace gonio
