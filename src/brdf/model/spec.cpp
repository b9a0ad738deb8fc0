#include "brdf/model/spec.h"

#include <cmath>
#include <filesystem>

#include "base/error.h"
#include "base/numbers.h"
#include "base/text.h"
#include "foreign/function.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio {
namespace {

/// Parts of a model: a diffuse term and 16 lobes.  Each is read, drawn and integrated for itself, so a file's cost is bounded by
/// them.
constexpr std::size_t most_parts = 1 + 16;
constexpr std::string_view coat_word = "coat:";

std::vector<std::string> split_outside_braces(std::string_view text, char at) {
  std::vector<std::string> parts(1);
  int depth = 0;
  for (const char c : text) {
    depth += c == '{' ? 1 : c == '}' ? -1 : 0;
    if (c == at && depth <= 0)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

/// Names between slashes; the path of a person's file is one of them, from where there is such a file.
std::vector<std::string> names_of_part(std::string_view part, const std::string& document) {
  const auto folder = std::filesystem::path(document).parent_path();
  const auto raw = split_outside_braces(part, '/');
  std::vector<std::string> names;
  std::size_t first = 0;  // of the pieces that no name has
  for (std::size_t e = 0; e < raw.size(); ++e) {
    if (!foreign::is_name(raw[e])) continue;
    std::size_t from = e;
    for (std::size_t s = first; s < e; ++s) {
      const auto path =
          fmt::format("{}", fmt::join(raw.begin() + static_cast<std::ptrdiff_t>(s),
                                      raw.begin() + static_cast<std::ptrdiff_t>(e) + 1, "/"));
      if (foreign::is_there((folder / path).string())) {
        from = s;
        break;
      }
    }
    names.insert(names.end(), raw.begin() + static_cast<std::ptrdiff_t>(first),
                 raw.begin() + static_cast<std::ptrdiff_t>(from));
    names.push_back(
        fmt::format("{}", fmt::join(raw.begin() + static_cast<std::ptrdiff_t>(from),
                                    raw.begin() + static_cast<std::ptrdiff_t>(e) + 1, "/")));
    first = e + 1;
  }
  names.insert(names.end(), raw.begin() + static_cast<std::ptrdiff_t>(first), raw.end());
  return names;
}

}  // namespace

ModelSpec model_of_lobe(std::string_view ndf, std::string_view masking, std::string_view fresnel) {
  return {"", {{std::string(ndf), std::string(masking), std::string(fresnel)}}};
}

ModelSpec parse_model(std::string_view spec, const std::string& document) {
  auto written = split_outside_braces(spec, '+');
  if (written.size() > most_parts)
    throw wrong_usage(
        fmt::format("model '{}': {} parts, where {} lobes and a diffuse term are most",
                    printable(spec, 80), written.size(), most_parts - 1));
  const bool coated = written.size() > 1 && written.back().starts_with(coat_word);
  if (coated) written.back().erase(0, coat_word.size());
  ModelSpec m;
  for (const auto& part : written) {
    auto names = names_of_part(part, document);
    if (names.size() != 1 && names.size() != 3)
      throw wrong_usage(fmt::format(
          "model '{}': '{}' is neither a diffuse term nor NDF/MASKING/FRESNEL", spec, part));
    for (const auto& n : names)
      if (n.empty()) throw wrong_usage(fmt::format("model '{}': a name is missing", spec));
    if (names.size() == 3)
      m.lobes.push_back({std::move(names[0]), std::move(names[1]), std::move(names[2])});
    else if (&part == &written.front())
      m.diffuse = std::move(names[0]);
    else
      throw wrong_usage(fmt::format("model '{}': one diffuse term at most, and first", spec));
  }
  if (coated) m.coat = std::move(m.lobes.back()), m.lobes.pop_back();
  return m;
}

std::string to_text(const ModelSpec& m) {
  std::string text = m.diffuse;
  const auto add = [&](std::string_view word, const LobeSpec& l) {
    text += fmt::format("{}{}{}/{}/{}", text.empty() ? "" : "+", word, l.ndf, l.masking, l.fresnel);
  };
  for (const auto& l : m.lobes) add("", l);
  if (m.coat) add(coat_word, *m.coat);
  return text;
}

ModelSpec coat_as_lobe(ModelSpec m) {
  if (m.coat) m.lobes.push_back(*m.coat);
  m.coat.reset();
  return m;
}

ParameterId parse_parameter(std::string_view name) {
  if (const auto at = name.rfind('_'); at != name.npos)
    if (const auto lobe = number_from<std::size_t>(name.substr(at + 1));
        lobe && *lobe > 1 && name[at + 1] > '0')
      return {std::string(name.substr(0, at)), *lobe - 1};
  return {std::string(name)};
}

std::string to_text(const ParameterId& p) {
  return p.lobe == 0 ? p.name : fmt::format("{}_{}", p.name, p.lobe + 1);
}

double parse_number(std::string_view text, const std::string& what) {
  const auto value = number_from<double>(text);
  if (!value || !std::isfinite(*value))
    throw wrong_usage(fmt::format("{}: '{}' is not a number", what, text));
  return *value;
}

std::vector<Setting> parse_settings(std::span<const std::string> words) {
  std::vector<Setting> settings;
  for (const auto& word : words)
    for (const auto& item : split(word, ',')) {
      const auto equals = item.find('=');
      std::string_view value = item;
      if (equals != std::string::npos) {
        Setting s{item.substr(0, equals), {}};
        for (const auto& other : settings)
          if (other.name == s.name) throw wrong_usage(fmt::format("'{}' is set twice", s.name));
        settings.push_back(std::move(s));
        value.remove_prefix(equals + 1);
      }
      if (settings.empty())
        throw wrong_usage(fmt::format("'{}' is not of the form NAME=VALUE", item));
      auto& s = settings.back();
      if (s.name == "metal") {
        if (!s.text.empty())
          throw wrong_usage(fmt::format("metal: found {} and {}, expected one", s.text, value));
        s.text = value;
        if (const auto number = number_from<double>(value)) s.values = {*number};  // a shader's own
      } else
        s.values.push_back(parse_number(value, s.name));
    }
  return settings;
}

}  // namespace gonio
