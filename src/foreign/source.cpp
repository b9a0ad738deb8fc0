#include "foreign/source.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include "base/error.h"
#include "base/file.h"
#include "base/numbers.h"
#include "base/sha256.h"
#include "base/text.h"

#include <fmt/format.h>

namespace gonio::foreign {
namespace {

constexpr std::uint64_t most_bytes = 1 << 20;

const std::map<std::string_view, Language>& languages() {
  static const std::map<std::string_view, Language> all{{".brdf", Language::glsl},
                                                        {".glsl", Language::glsl},
                                                        {".frag", Language::glsl},
                                                        {".hlsl", Language::hlsl},
                                                        {".spv", Language::spirv}};
  return all;
}

std::string_view ending_of(std::string_view path) {
  const auto dot = path.rfind('.');
  return dot == path.npos ? std::string_view() : path.substr(dot);
}

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  while (true) {
    const auto from = line.find_first_not_of(" \t\r,");
    if (from == line.npos) return words;
    line.remove_prefix(from);
    const auto end = std::min(line.find_first_of(" \t\r,"), line.size());
    words.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
}

bool is_identifier(std::string_view s) {
  return !s.empty() && !std::isdigit(static_cast<unsigned char>(s[0])) &&
         std::ranges::all_of(
             s, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; });
}

/// A line of a .brdf file's parameters: "float NAME MIN MAX DEFAULT", "color NAME R G B", "bool NAME 0".
Declared declared_in(const std::string& path, int number, std::span<const std::string_view> words) {
  const auto fail = [&](std::string_view found) {
    return bad_input(path, fmt::format("line {}", number), std::string(found),
                     "float NAME MIN MAX DEFAULT, color NAME R G B or bool NAME 0");
  };
  Declared d;
  d.line = number;
  std::vector<double> values;
  if (words.size() < 2 || !is_identifier(words[1])) throw fail(words[0]);
  d.name = words[1];
  for (const auto w : words.subspan(2)) {
    const auto v = number_from<double>(w);
    if (!v || !std::isfinite(*v)) break;
    values.push_back(*v);
  }
  if (words[0] == "float" && values.size() >= 3) {
    d.range = {values[0], values[1]};
    d.start = {values[2]};
  } else if (words[0] == "color" && values.size() >= 3) {
    d.start = {values[0], values[1], values[2]};
  } else if (words[0] == "bool" && !values.empty()) {
    d.is_bool = true;
    d.start = {values[0]};
  } else {
    throw fail(fmt::format("{}", fmt::join(words, " ")));
  }
  if (!(d.range.low <= d.range.high)) throw fail("bounds in the wrong order");
  return d;
}

/// A comment "// alpha 0.001 1 0.2" (the default may be absent), or "// … parameter alpha in [0.001, 1]" as gonio writes it.
/// "// f90 1 1" fixes it.
std::optional<Declared> declared_by_comment(int number, std::string_view line) {
  const auto at = line.find("//");
  if (at == line.npos) return {};
  std::string text(line.substr(at + 2));
  if (const auto said = text.find("parameter ");
      said != text.npos && text.find(" in [", said) != text.npos) {
    text = text.substr(said + 10);
    text.replace(text.find(" in ["), 5, " ");
    std::ranges::replace_if(
        text, [](char c) { return c == ',' || c == ']'; }, ' ');
  }
  const auto words = words_of(text);
  if (words.size() < 3 || !is_identifier(words[0])) return {};
  std::vector<double> v;
  for (const auto w : std::span(words).subspan(1)) {
    const auto x = number_from<double>(w);
    if (!x || !std::isfinite(*x)) break;
    v.push_back(*x);
  }
  if (v.size() < 2 || !(v[0] <= v[1])) return {};
  Declared d{std::string(words[0]), {v[0], v[1]}, {}, false, number};
  if (v.size() > 2 && d.range.holds(v[2])) d.start = {v[2]};
  if (d.is_fixed()) d.start = {v[0]};
  return d;
}

/// A declaration without the qualifiers by which it belongs to a shader's interface; as it is where it has none of "in" and "out".
std::string_view without_interface(std::string_view declaration) {
  static constexpr std::string_view interpolation[] = {"flat",     "smooth", "noperspective",
                                                       "centroid", "highp",  "mediump",
                                                       "lowp"},
                                    between[] = {"in", "out", "varying", "attribute"};
  std::string_view rest = declaration;
  bool is_between = false;
  while (true) {
    rest.remove_prefix(std::min(rest.find_first_not_of(" \t\r"), rest.size()));
    const auto word = rest.substr(0, std::min(rest.find_first_of(" \t\r("), rest.size()));
    if (word == "layout" && rest.find(')') != rest.npos) {
      rest.remove_prefix(rest.find(')') + 1);
      continue;
    }
    const bool is_next = std::ranges::find(between, word) != std::end(between);
    if (!is_next && std::ranges::find(interpolation, word) == std::end(interpolation)) break;
    is_between = is_between || is_next;
    rest.remove_prefix(word.size());
  }
  return is_between && rest.find_first_of("({") == rest.npos ? rest : declaration;
}

/// A line outside functions, each of its declarations without what belongs to a shader's interface.
std::string without_stages(std::string_view line) {
  const auto end = std::min(line.find("//"), line.size());
  std::string s;
  std::size_t from = 0;
  for (auto semicolon = line.find(';'); semicolon < end; semicolon = line.find(';', from)) {
    s += without_interface(line.substr(from, semicolon + 1 - from));
    from = semicolon + 1;
  }
  return s + std::string(line.substr(from));
}

/// A line as the compiler takes it: without what belongs to a whole shader, its interface to other stages included.
std::string plain_line(const std::string& path, int number, std::string_view line, int depth) {
  const auto words = words_of(line);
  if (words.empty()) return std::string(line);
  const auto first = words[0];
  if (first.starts_with("#include") || (first == "#" && words.size() > 1 && words[1] == "include"))
    throw bad_input(path, fmt::format("line {}", number), std::string(line),
                    "a text without #include: no other file is read");
  if (first == "#version" || first == "#extension" || first == "precision") return "";
  return depth == 0 ? without_stages(line) : std::string(line);
}

/// The text of a .brdf file's shader, after the declarations of its parameters.
void read_explorer(Source& s, const std::vector<std::string>& lines) {
  std::string section, shader;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const std::string_view line = lines[k];
    const int number = static_cast<int>(k) + 1;
    const auto words = words_of(line);
    const bool marks = !words.empty() && words[0].starts_with("::");
    if (marks) section = words.size() > 1 && words[0] == "::begin" ? std::string(words[1]) : "";
    if (section == "parameters" && !marks && !words.empty() && words[0][0] != '#')
      s.declare(declared_in(s.path, number, words));
    shader += section == "shader" && !marks ? plain_line(s.path, number, line, 1) + "\n" : "\n";
  }
  std::string head;
  for (const auto& d : s.declared)
    head += fmt::format("{} {}; ",
                        d.is_bool             ? "bool"
                        : d.start.size() == 3 ? "vec3"
                                              : "float",
                        d.name);
  s.text = head + shader;  // in one line: the others keep their numbers
  if (shader.find_first_not_of("\n") == shader.npos)
    throw bad_input(s.path, "the whole file", "no shader", "::begin shader … ::end shader");
}

}  // namespace

void Source::declare(Declared d) {
  first_.try_emplace(d.name, declared.size());
  declared.push_back(std::move(d));
}

const Declared* Source::find(std::string_view name) const {
  const auto at = first_.find(name);
  return at == first_.end() ? nullptr : &declared[at->second];
}

bool is_source_name(std::string_view path) {
  return languages().contains(ending_of(path));
}

Source read_source(const std::string& path) {
  InputFile file(path);
  will_read(path);
  return source_of(path, file.read_rest(most_bytes));
}

Source source_of(const std::string& path, const std::string& content) {
  const auto language = languages().find(ending_of(path));
  if (language == languages().end())
    throw wrong_usage(fmt::format("{}: expected .brdf, .glsl, .frag, .hlsl or .spv", path));
  Source s;
  s.path = path;
  s.language = language->second;
  s.explorer = path.ends_with(".brdf");
  s.text = content;
  s.sha256 = sha256(content);
  if (s.language == Language::spirv) return s;
  if (content.find('\0') != content.npos)
    throw bad_input(path, "the whole file", "bytes that are no text", "a shader's text");
  constexpr std::string_view mark = "\xEF\xBB\xBF";  // of UTF-8, which some editors write first
  const auto lines = split(s.text.starts_with(mark) ? content.substr(mark.size()) : content, '\n');
  if (s.explorer) {
    read_explorer(s, lines);
    return s;
  }
  s.text.clear();
  int depth = 0;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const int number = static_cast<int>(k) + 1;
    if (auto d = declared_by_comment(number, lines[k]); d && !s.find(d->name))
      s.declare(std::move(*d));
    s.text += plain_line(path, number, lines[k], depth) + "\n";
    for (const char c : lines[k]) depth += c == '{' ? 1 : c == '}' ? -1 : 0;
  }
  return s;
}

}  // namespace gonio::foreign
