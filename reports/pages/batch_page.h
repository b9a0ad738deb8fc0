#pragma once
/// \file
/// Page of the fits of many tables in one look.

#include <string>
#include <string_view>

namespace gonio {

/// Page as HTML.  \param data  batch_json() with previews
std::string batch_page_html(std::string_view title, std::string_view data);

}  // namespace gonio
