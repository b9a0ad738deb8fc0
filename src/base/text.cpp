#include "base/text.h"

#include <algorithm>
#include <array>
#include <cctype>

#include <fmt/format.h>

namespace gonio {
namespace {

/// True for a character that turns the direction of the text after it, ends its line or cannot be seen: what is read is not what
/// it is.  Or one that XML has not (U+FFFE, U+FFFF).
constexpr bool misleads(char32_t c) {
  return c == 0x61c || c == 0x200e || c == 0x200f || (c >= 0x2028 && c <= 0x202e) ||
         (c >= 0x2066 && c <= 0x2069) || c == 0xfeff || c == 0xad || c == 0x200b ||
         (c >= 0x2060 && c <= 0x2064) || c == 0xfffe || c == 0xffff ||
         (c >= 0xe0000 && c <= 0xe007f);
}

/// Bytes of the character that s begins with; 0 for a control character, one that misleads or what is not UTF-8.
std::size_t length_if_printable(std::string_view s) {
  const auto byte = [&](std::size_t i) -> unsigned {
    return i < s.size() ? static_cast<unsigned char>(s[i]) : 0;
  };
  const unsigned lead = byte(0);
  if (lead < 0x80) return lead >= 0x20 && lead != 0x7f;
  if (lead < 0xc2 || lead > 0xf4) return 0;
  // The second byte's bounds [Unicode, table 3-7]; 0xc2 0x80 to 0xc2 0x9f are control characters.
  const unsigned low = lead == 0xc2 || lead == 0xe0 ? 0xa0 : lead == 0xf0 ? 0x90 : 0x80;
  const unsigned high = lead == 0xed ? 0x9f : lead == 0xf4 ? 0x8f : 0xbf;
  if (byte(1) < low || byte(1) > high) return 0;
  const std::size_t length = lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
  char32_t c = lead & (0x7f >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
    c = c << 6 | (byte(i) & 0x3f);
  }
  return misleads(c) ? 0 : length;
}

}  // namespace

std::vector<std::string> split(std::string_view s, char at) {
  std::vector<std::string> parts;
  for (;;) {
    const auto i = s.find(at);
    parts.emplace_back(s.substr(0, i));
    if (i == s.npos) return parts;
    s.remove_prefix(i + 1);
  }
}

std::string printable(std::string_view s, std::size_t most) {
  std::string out;
  while (!s.empty()) {
    if (out.size() >= most) return out + "…";
    const std::size_t n = length_if_printable(s);
    if (n == 0)
      out += fmt::format("\\x{:02x}", static_cast<unsigned char>(s[0]));
    else
      out += s.substr(0, n);
    s.remove_prefix(std::max<std::size_t>(n, 1));
  }
  return out;
}

std::string_view beginning(std::string_view s, std::size_t most) {
  if (s.size() <= most) return s;
  while (most > 0 && (static_cast<unsigned char>(s[most]) & 0xc0U) == 0x80U) --most;
  return s.substr(0, most);
}

std::string in_quotes(std::string_view s) {
  return fmt::format("'{}'", beginning(s, 100));
}

std::string counted(std::size_t n, std::string_view thing) {
  return fmt::format("{} {}{}", n, thing, n == 1 ? "" : "s");
}

std::string shell_word(const std::string& word) {
  const auto plain = [](unsigned char c) {
    return std::isalnum(c) ||
           std::string_view("_-=.,:/+%@").find(static_cast<char>(c)) != std::string_view::npos;
  };
  if (!word.empty() && std::ranges::all_of(word, plain)) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string as_path(const std::string& path) {
  return path.starts_with('-') ? "./" + path : path;
}

std::string path_word(const std::string& path) {
  return shell_word(as_path(path));
}

std::string markup_text(std::string_view text) {
  std::string out;
  for (const char c : printable(text)) {
    constexpr std::string_view special = "&<>\"";
    constexpr std::array entities{"&amp;", "&lt;", "&gt;", "&quot;"};
    const auto k = special.find(c);
    out += k == special.npos ? std::string(1, c) : entities[k];
  }
  return out;
}

std::string uri_of(std::string_view path) {
  std::string out = path.find(':') < path.find('/') ? "./" : "";  // else a scheme
  for (const char c : path)
    if (std::isalnum(static_cast<unsigned char>(c)) || std::string_view("-._~/:@").find(c) < 7)
      out += c;
    else
      out += fmt::format("%{:02X}", static_cast<unsigned char>(c));
  return out;
}

std::string printable_json(std::string json) {
  std::string out;
  std::size_t copied = 0;  // most documents have nothing to change, and are not copied
  for (std::size_t i = 0; i < json.size();) {
    const auto byte = [&](std::size_t k) -> unsigned {
      return i + k < json.size() ? static_cast<unsigned char>(json[i + k]) : 0;
    };
    const std::size_t n = byte(0) < 0x7f    ? 1
                          : byte(0) >= 0xf0 ? 4
                                            : length_if_printable(std::string_view(json).substr(i));
    if (n == 0) {
      const std::size_t length = byte(0) < 0x80 ? 1 : byte(0) < 0xe0 ? 2 : 3;
      const unsigned c = length == 1 ? byte(0)
                         : length == 2
                             ? (byte(0) & 0x1fU) << 6 | (byte(1) & 0x3fU)
                             : (byte(0) & 0xfU) << 12 | (byte(1) & 0x3fU) << 6 | (byte(2) & 0x3fU);
      out.append(json, copied, i - copied).append(fmt::format("\\u{:04x}", c));
      i = copied = std::min(i + length, json.size());
    }
    i += n;
  }
  return copied == 0 ? json : out.append(json, copied);
}

}  // namespace gonio
