#include "shader/running.h"

#include <bit>
#include <cstring>

#include "base/process.h"

#include <fmt/format.h>

namespace gonio::shader {
namespace {

using test::Folder;
using test::Vulkan;

const std::string python = test::project_folder() + "/build/shading/bin/python";

bool runs(const std::string& program, const char* word) {
  const std::array<std::string, 1> words{word};
  const auto result = run_program(program, words, "", 60);
  return result && result->status == 0;
}

void expect_valid(const std::string& path) {
  const std::array<std::string, 3> words{"--target-env", "vulkan1.2", path};
  const auto result = run_program("spirv-val", words, "", 60);
  EXPECT_EQ(result->status, 0) << result->output;
}

}  // namespace

std::unique_ptr<Vulkan> device(std::string& why) {
  if (!runs("glslangValidator", "--version") || !runs("spirv-val", "--version")) {
    why = "glslangValidator or spirv-val is not there";
    return nullptr;
  }
  return Vulkan::open(why);
}

bool has_shading() {
  return runs(python, "--version");
}

std::vector<std::uint32_t> words_of(const std::string& path) {
  const std::string bytes = test::read_bytes(path);
  std::vector<std::uint32_t> words(bytes.size() / 4);
  std::memcpy(words.data(), bytes.data(), words.size() * 4);
  return words;
}

std::vector<std::uint32_t> compiled_glsl(const Folder& folder, const std::string& source) {
  folder.write("shader.comp", source);
  const std::array<std::string, 6> words{
      "-V", "--target-env", "vulkan1.2", folder / "shader.comp", "-o", folder / "shader.spv"};
  const auto result = run_program("glslangValidator", words, "", 60);
  EXPECT_EQ(result->status, 0) << result->output << source;
  expect_valid(folder / "shader.spv");
  return words_of(folder / "shader.spv");
}

void run_languages(const Folder& folder, const std::vector<std::string>& names) {
  const std::array<std::string, 2> words{test::project_folder() + "/tests/shader/languages.py",
                                         folder / ""};
  const auto result = run_program(python, words, "", 580);
  if (result && result->status == 0) return;
  ADD_FAILURE() << (result ? result->output : "not started");
  for (const auto& name : names) {
    const auto said = test::read_bytes(folder / (name + ".said"));
    if (!said.empty()) {
      ADD_FAILURE() << name << ": " << said.substr(0, 2000);
      return;
    }
  }
}
std::vector<std::vector<float>> run_all(Vulkan& vulkan,
                                        Language language,
                                        const std::vector<std::string>& programs,
                                        const std::vector<std::vector<float>>& inputs,
                                        std::size_t rows,
                                        const std::vector<std::size_t>& results) {
  const Folder folder;
  std::vector<std::string> names;
  for (std::size_t k = 0; k < programs.size(); ++k) {
    const auto& name = names.emplace_back(fmt::format("program{}", k));
    const auto file = name + "." + std::string(name_of(language));
    folder.write(file, programs[k]);
    if (language != Language::wgsl) continue;
    folder.write(name + ".json",
                 fmt::format("{{\"invocations\": {}, \"results\": {}}}", rows, rows * results[k]));
    folder.write(name + ".in", std::string(reinterpret_cast<const char*>(inputs[k].data()),
                                           inputs[k].size() * sizeof(float)));
  }
  if (language != Language::glsl) run_languages(folder, names);
  std::vector<std::vector<float>> all;
  for (std::size_t k = 0; k < programs.size() && !::testing::Test::HasFailure(); ++k) {
    auto& out = all.emplace_back();
    if (language == Language::wgsl) {
      for (const auto word : words_of(folder / (names[k] + ".out")))
        out.push_back(std::bit_cast<float>(word));
      continue;
    }
    const auto code = compiled_glsl(folder, language == Language::glsl
                                                ? programs[k]
                                                : test::read_bytes(folder / (names[k] + ".comp")));
    if (!::testing::Test::HasFailure()) out = vulkan.run(code, inputs[k], rows, rows * results[k]);
  }
  return all;
}

bool same_bits(float a, float b) {
  return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b) || (a == 0 && b == 0) ||
         (std::isnan(a) && std::isnan(b));
}

}  // namespace gonio::shader
