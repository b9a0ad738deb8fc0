#pragma once
/// \file
/// The explorer's own files, as embedded by embed.cmake.

#include <string_view>

namespace gonio::assets {

extern const std::string_view explore_css, explore_js, explore_html, views_js, fitting_js,
    worker_js;
/// The modules of src/explore/module, by gzip.
extern const std::string_view models_wasm_gz, fit_wasm_gz;

}  // namespace gonio::assets
