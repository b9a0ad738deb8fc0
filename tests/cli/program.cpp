#include "cli/program.h"

#include <algorithm>

#include "cli/module.h"

namespace gonio::test {

std::string program_path() {
  return GONIO_PROGRAM;
}
std::string program() {
  return "'" + program_path() + "'";
}

std::string python() {
  static const std::string call = [] {
    const std::string interpreter = GONIO_PYTHON_INTERPRETER;
    if (interpreter.empty()) return std::string();
    const auto package = std::filesystem::path(program_path()).parent_path() / "python";
    const auto finding =
        "PYTHONDONTWRITEBYTECODE=1 PYTHONPATH='" + package.string() + "' '" + interpreter + "'";
    const auto looked = std::system((finding + " -c 'import gonio' >/dev/null 2>&1").c_str());
    return looked == 0 ? finding : std::string();
  }();
  return call;
}

nlohmann::json Outcome::json() const {
  return nlohmann::json::parse(out);
}

Outcome gonio(const Folder& folder, const std::string& words, const std::string& before) {
  const std::string command = "cd '" + folder / "" + "' && " + before + program() + " " + words +
                              " >.out 2>.err </dev/null";
  const int status = std::system(command.c_str());
  Outcome o{WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_bytes(folder / ".out"),
            read_bytes(folder / ".err")};
  std::filesystem::remove(folder / ".out");
  std::filesystem::remove(folder / ".err");
  return o;
}

void expect_one_line(const Outcome& o, int code, const std::string& holding) {
  EXPECT_EQ(o.code, code) << o.err;
  EXPECT_EQ(o.out, "");
  EXPECT_EQ(std::count(o.err.begin(), o.err.end(), '\n'), 1) << o.err;
  EXPECT_NE(o.err.find(holding), std::string::npos) << o.err;
}

void expect_one_line_each(const Folder& folder,
                          int code,
                          std::initializer_list<std::pair<std::string, std::string>> calls) {
  for (const auto& [words, holding] : calls) {
    SCOPED_TRACE("gonio " + words);
    expect_one_line(gonio(folder, words), code, holding);
  }
}

}  // namespace gonio::test
