#pragma once
/// \file
/// Text taken apart, and made fit for a line that people read.

#include <string>
#include <string_view>
#include <vector>

namespace gonio {

/// The parts between separators: at least one, empty ones included.
std::vector<std::string> split(std::string_view, char at);

/// Text as one line of UTF-8 that leaves a terminal alone: control characters and bytes that are not
/// UTF-8 become \xNN; what is longer than `most` bytes is cut and ends in "…".
std::string printable(std::string_view, std::size_t most = std::string_view::npos);

/// "1 iteration", "2 iterations".
std::string counted(std::size_t n, std::string_view thing);

/// Beginning of a text of at most so many bytes, which ends between characters.
std::string_view beginning(std::string_view, std::size_t most);
/// Text of a file in single quotes, for an error's line, which shows its beginning only: a word may be as long as its file.
std::string in_quotes(std::string_view);

// A name written where others read it: each place has one of these, and a terminal printable().

/// Word of a command line: in quotes where a shell would take it apart.
std::string shell_word(const std::string&);
/// Word of a path, which no command takes for one of its options.
std::string path_word(const std::string& path);
/// The same for a job, whose words become text later.
std::string as_path(const std::string& path);
/// Text of an element or of an attribute in double quotes, of XML and of HTML: printable, with entities.
std::string markup_text(std::string_view);
/// Path as a reference of a URI [RFC 3986].
std::string uri_of(std::string_view path);
/// Text of a JSON document whose strings leave a terminal alone: what printable() would change is \uNNNN, which says the same.
std::string printable_json(std::string json);

}  // namespace gonio
