#include "base/process.h"

#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>
#include <thread>
#include <vector>

#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace gonio {
namespace {

struct Close {
  void operator()(std::FILE* f) const { std::fclose(f); }
};
/// A file that is nobody else's and gone when closed: no pipe, which either side may block on.
using Temporary = std::unique_ptr<std::FILE, Close>;

/// Numbers of the programs that run, for the signal handler.
std::array<std::atomic<pid_t>, 64> running;

/// Puts a number in the place of another.
void swap_running(pid_t from, pid_t to) {
  for (auto& slot : running) {
    pid_t there = from;
    if (slot.compare_exchange_strong(there, to)) return;
  }
}

}  // namespace

void end_programs() noexcept {
  for (const auto& slot : running)
    if (const pid_t child = slot.load()) ::kill(child, SIGKILL);
}

std::optional<ProcessResult> run_program(const std::string& name,
                                         std::span<const std::string> arguments,
                                         const std::string& input,
                                         double seconds) {
  const Temporary in(std::tmpfile()), out(std::tmpfile());
  if (!in || !out) return {};
  if (std::fwrite(input.data(), 1, input.size(), in.get()) != input.size()) return {};
  std::fflush(in.get());
  std::rewind(in.get());

  std::vector<std::string> words{name};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (auto& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t streams;
  posix_spawn_file_actions_init(&streams);
  posix_spawn_file_actions_adddup2(&streams, ::fileno(in.get()), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&streams, ::fileno(out.get()), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&streams, ::fileno(out.get()), STDERR_FILENO);
  pid_t child = 0;
  const bool started =
      ::posix_spawnp(&child, name.c_str(), &streams, nullptr, argv.data(), environ) == 0;
  posix_spawn_file_actions_destroy(&streams);
  if (!started) return {};
  swap_running(0, child);

  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                      std::chrono::duration<double>(seconds));
  ProcessResult result{-1, false, {}};
  const auto has_ended = [&] {  // its number stays its own until waitpid()
    siginfo_t info{};
    return ::waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOHANG | WNOWAIT) != 0 ||
           info.si_pid != 0;
  };
  while (!has_ended()) {
    if (Clock::now() >= end) {
      result.out_of_time = true;
      ::kill(child, SIGKILL);
      break;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  swap_running(child, 0);
  int status = 0;
  ::waitpid(child, &status, 0);
  if (WIFEXITED(status)) result.status = WEXITSTATUS(status);
  if (result.status == 127) return {};  // as a shell says that there is no such program
  std::rewind(out.get());
  char part[4096];
  constexpr std::size_t most = 1 << 24;
  for (std::size_t n = 0;
       result.output.size() < most && (n = std::fread(part, 1, sizeof part, out.get())) > 0;)
    result.output.append(part, n);
  return result;
}

std::string this_program() {
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/exe", error).string();
}

}  // namespace gonio
