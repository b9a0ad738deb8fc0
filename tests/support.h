#pragma once
/// \file
/// What tests of several rooms need: a folder of their own, files in it, and the shared data.

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

namespace gonio::test {

/// A folder that is there for one test.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "gonio-test-XXXXXX").string();
    if (!::mkdtemp(name.data())) ADD_FAILURE() << "no temporary folder";
    path_ = name;
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  std::string write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path_ / name, std::ios::binary) << bytes;
    return *this / name;
  }
  std::size_t entries() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(path_), {}));
  }

 private:
  std::filesystem::path path_;
};

inline std::string read_bytes(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Folder of the project, as it was configured.
std::string project_folder();

/// A file of the data that may lie beside the project (../shared), or "" where it does not.
inline std::string shared(const std::string& name) {
  const auto p = std::filesystem::path(project_folder()) / ".." / "shared" / name;
  return std::filesystem::exists(p) ? p.string() : "";
}
#define GONIO_NEEDS_SHARED(variable, name)                \
  const std::string variable = gonio::test::shared(name); \
  if (variable.empty()) GTEST_SKIP() << "needs ../shared/" name ", which is not here"

}  // namespace gonio::test
