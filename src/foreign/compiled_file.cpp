#include "foreign/compiled_file.h"

#include <algorithm>
#include <mutex>
#include <stdexcept>
#include <utility>

#include "base/error.h"
#include "base/numbers.h"
#include "foreign/compile.h"
#include "foreign/function.h"

#include <fmt/format.h>

namespace gonio::foreign {

[[noreturn]] void refuse(const std::string& file, const Refused& r) {
  throw bad_input(file, r.line > 0 ? fmt::format("line {}", r.line) : "the whole file", r.what(),
                  "a function of numbers that ends");
}

namespace {

/// OpTypeVoid, OpTypeStruct
constexpr std::uint32_t spirv_void = 19, spirv_struct = 30;

std::mutex files_mutex;
std::map<std::string, std::shared_ptr<const Compiled>>& files() {
  static std::map<std::string, std::shared_ptr<const Compiled>> all;
  return all;
}

/// The person's name of a function; empty where it is none of theirs.
std::string name_of(const SpirvModule& m, Id id, Language language) {
  auto name = m.short_name(id);
  if (name == "person_main") return "main";  // as a text's own main is compiled
  const bool is_ours = name.starts_with("gonio_") || name.starts_with("@gonio_") ||
                       (name == "main" && language != Language::spirv);
  return is_ours ? "" : name;
}

/// Takes functions that give a number or a colour, and those that give nothing; the last of those that share a name.
void take_functions(Compiled& c) {
  const SpirvModule& m = *c.module;
  for (const auto& [id, f] : m.functions()) {
    const auto name = name_of(m, id, c.source.language);
    if (name.empty()) continue;
    const bool is_value = m.is_of_numbers(f.result) && m.type(f.result).op != spirv_struct;
    const auto size = is_value ? m.size(f.result) : 0;
    if (size == 1 || size == 3 || size == 4) {
      const auto [known, is_new] = c.functions.try_emplace(name, id);
      if (!is_new) c.shadowed.emplace_back(name, std::exchange(known->second, id));
    }
    if (m.type(f.result).op == spirv_void) c.void_functions[name] = id;
  }
}

/// Line of the first array of a text with more elements than are taken, which a module names without its line; 0: none.
int line_of_array(std::string_view text) {
  constexpr double most = 4096;
  int line = 1;
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text[k] == '\n') ++line;
    if (text[k] != '[') continue;
    const auto close = std::min(text.find(']', k), text.size());
    if (number_from<double>(text.substr(k + 1, close - k - 1)).value_or(0) > most) return line;
  }
  return 0;
}

std::shared_ptr<const Compiled> compiled(Source source) {
  auto c = std::make_shared<Compiled>(Compiled{std::move(source), nullptr, {}, {}, {}});
  try {
    c->module = std::make_unique<SpirvModule>(compile(c->source));
    take_functions(*c);
  } catch (const Refused& r) {
    refuse(c->source.path, r.line > 0 ? r : Refused(r.what(), line_of_array(c->source.text)));
  } catch (const std::out_of_range&) {
    throw bad_input(c->source.path, "the whole file", "SPIR-V that refers to what it has not",
                    "a module of functions");
  }
  return c;
}

}  // namespace

std::shared_ptr<const Compiled> file_of(const std::string& path) {
  const std::lock_guard lock(files_mutex);
  auto& known = files()[path];
  if (!known) known = compiled(read_source(path));
  return known;
}

[[noreturn]] void refuse_nameless(const Compiled& c, const std::string& path) {
  throw bad_input(
      path, "the whole file", "no function that gives a number or a colour",
      c.source.language == Language::spirv
          ? "one with its name: some compilers leave names out, as glslang does with -g0"
          : "one");
}

std::string sha256_of(const std::string& file) {
  return file_of(file)->source.sha256;
}

std::size_t steps_of(const std::string& file) {
  return file_of(file)->module->steps;
}

void provide(const std::string& file, const std::string& content) {
  auto made = compiled(source_of(file, content));
  const std::lock_guard lock(files_mutex);
  files()[file] = std::move(made);
}

}  // namespace gonio::foreign
