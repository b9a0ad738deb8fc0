#include "foreign/compile.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <fstream>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "base/numbers.h"
#include "base/process.h"

#include <fmt/format.h>
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>
#include <spirv-tools/libspirv.hpp>
#include <sys/resource.h>
#include <unistd.h>

namespace gonio::foreign {
namespace {

constexpr rlim_t most_seconds = 10, most_memory = rlim_t{1} << 30;
/// The validator's time grows with the square of a module's blocks.
constexpr std::size_t most_words = 400'000;
constexpr std::uint16_t op_source_continued = 2, op_source = 3, op_source_extension = 4;

/// GLSL's own functions that take no doubles, declared so that they do: a name of ours, and a macro.
std::string functions_of_doubles() {
  std::string s;
  const auto declare = [&](const std::string& f, int arguments) {
    const std::string name = "gonio_" + f;
    s += arguments == 1 ? fmt::format("double {}(double x){{return x;}}\n", name)
                        : fmt::format("double {}(double x,double y){{return x+y;}}\n", name);
    for (int n = 2; n <= 4; ++n) {
      std::string parts;
      for (const char c : std::string_view("xyzw").substr(0, static_cast<std::size_t>(n)))
        parts += fmt::format("{}{}(x.{}{})", parts.empty() ? "" : ",", name, c,
                             arguments == 2 ? fmt::format(",y.{}", c) : "");
      s += fmt::format("dvec{0} {1}(dvec{0} x{2}){{return dvec{0}({3});}}\n", n, name,
                       arguments == 2 ? fmt::format(",dvec{} y", n) : "", parts);
    }
    if (f != "atan" || arguments == 2) s += fmt::format("#define {} {}\n", f, name);
  };
  for (const char* f : {"exp", "log", "exp2", "log2", "sin", "cos", "tan", "asin", "acos", "atan"})
    declare(f, 1);
  for (const char* f : {"pow", "atan"}) declare(f, 2);
  return s;
}

/// Declares texture functions for doubles: a file that has them compiles, and only functions that read a texture are refused.
std::string textures_of_doubles() {
  std::string s;
  for (const auto& [sampler, n] : {std::pair{"sampler2D", 2}, {"samplerCube", 3}, {"sampler3D", 3}})
    for (const auto& [f, more] : {std::pair{"texture", ""}, {"textureLod", ",double l"}})
      s += fmt::format(
          "dvec4 gonio_{0}({1} s,dvec{2} p{3}){{return dvec4(textureLod(s,vec{2}(p),0.0));}}\n", f,
          sampler, n, more);
  return s +
         "#define texture gonio_texture\n#define texture2D gonio_texture\n#define textureCube "
         "gonio_texture\n"
         "#define textureLod gonio_textureLod\n";
}

std::string head_of(Language language) {
  if (language == Language::hlsl) return "#define main person_main\n";
  std::string s = "#version 450\n" + functions_of_doubles() + textures_of_doubles();
  s += "#define radians(x) ((x)*(3.14159265358979323846lf/180.0lf))\n"
       "#define degrees(x) ((x)*(180.0lf/3.14159265358979323846lf))\n"
       "#define float double\n#define main person_main\n";
  for (int n = 2; n <= 4; ++n)
    s += fmt::format("#define vec{0} dvec{0}\n#define mat{0} dmat{0}\n", n);
  return s;
}

/// Drops the instructions that name the source's language, which an older validator may not know.
std::vector<std::uint32_t> without_language(const std::vector<std::uint32_t>& words) {
  if (words.size() < 5) return words;
  std::vector<std::uint32_t> out(words.begin(), words.begin() + 5);
  for (std::size_t at = 5; at < words.size();) {
    const std::uint32_t length = std::max(words[at] >> 16, 1U), op = words[at] & 0xffff;
    const auto end = std::min(words.size(), at + length);
    if (op != op_source_continued && op != op_source && op != op_source_extension)
      out.insert(out.end(), words.begin() + static_cast<std::ptrdiff_t>(at),
                 words.begin() + static_cast<std::ptrdiff_t>(end));
    at = end;
  }
  return out;
}

/// The first line of the function with the most words; 0: it has none.
std::uint32_t line_of_longest_function(const std::vector<std::uint32_t>& words) {
  constexpr std::uint32_t op_line = 8, op_function = 54, op_function_end = 56;
  std::size_t from = 0, most = 0;
  std::uint32_t line = 0, longest = 0;
  for (std::size_t at = 5; at < words.size(); at += std::max(words[at] >> 16, 1U)) {
    const std::uint32_t op = words[at] & 0xffff;
    if (op == op_function) from = at, line = 0;
    if (op == op_line && line == 0 && at + 2 < words.size()) line = words[at + 2];
    if (op == op_function_end && at - from > most) most = at - from, longest = line;
  }
  return longest;
}

void expect_valid(const std::vector<std::uint32_t>& words) {
  if (words.size() > most_words) {
    const auto line = line_of_longest_function(words);
    throw std::runtime_error((line > 0 ? fmt::format("line {}: ", line) : "") +
                             "more than 400000 words of SPIR-V, mostly this function's");
  }
  spvtools::SpirvTools tools(SPV_ENV_UNIVERSAL_1_6);
  std::string said;
  tools.SetMessageConsumer([&](spv_message_level_t, const char*, const spv_position_t&,
                               const char* message) { said = message; });
  if (!tools.Validate(words))
    throw std::runtime_error("SPIR-V that its validator refuses: " + said);
}

/// What the compiler says of a stage, in words of functions: a person's text need be of no stage.
std::string in_words_of_functions(std::string said) {
  static constexpr std::pair<std::string_view, std::string_view> words[] = {
      {"required extension not requested: GL_NV_compute_shader_derivatives",
       "a difference between pixels, of which a function has none"},
      {"not supported in this stage: compute", "a pixel's shader has it, a function has not"}};
  for (const auto& [theirs, ours] : words)
    if (const auto at = said.find(theirs); at != said.npos) said.replace(at, theirs.size(), ours);
  return said;
}

/// Number of the line where a text defines a function last; 0: none.
int line_of_function(std::string_view text, const std::string& name) {
  std::size_t found = text.npos;
  for (auto at = text.find(name); at != text.npos; at = text.find(name, at + 1)) {
    const auto is_of_name = [](char c) {
      return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
    };
    const auto after = text.find_first_not_of(" \t", at + name.size());
    const auto before = at == 0 ? text.npos : text.find_last_not_of(" \t", at - 1);
    // A type stands before a function that is declared, and no "return".
    if (after == text.npos || text[after] != '(' || before == text.npos || before + 1 == at ||
        !is_of_name(text[before]) || text.substr(0, before + 1).ends_with("return"))
      continue;
    found = at;
  }
  return found == text.npos ? 0
                            : 1 + static_cast<int>(std::ranges::count(text.substr(0, found), '\n'));
}

/// "ERROR: shader:12: 'x' : undeclared identifier" → "line 12: 'x' : undeclared identifier"
std::string first_error(const char* log, std::string_view text) {
  const std::string_view all(log);
  if (const auto at = all.find("Recursion detected:"); at != all.npos) {
    const auto from = std::min(all.find_first_not_of(" \n\t", all.find('\n', at)), all.size());
    const std::string name(all.substr(from, all.find('(', from) - from));
    return fmt::format("line {}: recursion: {} calls itself, or is called by what it calls",
                       line_of_function(text, name), name);
  }
  for (const auto& [before, place] :
       {std::pair<std::string_view, std::string_view>{"ERROR: shader:", "line "},
        {"ERROR: tail:", "the end of the text, after it line "}})
    if (const auto at = all.find(before); at != all.npos) {
      const auto from = at + before.size();
      return std::string(place) +
             in_words_of_functions(std::string(all.substr(from, all.find('\n', from) - from)));
    }
  return std::string(all.substr(0, all.find('\n')));
}

std::vector<std::uint32_t> compiled_here(const Source& s) {
  std::vector<std::uint32_t> words;
  if (s.language == Language::spirv) {
    words.resize(s.text.size() / 4);
    std::memcpy(words.data(), s.text.data(), words.size() * 4);
    words = without_language(words);
    expect_valid(words);
    return words;
  }
  glslang::InitializeProcess();
  const bool hlsl = s.language == Language::hlsl;
  const std::string head = head_of(s.language);
  const std::string tail = hlsl ? "\n#undef main\n[numthreads(1,1,1)] void gonio_main() {}\n"
                                : "\n#undef main\nvoid main() {}\n";
  const std::array texts{head.c_str(), s.text.c_str(), tail.c_str()};
  const std::array names{"head", "shader", "tail"};
  glslang::TShader shader(EShLangCompute);
  shader.setStringsWithLengthsAndNames(texts.data(), nullptr, names.data(), 3);
  if (hlsl) {
    shader.setEntryPoint("gonio_main");
    shader.setSourceEntryPoint("gonio_main");
  }
  const auto client = hlsl ? glslang::EShClientVulkan : glslang::EShClientOpenGL;
  shader.setEnvInput(hlsl ? glslang::EShSourceHlsl : glslang::EShSourceGlsl, EShLangCompute, client,
                     100);
  shader.setEnvClient(client, hlsl ? glslang::EShTargetVulkan_1_0 : glslang::EShTargetOpenGL_450);
  shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_0);
  shader.setAutoMapLocations(true);
  shader.setAutoMapBindings(true);
  const auto messages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgKeepUncalled |
                                                 (hlsl ? EShMsgReadHlsl | EShMsgVulkanRules : 0));
  if (!shader.parse(GetDefaultResources(), 450, false, messages))
    throw std::runtime_error(first_error(shader.getInfoLog(), s.text));
  glslang::TProgram program;
  program.addShader(&shader);
  if (!program.link(messages)) throw std::runtime_error(first_error(program.getInfoLog(), s.text));
  glslang::SpvOptions options;
  options.disableOptimizer = true;
  options.generateDebugInfo = true;  // lines
  glslang::GlslangToSpv(*program.getIntermediate(EShLangCompute), words, &options);
  words = without_language(words);
  expect_valid(words);
  return words;
}

/// Limits of the child: it is killed by the system beyond them.
void take_limits() {
  const auto bound = [](auto what, rlim_t most) {
    const rlimit limit{most, most};
    ::setrlimit(what, &limit);
  };
  rlim_t pages = 0;  // what it shares with its parent, a great table maybe, is not the text's
  std::ifstream("/proc/self/statm") >> pages;
  bound(RLIMIT_AS, pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) + most_memory);
  bound(RLIMIT_CPU, most_seconds);
  bound(RLIMIT_CORE, 0);
  bound(RLIMIT_FSIZE, 0);
  bound(RLIMIT_NOFILE, 0);  // opens nothing from here on
}

/// "+" and the words, or "-" and what is wrong.
std::string answer_of(const Source& s) {
  take_limits();
  try {
    const auto words = compiled_here(s);
    return "+" + std::string(reinterpret_cast<const char*>(words.data()), words.size() * 4);
  } catch (const std::bad_alloc&) {
    return {};
  } catch (const std::exception& e) {
    return std::string("-") + e.what();
  }
}

/// Number of the line with the most characters, where a text too long for the compiler mostly is.
std::size_t longest_line(std::string_view text) {
  std::size_t longest = 0, at = 1, number = 1;
  while (!text.empty()) {
    const auto end = std::min(text.find('\n'), text.size());
    if (end > longest) longest = end, at = number;
    text.remove_prefix(std::min(end + 1, text.size()));
    ++number;
  }
  return at;
}

}  // namespace

bool can_compile() {
  return true;
}

std::vector<std::uint32_t> compile(const Source& s) {
  const std::string answer = answer_of_copy([&] { return answer_of(s); }, most_words * 4);
  if (answer.empty())
    throw bad_input(s.path, "compiling, longest at line " + std::to_string(longest_line(s.text)),
                    "a text that takes the compiler too deep, too far or too long",
                    "10 s and 1 GB to suffice");
  if (answer[0] == '+') {
    std::vector<std::uint32_t> words((answer.size() - 1) / 4);
    std::memcpy(words.data(), answer.data() + 1, words.size() * 4);
    return words;
  }
  std::string place = "compiling", found = answer.substr(1);
  if (const auto colon = found.find(": ");
      (found.starts_with("line ") || found.starts_with("the end")) && colon != found.npos) {
    place = found.substr(0, colon);
    found.erase(0, colon + 2);
  }
  throw bad_input(s.path, place, found, "a text that compiles");
}

}  // namespace gonio::foreign
