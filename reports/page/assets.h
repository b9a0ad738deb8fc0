#pragma once
/// \file
/// The files a page is made of, as embedded by embed.cmake: UTF-8 text.

#include <string_view>

namespace gonio::assets {

extern const std::string_view page_css, pictures_js;

}  // namespace gonio::assets
