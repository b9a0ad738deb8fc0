// The modules that pages run are kept built; their digests tell whether they were built of the
// sources that are here.
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

/// Names of the sources that have changed since the module was made of them.
std::string changed_since(const std::string& module) {
  std::ifstream list(test::project_folder() + "/src/explore/module/" + module + ".sources.txt");
  std::string digest, source, changed;
  std::size_t all = 0;
  while (list >> digest >> source) {
    ++all;
    if (digest_of_code(test::project_folder() + "/" + source) != digest) changed += " " + source;
  }
  EXPECT_GT(all, 100U);
  return changed;
}
constexpr const char* make_anew =
    "\nrun src/explore/module/make (its README names the packages) and commit what it writes";

TEST(Module, OfModelsWasMadeOfTheseSources) {
  EXPECT_EQ(changed_since("models"), "") << make_anew;
}

TEST(Module, OfTheFitWasMadeOfTheseSources) {
  EXPECT_EQ(changed_since("fit"), "") << make_anew;
}

}  // namespace
}  // namespace gonio
