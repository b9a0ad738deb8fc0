// How a function of a file is named, and its value in double.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/error.h"
#include "base/numbers.h"
#include "base/text.h"
#include "foreign/function.h"
#include "foreign/interpret.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio::foreign {

namespace {

/// What an argument that is fixed stands for is its value.
bool is_number(const std::string& s) {
  return number_from<double>(s).has_value();
}

}  // namespace

Name parse_name(std::string_view token) {
  Name n;
  std::string_view options;
  if (const auto brace = token.find('{'); brace != token.npos) {
    if (!token.ends_with('}'))
      throw wrong_usage(
          fmt::format("'{}': expected FILE:FUNCTION{{NAME=VALUE;…}}", printable(token, 80)));
    options = token.substr(brace + 1, token.size() - brace - 2);
    token = token.substr(0, brace);
  }
  const auto colon = token.rfind(':');
  if (colon != token.npos && is_source_name(token.substr(0, colon))) {
    n.function = token.substr(colon + 1);
    token = token.substr(0, colon);
  }
  n.file = token;
  if (!is_source_name(n.file))
    throw wrong_usage(
        fmt::format("'{}' is no shader: expected a name that ends in .brdf, .glsl, .frag, "
                    ".hlsl or .spv",
                    printable(token, 80)));
  // It becomes a comment in shaders that gonio writes, and a line on a terminal.
  if (printable(n.file) != n.file)
    throw bad_input(n.file, "its name", "letters that cannot be seen", "others");
  for (const auto& o : split(options, ';')) {
    if (o.empty()) continue;
    const auto equals = o.find('=');
    if (equals == o.npos)
      throw wrong_usage(fmt::format("'{}' of {}: expected NAME=VALUE", printable(o, 80), n.file));
    const std::string key = o.substr(0, equals), value = o.substr(equals + 1);
    if (key == "includes") {
      n.reading.includes = value;
    } else if (key.starts_with("argument.")) {
      n.reading.arguments[key.substr(9)] = value;
    } else {
      std::vector<double> v;
      for (const auto& x : split(value, ',')) {
        const auto number = number_from<double>(x);
        if (!number || !std::isfinite(*number))
          throw wrong_usage(
              fmt::format("{}={}: '{}' is not a number", key, value, printable(x, 40)));
        v.push_back(*number);
      }
      if (v.size() > 3 || (v.size() > 1 && !(v[0] < v[1])) ||
          (v.size() == 3 && !(v[0] <= v[2] && v[2] <= v[1])))
        throw wrong_usage(
            fmt::format("{}={}: expected a value, LOW,HIGH or LOW,HIGH,DEFAULT", key, value));
      n.reading.values[key] = v;
    }
  }
  return n;
}

std::string text_of(const Name& n) {
  std::string s = n.file + (n.function.empty() ? "" : ":" + n.function);
  std::vector<std::string> options;
  for (const auto& [a, b] : n.reading.arguments)
    options.push_back(fmt::format("argument.{}={}", a, b));
  if (n.reading.includes) options.push_back("includes=" + *n.reading.includes);
  for (const auto& [a, v] : n.reading.values)
    options.push_back(fmt::format("{}={}", a, fmt::join(v, ",")));
  if (!options.empty()) s += fmt::format("{{{}}}", fmt::join(options, ";"));
  return s;
}

bool is_name(std::string_view text) {
  text = text.substr(0, text.find('{'));
  if (is_source_name(text)) return true;
  const auto colon = text.rfind(':');
  return colon != text.npos && is_source_name(text.substr(0, colon)) &&
         text.substr(colon).find('/') == text.npos;
}

bool is_there(std::string_view name) {
  std::error_code error;
  name = name.substr(0, name.find('{'));
  const auto colon = name.rfind(':');
  return std::filesystem::exists(name.substr(0, is_source_name(name) ? name.size() : colon), error);
}

bool takes_direction(const Function& f) {
  static constexpr std::string_view none[] = {"parameter", "N", "X", "Y"};
  return std::ranges::any_of(f.arguments, [](const Argument& a) {
    return std::ranges::find(none, a.stands_for) == std::end(none) && !is_number(a.stands_for);
  });
}
bool takes_light(const Function& f) {
  static constexpr std::string_view of_view[] = {"V",         "nov", "xov", "yov",
                                                 "parameter", "N",   "X",   "Y"};
  return std::ranges::any_of(f.arguments, [](const Argument& a) {
    return std::ranges::find(of_view, a.stands_for) == std::end(of_view) &&
           !is_number(a.stands_for);
  });
}

std::vector<double> value_of(const Function& f,
                             const std::vector<double>& parameters,
                             const std::array<double, 11>& angles) {
  std::vector<double> out;
  for (const auto& p : f.programs) {
    Interpreter<double> run(p);
    run.set(parameters);
    run.run(
        1, [&](std::size_t k, std::size_t) { return angles[k]; },
        [&](std::size_t, std::size_t, double v) { out.push_back(v); });
  }
  return out;
}

}  // namespace gonio::foreign
