#pragma once
/// \file
/// What the subjects of `gonio bench` share: a folder, this program as a process, spreads.

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace gonio::cli {

/// A folder of its own, which goes with it.
class BenchFolder {
 public:
  BenchFolder();
  ~BenchFolder();
  BenchFolder(const BenchFolder&) = delete;
  BenchFolder& operator=(const BenchFolder&) = delete;
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

/// This program with these words, from start to end, its standard output unread.
/// \return its exit code; −1 where it was not started or was killed
int run_program(const std::vector<std::string>& words);

/// {"median", "least", "most"}
nlohmann::ordered_json spread_of(std::vector<double>);

}  // namespace gonio::cli
