#pragma once
/// \file
/// The program, called as others call it.

#include <cstdlib>
#include <filesystem>
#include <string>

#include "support.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gonio::test {

struct Outcome {
  int code;
  std::string out, err;
  nlohmann::json json() const { return nlohmann::json::parse(out); }
};

/// Runs `gonio WORDS` in a shell, in the folder.  \param before  shell commands, such as limits
inline Outcome gonio(const Folder& folder,
                     const std::string& words,
                     const std::string& before = "") {
  const std::string command = "cd '" + folder / "" + "' && " + before + "'" GONIO_PROGRAM "' " +
                              words + " >.out 2>.err </dev/null";
  const int status = std::system(command.c_str());
  Outcome o{WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_bytes(folder / ".out"),
            read_bytes(folder / ".err")};
  std::filesystem::remove(folder / ".out");
  std::filesystem::remove(folder / ".err");
  return o;
}

inline void expect_one_line(const Outcome& o, int code, const std::string& holding) {
  EXPECT_EQ(o.code, code) << o.err;
  EXPECT_EQ(o.out, "");
  EXPECT_EQ(std::count(o.err.begin(), o.err.end(), '\n'), 1) << o.err;
  EXPECT_NE(o.err.find(holding), std::string::npos) << o.err;
}

inline constexpr const char* paint =
    "lambert+ggx/smith_ggx.correlated/schlick --set alpha=0.15 f0=0.05 kd=0.2,0.1,0.05";

}  // namespace gonio::test
