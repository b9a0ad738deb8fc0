#include "base/error.h"

#include <fmt/format.h>

namespace gonio {
namespace {

std::string printable(const std::string& s) {
  constexpr std::size_t most = 80;
  std::string out;
  for (const char c : s.substr(0, most)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f)
      out += fmt::format("\\x{:02x}", byte);
    else
      out += c;
  }
  return s.size() > most ? out + "…" : out;
}

}  // namespace

Error bad_input(const std::string& file, const std::string& place, const std::string& found,
                const std::string& expected) {
  return {Exit::bad_input,
          fmt::format("{}: {}: found {}, expected {}", file, place, printable(found), expected)};
}

Error wrong_usage(const std::string& line) { return {Exit::usage, line}; }

}  // namespace gonio
