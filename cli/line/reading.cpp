#include "cli/line/reading.h"

#include <filesystem>

#include "base/error.h"
#include "base/file.h"
#include "brdf/model/fitted_model.h"
#include "brdf/model/own_files.h"
#include "foreign/function.h"

#include <fmt/format.h>

namespace gonio::cli {

void add_reading(Command& c, ReadingWords& words, bool bounds) {
  c.option("--argument", words.arguments,
           "For a shader's function: what an argument stands for, x=noh; n=parameter; spec=f0 for "
           "the role of a parameter")
      .at_most(64);
  c.option("--includes", words.includes,
           "For a shader's function: what its value has beside f: nothing, cosine (times NoL), pi "
           "(times π), cosine,pi; of a masking function g or v");
  if (bounds)
    c.option("--bounds", words.bounds,
             "For a shader's function: NAME=LOW,HIGH[,DEFAULT] of a parameter, or NAME=VALUE")
        .at_most(64);
}

bool names_table(const std::string& word) {
  std::error_code none;
  if (foreign::is_name(word) || word.ends_with(".json") ||
      !std::filesystem::is_regular_file(word, none))
    return false;
  InputFile in(word);
  return !begins_as_fit(in.peek(256));  // a table's bytes do not
}

std::string read_as(const std::string& spec, const ReadingWords& words) {
  if (words.arguments.empty() && words.bounds.empty() && !words.includes) return spec;
  bool any = false;
  const auto read = with_own_names(spec, [&](const std::string& name) {
    any = true;
    std::string options;
    const auto add = [&](const std::string& o) { options += (options.empty() ? "" : ";") + o; };
    for (const auto& a : words.arguments) add("argument." + a);
    for (const auto& b : words.bounds) add(b);
    if (words.includes) add("includes=" + *words.includes);
    const auto close = name.rfind('}');
    return foreign::text_of(foreign::parse_name(
        close == name.npos ? fmt::format("{}{{{}}}", name, options)
                           : fmt::format("{};{}}}", name.substr(0, close), options)));
  });
  if (!any)
    throw wrong_usage(fmt::format(
        "--argument, --includes and --bounds go with a shader's function, not with {}", spec));
  return read;
}

}  // namespace gonio::cli
