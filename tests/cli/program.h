#pragma once
/// \file
/// The program, called as others call it.

#include <cstdlib>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <utility>

#include "support.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gonio::test {

/// Where the program lies; the same in quotes, as a shell reads it.
std::string program_path();
std::string program();

struct Outcome {
  int code;
  std::string out, err;
  nlohmann::json json() const;
};

/// Runs `gonio WORDS` in a shell, in the folder.  \param before  shell commands, such as limits
Outcome gonio(const Folder& folder, const std::string& words, const std::string& before = "");

/// The program ended with the code, said nothing on stdout, and one line on stderr that holds the words.
void expect_one_line(const Outcome& o, int code, const std::string& holding);
/// Calls that all end so, each with the words that its line holds.
void expect_one_line_each(const Folder& folder,
                          int code,
                          std::initializer_list<std::pair<std::string, std::string>> calls);

inline constexpr const char* paint =
    "lambert+ggx/smith_ggx.correlated/schlick --set alpha=0.15 f0=0.05 kd=0.2,0.1,0.05";

}  // namespace gonio::test
