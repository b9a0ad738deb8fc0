#include "base/error.h"

#include "base/text.h"

#include <fmt/format.h>

namespace gonio {

Error bad_input(const std::string& file,
                const std::string& place,
                const std::string& found,
                const std::string& expected) {
  return {Exit::bad_input,
          fmt::format("{}: {}: found {}, expected {}", printable(file, 1024), printable(place, 120),
                      printable(found, 80), printable(expected, 240))};
}

Error wrong_usage(const std::string& line) {
  std::string short_words;
  for (const auto& word : split(line, ' '))
    short_words += (short_words.empty() ? "" : " ") + printable(word, 200);
  return {Exit::usage, printable(short_words, 1000)};
}

NameTaken::NameTaken(const std::string& line) : std::runtime_error(wrong_usage(line).what()) {}

}  // namespace gonio
