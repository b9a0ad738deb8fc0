// The module that pages run is kept built; its digests tell whether it was built of the sources
// that are here.
#include <fstream>
#include <sstream>

#include "base/sha256.h"
#include "support.h"

namespace gonio {
namespace {

/// SHA-256 of a source's lines that are no comments, as src/explore/module/make takes it.
std::string digest_of_code(const std::string& path) {
  std::ifstream in(path);
  std::string code;
  for (std::string line; std::getline(in, line);) {
    const auto first = line.find_first_not_of(" \t\v\f\r");
    if (first == line.npos || line.compare(first, 2, "//") != 0) code += line + '\n';
  }
  return sha256(code);
}

TEST(Module, WasMadeOfTheseSources) {
  std::ifstream list(test::project_folder() + "/src/explore/module/sources.txt");
  std::string digest, source, changed;
  std::size_t all = 0;
  while (list >> digest >> source) {
    ++all;
    if (digest_of_code(test::project_folder() + "/" + source) != digest) changed += " " + source;
  }
  EXPECT_GT(all, 100U);
  EXPECT_TRUE(changed.empty()) << "the pages' module was made before these changed:" << changed
                               << "\nrun src/explore/module/make (two minutes; apt-get install "
                                  "clang-22 lld-22 libc++-22-dev-wasm32 "
                                  "libclang-rt-22-dev-wasm32 wasi-libc) and commit what it writes";
}

}  // namespace
}  // namespace gonio
