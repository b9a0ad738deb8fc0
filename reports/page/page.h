#pragma once
/// \file
/// The shell of every page: one HTML file that opens from disk, with its style sheet, script and pictures in
/// it and nothing fetched (its own content policy forbids it).

#include <string>
#include <string_view>

namespace gonio {

/// \param title  plain text   \param body  HTML   \param looks  style sheet of its pictures
std::string drawn_page(std::string_view title, std::string_view body, std::string_view looks);
/// The same of a page that draws itself.
/// \param script  JavaScript   \param runs_module  it compiles WebAssembly, which the policy then allows
std::string scripted_page(std::string_view title,
                          std::string_view body,
                          std::string_view looks,
                          std::string_view script,
                          bool runs_module);
/// A page that leads back to index.html, which lies beside it.
std::string beside_index(std::string html);

}  // namespace gonio
