#include "base/text.h"

namespace gonio {

std::vector<std::string> split(std::string_view s, char at) {
  std::vector<std::string> parts;
  for (;;) {
    const auto i = s.find(at);
    parts.emplace_back(s.substr(0, i));
    if (i == s.npos) return parts;
    s.remove_prefix(i + 1);
  }
}

}  // namespace gonio
