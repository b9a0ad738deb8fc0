#pragma once
/// \file
/// A page as one HTML file: whole without its script, which reads, zooms and chooses (page/pictures.js).

#include <set>
#include <string>

#include "reports/page/section.h"

namespace gonio::page {

/// \param pictures  those that the page's parts name   \param linked  takes the ids of those whose files it links to
std::string page_html(const Page&,
                      const Pictures& pictures,
                      std::set<std::string>* linked = nullptr);

}  // namespace gonio::page
