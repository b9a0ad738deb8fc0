#include "answer/file_functions.h"

#include <algorithm>
#include <set>

#include "base/error.h"
#include "base/json/describe.h"
#include "base/text.h"
#include "brdf/cost/model_operations.h"
#include "brdf/model/own_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

std::string_view what_it_gives(const foreign::Function& f) {
  switch (f.stands) {
    case foreign::Stands::distribution:
      return "a distribution D";
    case foreign::Stands::masking:
      return f.is_g ? "masking as G; V = G/(4 NoL NoV)" : "masking as V";
    case foreign::Stands::fresnel:
      return "a Fresnel term";
    case foreign::Stands::lobe:
      break;
  }
  return !takes_direction(f) ? "a helper, which takes no direction"
         : takes_light(f)    ? "a whole model"
                             : "a value of one direction";
}

constexpr std::string_view unclear_text =
    " (not clear: an albedo is near neither 1 nor π; --includes says it)";

std::string includes_text(const foreign::Function& f) {
  if (f.stands != foreign::Stands::lobe || !takes_light(f)) return "";
  const std::string what = f.includes == "nothing"  ? "no cosine and no factor of π"
                           : f.includes == "cosine" ? "the cosine NoL, which is taken out"
                           : f.includes == "pi"     ? "a factor of π, which is taken out"
                                                    : "NoL and a factor of π, which are taken out";
  return fmt::format("{}{}", what,
                     f.unclear   ? unclear_text
                     : f.guessed ? " (guessed from reciprocity and albedo; --includes says it)"
                                 : "");
}

Json json_of(const FileFunction& of) {
  Json j{{"function", of.entry.function}, {"line", of.entry.line}};
  if (!of.function) {
    j["refused"] = of.entry.refused;
    return j;
  }
  const auto& f = *of.function;
  j["stands_for"] = name_of(f.stands);
  j["includes"] = f.includes;
  j["guessed"] = f.guessed;
  j["unclear"] = f.unclear;
  j["anisotropic"] = f.anisotropic;
  j["operations"] = of.operations.total();
  Json arguments = Json::array(), parameters = Json::array(), notes = Json::array();
  for (const auto& a : f.arguments)
    arguments.push_back({{"name", a.name}, {"stands_for", a.stands_for}});
  for (const auto& p : f.parameters) {
    Json q{{"name", p.name}, {"per_channel", p.per_channel}};
    if (p.bounded)
      q["low"] = p.range.low, q["high"] = p.range.high,
      q["default"] = p.colour ? Json(*p.colour) : Json(p.start);
    parameters.push_back(q);
  }
  for (const auto& n : f.notes) notes.push_back({{"line", n.line}, {"note", n.text}});
  j["arguments"] = arguments;
  j["parameters"] = parameters;
  j["notes"] = notes;
  return j;
}

/// For reading all functions of a file, a few seconds.
constexpr std::size_t most_steps = 8'000'000;

/// Reading that a person asks for of a file's functions, and which words of it were used.
struct Said {
  const foreign::Reading& all;
  std::set<std::string> used{};

  /// The part that goes with a function.
  foreign::Reading of(const FileFunction& f) {
    const auto has = [&](const std::string& name) {
      const bool is_there = std::ranges::find(f.entry.arguments, name) != f.entry.arguments.end() ||
                            (f.function && std::ranges::find(f.function->parameters, name,
                                                             &foreign::FunctionParameter::name) !=
                                               f.function->parameters.end());
      if (is_there) used.insert(name);
      return is_there;
    };
    foreign::Reading part;
    for (const auto& a : all.arguments)
      if (has(a.first)) part.arguments.insert(a);
    for (const auto& v : all.values)
      if (has(v.first)) part.values.insert(v);
    if (!all.includes || !f.function) return part;
    const bool of_masking = *all.includes == "g" || *all.includes == "v";
    if (f.function->stands == (of_masking ? foreign::Stands::masking : foreign::Stands::lobe)) {
      part.includes = all.includes;
      used.insert(includes_option);
    }
    return part;
  }
  void expect_all_used(const std::string& file) const {
    const auto expect = [&](const std::string& name) {
      if (!used.contains(name))
        throw wrong_usage(fmt::format("{}: no function has {}", file,
                                      name == includes_option
                                          ? "a value that may include " + *all.includes
                                          : "an argument or a parameter '" + name + "'"));
    };
    for (const auto& [name, stands_for] : all.arguments) expect(name);
    for (const auto& [name, value] : all.values) expect(name);
    if (all.includes) expect(includes_option);
  }
  static constexpr const char* includes_option = "--includes";
};

}  // namespace

void add_own_files(Json& document, const std::string& spec) {
  const auto files = own_files({spec});
  if (!files.empty()) document[std::string(own_files_key)] = json_of(files);
}

FileFunctions file_functions(const std::string& token) {
  const auto name = foreign::parse_name(token);
  FileFunctions all{name.file, {}, {}};
  auto entries = foreign::list_functions(name.file);
  if (!name.function.empty())
    std::erase_if(entries,
                  [&](const auto& e) { return e.function != name.function || e.is_shadowed; });
  if (entries.empty()) foreign::read_function(name);  // says what is wrong
  Said said{name.reading};
  const std::size_t before = foreign::steps_of(name.file);
  for (auto& e : entries) {
    FileFunction f{std::move(e), {}, {}};
    if (name.function.empty() && foreign::steps_of(name.file) - before > most_steps)
      f.entry.refused = bad_input(name.file, fmt::format("line {}", f.entry.line),
                                  fmt::format("functions of more than {} steps before", most_steps),
                                  fmt::format("it to be named: {}:{}", name.file, f.entry.function))
                            .what();
    if (!f.entry.refused.empty()) {
      all.functions.push_back(std::move(f));
      continue;
    }
    foreign::Name one{name.file, f.entry.function};
    const auto read = [&] {
      try {
        f.function = foreign::read_function(one);
        f.entry.refused.clear();
      } catch (const Error& error) {
        if (!name.function.empty()) throw;
        f.function.reset();
        f.entry.refused = error.what();
      }
    };
    if (!name.function.empty()) {
      one.reading = name.reading;
      read();
    } else {
      // What is said may be why it can be read, and what its value is decides what that may
      // include.
      for (int turn = 0; turn < 3; ++turn) {
        if (turn > 0 && one.reading == said.of(f)) break;
        if (turn > 0) one.reading = said.of(f);
        read();
      }
    }
    if (f.function) {
      const bool colour =
          f.function->programs.size() > 1 ||
          std::ranges::any_of(f.function->parameters, &foreign::FunctionParameter::per_channel);
      f.operations = operations_of(*f.function, colour ? 3 : 1);
      all.sha256 = f.function->sha256;
    }
    all.functions.push_back(std::move(f));
  }
  if (name.function.empty()) said.expect_all_used(name.file);
  return all;
}

std::string to_json(const FileFunctions& all) {
  Json functions = Json::array();
  for (const auto& f : all.functions) functions.push_back(json_of(f));
  return text_of(Json{{"file", all.file}, {"sha256", all.sha256}, {"functions", functions}});
}

std::string text_of(const FileFunctions& all) {
  std::string s;
  const auto line = [&](const char* name, const std::string& text) {
    if (!text.empty()) s += fmt::format("  {:<12}{}\n", name, text);
  };
  for (const auto& of : all.functions) {
    s += fmt::format("{}:{}", all.file, of.entry.function);
    s += of.entry.line > 0 ? fmt::format(", line {}\n", of.entry.line) : "\n";
    if (!of.function) {
      line("refused", printable(of.entry.refused, 400));
      continue;
    }
    const auto& f = *of.function;
    line("gives",
         fmt::format("{}, {} operations a sample", what_it_gives(f), of.operations.total()));
    line("includes", includes_text(f));
    std::vector<std::string> directions;
    for (const auto& a : f.arguments)
      if (a.stands_for != "parameter")
        directions.push_back(fmt::format("{} = {}", a.name, a.stands_for));
    line("arguments", fmt::format("{}", fmt::join(directions, ", ")));
    for (const auto& p : f.parameters)
      line(&p == f.parameters.data() ? "parameters" : "",
           p.bounded ? fmt::format("{}{} in [{:g}, {:g}], default {}", p.name,
                                   p.per_channel ? " (a colour)" : "", p.range.low, p.range.high,
                                   p.colour ? fmt::format("{:g}", fmt::join(*p.colour, ", "))
                                            : fmt::format("{:g}", p.start))
                     : fmt::format("{}{}: no bounds; {} gives them", p.name,
                                   p.per_channel ? " (a colour)" : "",
                                   all.file.ends_with(".spv")
                                       ? "--bounds " + p.name + "=LOW,HIGH"
                                       : "a comment \"// " + p.name + " LOW HIGH DEFAULT\""));
    if (f.float_constants) line("constants", "in float: HLSL and SPIR-V hold no more digits");
    for (const auto& n : f.notes) line("note", fmt::format("line {}: {}", n.line, n.text));
  }
  return s;
}

}  // namespace gonio
