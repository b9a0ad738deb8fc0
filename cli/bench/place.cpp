#include "cli/bench/place.h"

#include <algorithm>
#include <system_error>

#include "base/error.h"

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace gonio::cli {

BenchFolder::BenchFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "gonio-bench-XXXXXX").string();
  if (!::mkdtemp(name.data()))
    throw bad_input(name, "making a folder", "no success", "a temporary folder");
  path_ = name;
}

BenchFolder::~BenchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

int run_program(const std::vector<std::string>& words) {
  std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
  std::vector<std::string> all = words;
  std::vector<char*> argv{program.data()};
  for (auto& w : all) argv.push_back(w.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t silent;
  posix_spawn_file_actions_init(&silent);
  posix_spawn_file_actions_addopen(&silent, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  int status = 0;
  const bool started =
      ::posix_spawn(&child, program.c_str(), &silent, nullptr, argv.data(), environ) == 0;
  posix_spawn_file_actions_destroy(&silent);
  if (!started || ::waitpid(child, &status, 0) != child || !WIFEXITED(status)) return -1;
  return WEXITSTATUS(status);
}

nlohmann::ordered_json spread_of(std::vector<double> x) {
  std::ranges::sort(x);
  return {{"median", x[x.size() / 2]}, {"least", x.front()}, {"most", x.back()}};
}

}  // namespace gonio::cli
