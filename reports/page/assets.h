#pragma once
/// \file
/// The files a page is made of, as embedded by embed.cmake: UTF-8 text.

#include <string_view>

namespace gonio::assets {

extern const std::string_view uplot_js, uplot_css, uplot_license;  ///< uPlot, MIT
extern const std::string_view page_css, page_js, plots_js;         ///< of every page
extern const std::string_view pictures_js;  ///< of pages whose pictures are drawn
extern const std::string_view table_js;     ///< of the pages of one table
extern const std::string_view spheres_js;   ///< of a table's and its models' spheres
extern const std::string_view fit_js, models_js, inspect_js, batch_js;  ///< of one page each
extern const std::string_view report_js, figures_js;                    ///< of the reports' pages

}  // namespace gonio::assets
