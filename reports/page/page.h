#pragma once
/// \file
/// The shell of every page: one HTML file that opens from disk, with its data, styles and scripts in
/// it and nothing fetched (its own content policy forbids it).

#include <string>
#include <string_view>

namespace gonio {

/// \param title      plain text
/// \param json_data  one JSON document; the script finds it as `page_data()`
/// \param script     builds the page in <main>; what it may use is in page/page.js and page/plots.js
std::string make_page(std::string_view title, std::string_view json_data, std::string_view script);
/// A page whose content is there already.  \param body  HTML   \param looks  style sheet of its pictures
std::string drawn_page(std::string_view title, std::string_view body, std::string_view looks);
/// Page of a report: before the script what all reports share, page/report.js and page/figures.js.
std::string make_report_page(std::string_view title,
                             std::string_view json_data,
                             std::string_view script);
/// A page that leads back to index.html, which lies beside it.
std::string beside_index(std::string html);

}  // namespace gonio
