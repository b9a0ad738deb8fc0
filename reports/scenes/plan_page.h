#pragma once
/// \file
/// Page of a plan, gonio.plan/1.

#include <string>
#include <string_view>

namespace gonio {

/// Page that shows, for each material, what to keep, what to drop and why.  \param data  the plan's document
std::string plan_page_html(std::string_view data);

}  // namespace gonio
