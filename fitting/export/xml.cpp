#include "fitting/export/xml.h"

#include "base/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio {

std::string xml_numbers(const std::vector<double>& v) {
  return fmt::format("{:.9g}", fmt::join(v, ", "));
}

std::string xml_file(const std::string& elements,
                     const std::string& what,
                     const std::string& document) {
  std::string all = "<?xml version=\"1.0\"?>\n<!-- gonio: " + what + "\n";
  for (const char c : document)
    if (c == '-' && all.back() == '-')
      all += "\\u002d";
    else
      all += c;
  all += "\n-->\n";
  std::size_t depth = 0;
  for (const auto& line : split(elements, '\n')) {
    if (line.empty()) continue;
    const bool closes = line.starts_with("</"), opens = !closes && !line.ends_with("/>");
    if (closes) --depth;
    all += std::string(2 * depth, ' ') + line + "\n";
    if (opens) ++depth;
  }
  return all;
}

}  // namespace gonio
