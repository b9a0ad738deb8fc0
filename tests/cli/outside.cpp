#include "cli/outside.h"

#include <cstdlib>
#include <filesystem>

namespace gonio::test {
namespace {

const std::string source = project_folder();

OutsideCall call(const Folder& f, const std::string& command) {
  const int code = std::system(
      (command + " > '" + (f / ".outside") + "' 2> '" + (f / ".outside_err") + "'").c_str());
  return {code, read_bytes(f / ".outside"), read_bytes(f / ".outside_err")};
}

}  // namespace

std::string outside_python() {
  return source + "/build/targets/bin/python";
}

bool has_outside(const std::string& package) {
  if (!std::filesystem::exists(outside_python())) return false;
  for (const auto& lib : std::filesystem::directory_iterator(source + "/build/targets/lib"))
    if (std::filesystem::exists(lib.path() / "site-packages" / package)) return true;
  return false;
}

bool has_materialx() {
  static const bool there = [] {
    if (!has_outside("MaterialX") || !has_outside("moderngl")) return false;
    const std::string draws =
        "import moderngl; moderngl.create_standalone_context(backend=\"egl\")";
    return std::system((outside_python() + " -c '" + draws + "' >/dev/null 2>&1").c_str()) == 0;
  }();
  return there;
}

OutsideCall outside(const Folder& f, const std::string& script, const std::string& words) {
  return call(f, outside_python() + " " + source + "/tests/cli/targets/" + script + " " + words);
}

bool has_blender() {
  return std::filesystem::exists(source + "/build/blender/lib/python3.11/site-packages/bpy");
}
OutsideCall in_blender(const Folder& f, const std::string& words) {
  return call(f, source + "/build/blender/bin/python " + source +
                     "/tests/cli/targets/blender_values.py " + words);
}

std::optional<std::string> gltf_messages(const Folder& f, const std::string& file) {
  const std::string modules = source + "/build/gltf/node_modules";
  if (!std::filesystem::exists(modules + "/gltf-validator")) return {};
  const auto o =
      call(f, "node " + source + "/tests/cli/gltf/validate.cjs " + modules + " " + (f / file));
  return o.code == 0 ? o.out : "error: not run: " + o.err;
}

std::optional<std::string> outside_faults(const Folder& f, const std::string& file) {
  if (file.ends_with(".glsl")) {
    if (std::system("glslangValidator --version >/dev/null 2>&1") != 0) return {};
    f.write(".program.comp", "#version 450\n" + read_bytes(f / file) +
                                 "layout(local_size_x = 1) in;\nvoid main() {}\n");
    const auto o = call(f, "glslangValidator -V --target-env vulkan1.2 -o '" +
                               (f / ".program.spv") + "' '" + (f / ".program.comp") + "'");
    return o.code == 0 ? "" : o.out + o.err;
  }
  if (file.ends_with(".gltf")) {
    const auto said = gltf_messages(f, file);
    if (!said) return {};
    const bool fine = said->find("error") == said->npos && said->find("warning") == said->npos;
    return fine ? "" : *said;
  }
  if (!has_materialx()) return {};
  if (file.ends_with(".usda") && !has_outside("pxr")) return {};
  const auto o = outside(f, file.ends_with(".usda") ? "usd_values.py" : "materialx_values.py",
                         (f / file) + " /dev/null");
  return o.code == 0 ? "" : o.err;
}

}  // namespace gonio::test
