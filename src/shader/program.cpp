#include "shader/program.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "base/file.h"
#include "base/process.h"
#include "shader/shader.h"

#include <fmt/format.h>

namespace gonio::shader {

std::string compute_program(const TracedFormula& f, Language language, bool of_directions) {
  const Writing writing{language, "brdf", {}};
  const Syntax syntax(language, f.precision);
  std::string arguments;
  std::size_t columns = 0;
  const auto next = [&](bool colour, const Syntax& number) {
    std::string x;
    for (std::size_t c = 0; c < (colour ? 3U : 1U); ++c)
      x += fmt::format("{}{}(x[i * COLUMNSu + {}u])", c > 0 ? ", " : "", number.type(false),
                       columns++);
    arguments += (arguments.empty() ? "" : ", ") + (colour ? number.colour(x) : x);
  };
  for (const auto& p : f.parameters) next(p.colour, syntax);
  if (of_directions)
    for (int k = 0; k < (f.anisotropic ? 5 : 3); ++k)
      next(true, Syntax(language, Precision::float_));
  else
    for (std::size_t k = 0; k < f.angles.size(); ++k) next(false, syntax);
  const bool several = f.results.size() > 1;
  const std::string one = language == Language::wgsl ? "f32" : "float";
  std::string results;
  std::size_t at = 0;
  for (const auto& r : f.results)
    for (std::size_t c = 0; c < (f.colour ? 3U : 1U); ++c)
      results += fmt::format("  y[i * RESULTSu + {}u] = {}(value{}{});\n", at++, one,
                             several ? "." + r.name : "", f.colour ? fmt::format("[{}]", c) : "");
  const std::string type = several ? structure_name(f, writing) : syntax.type(f.colour);
  std::string head,
      body = fmt::format("{}({});\n",
                         of_directions ? writing.name : function_of_cosines(f, writing), arguments);
  switch (language) {
    case Language::glsl:
      head =
          "layout(local_size_x = 64) in;\n"
          "layout(set = 0, binding = 0) readonly buffer I { float x[]; };\n"
          "layout(set = 0, binding = 1) writeonly buffer O { float y[]; };\n"
          "void main() {\n  uint i = gl_GlobalInvocationID.x;\n  " +
          type + " value = ";
      break;
    case Language::slang:
      head =
          "[[vk::binding(0, 0)]] StructuredBuffer<float> x;\n"
          "[[vk::binding(1, 0)]] RWStructuredBuffer<float> y;\n"
          "[shader(\"compute\")] [numthreads(64, 1, 1)]\n"
          "void main(uint3 id : SV_DispatchThreadID) {\n  uint i = id.x;\n  " +
          type + " value = ";
      break;
    case Language::wgsl:
      head =
          "@group(0) @binding(0) var<storage, read> x: array<f32>;\n"
          "@group(0) @binding(1) var<storage, read_write> y: array<f32>;\n"
          "@compute @workgroup_size(64)\n"
          "fn main(@builtin(global_invocation_id) id: vec3<u32>) {\n  let i = id.x;\n  _ = x[0];\n"
          "  let value = ";
      break;
  }
  std::string main = head + body + results + "}\n";
  const auto replace = [&](const std::string& what, std::size_t by) {
    for (std::size_t k = main.find(what); k != std::string::npos; k = main.find(what))
      main.replace(k, what.size() - 1, std::to_string(by));
  };
  replace("COLUMNSu", columns);
  replace("RESULTSu", at);
  return (language == Language::glsl ? "#version 450\n" : "") + shader_source(f, writing) + main;
}

namespace {

/// A folder that is gone with its files when it ends.
class Folder {
 public:
  Folder() : path_((std::filesystem::temp_directory_path() / "gonio-shader-XXXXXX").string()) {
    if (!::mkdtemp(path_.data())) path_.clear();
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
  }
  explicit operator bool() const { return !path_.empty(); }
  std::string operator/(const char* name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

bool does(const std::string& program, std::span<const std::string> words) {
  const auto result = run_program(program, words, "", 60);
  return result && result->status == 0;
}

/// Kind of an instruction by its number in SPIR-V's specification; of an extended one by GLSL.std.450's.
std::string_view kind_of(std::uint32_t operation, std::uint32_t extended) {
  switch (operation) {
    case 129:  // OpFAdd
    case 131:  // OpFSub
      return "add";
    case 133:  // OpFMul
    case 142:  // OpVectorTimesScalar
      return "mul";
    case 136:
      return "div";  // OpFDiv
    case 169:
      return "select";  // OpSelect
    case 12:
      break;  // OpExtInst
    default:
      return operation >= 180 && operation <= 191 ? "compare" : "other";  // OpFOrdEqual …
  }
  switch (extended) {
    case 27:
      return "exp";
    case 28:
      return "log";
    case 31:
      return "sqrt";
    case 50:
      return "fma";
    case 37:  // FMin
    case 40:  // FMax
    case 43:  // FClamp
      return "min_max";
    default:
      return "other";
  }
}

}  // namespace

std::size_t Instructions::arithmetic() const {
  std::size_t sum = 0;
  for (std::size_t k = 0; k + 1 < kinds.size(); ++k) sum += by_kind[k];
  return sum;
}

Instructions count_instructions(std::span<const std::uint32_t> words) {
  constexpr std::uint32_t function = 54, parameter = 55, end = 56, label = 248;
  Instructions counted;
  bool within = false;
  for (std::size_t at = 5; at < words.size();) {
    const std::uint32_t operation = words[at] & 0xffffU, length = words[at] >> 16U;
    if (length == 0 || length > words.size() - at) break;
    if (operation == function || operation == end) within = operation == function;
    if (within && operation != function && operation != parameter && operation != label) {
      const auto kind = kind_of(operation, length > 4 ? words[at + 4] : 0);
      const auto found = std::ranges::find(Instructions::kinds, kind);
      ++counted.by_kind[static_cast<std::size_t>(found - Instructions::kinds.begin())];
    }
    at += length;
  }
  return counted;
}

std::optional<Instructions> compiled_instructions(const TracedFormula& f) {
  const Folder folder;
  if (!folder) return {};
  const std::string source = folder / "shader.comp", plain = folder / "plain.spv",
                    optimised = folder / "optimised.spv";
  {
    OutputFile out(source);
    out.write(compute_program(f, Language::glsl));
    out.commit();
  }
  const std::array<std::string, 6> compile{"-V", "--target-env", "vulkan1.2", source, "-o", plain};
  const std::array<std::string, 4> optimise{"-O", plain, "-o", optimised};
  if (!does("glslangValidator", compile) || !does("spirv-opt", optimise)) return {};
  const std::string bytes = InputFile(optimised).read_rest(1U << 24U);
  std::vector<std::uint32_t> words(bytes.size() / sizeof(std::uint32_t));
  std::memcpy(words.data(), bytes.data(), words.size() * sizeof(std::uint32_t));
  return count_instructions(words);
}

}  // namespace gonio::shader
