#include "base/error.h"

#include "base/text.h"

#include <fmt/format.h>

namespace gonio {

Error bad_input(const std::string& file,
                const std::string& place,
                const std::string& found,
                const std::string& expected) {
  return {Exit::bad_input,
          fmt::format("{}: {}: found {}, expected {}", printable(file), printable(place, 120),
                      printable(found, 80), printable(expected, 240))};
}

Error wrong_usage(const std::string& line) {
  return {Exit::usage, line};
}

}  // namespace gonio
