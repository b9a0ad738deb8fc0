// A build without glslang: files of shaders are refused by name.
#include "base/error.h"
#include "foreign/callers.h"
#include "foreign/function.h"

#include <fmt/format.h>

namespace gonio::foreign {
namespace {

[[noreturn]] void refuse_file(const std::string& file) {
  throw wrong_usage(fmt::format(
      "{}: this build reads no shaders (GONIO_SHADERS is OFF, or glslang and SPIRV-Tools "
      "were not there)",
      file));
}

}  // namespace

bool can_compile() {
  return false;
}
Function read_function(const Name& name, std::optional<Stands>) {
  refuse_file(name.file);
}
std::vector<Entry> list_functions(const std::string& file) {
  refuse_file(file);
}
std::string sha256_of(const std::string& file) {
  refuse_file(file);
}
std::size_t steps_of(const std::string& file) {
  refuse_file(file);
}
void provide(const std::string& file, const std::string&) {
  refuse_file(file);
}

std::vector<std::string> callers_with_pi(const std::string&, const std::string&) {
  return {};
}

}  // namespace gonio::foreign
