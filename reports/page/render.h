#pragma once
/// \file
/// A page as one HTML file: whole without its script, which reads, zooms and chooses (page/pictures.js).

#include <string>

#include "reports/page/section.h"

namespace gonio::page {

/// \param pictures  those that the page's parts name
std::string page_html(const Page&, const Pictures& pictures);

}  // namespace gonio::page
