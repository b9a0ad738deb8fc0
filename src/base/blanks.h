#pragma once
/// \file
/// Lines of words with blanks between them.

#include <algorithm>
#include <string_view>

namespace gonio {

inline constexpr std::string_view blanks = " \t\r";

/// Text without UTF-8's byte-order mark.
inline std::string_view without_mark(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  return text;
}
/// Text without the blanks at its ends.
inline std::string_view trimmed(std::string_view s) {
  s.remove_prefix(std::min(s.find_first_not_of(blanks), s.size()));
  return s.substr(0, s.find_last_not_of(blanks) + 1);
}
/// Next word of a line, which is taken from it; "" at its end.
inline std::string_view next_word(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
  const auto found = line.substr(0, line.find_first_of(blanks));
  line.remove_prefix(found.size());
  return found;
}

}  // namespace gonio
