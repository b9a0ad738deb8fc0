#include "base/process.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/prctl.h>
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

namespace {

/// Signals that end a run and take its unfinished files with it.
constexpr std::array ending{SIGINT, SIGTERM, SIGHUP};

sigset_t ending_signals() {
  sigset_t all;
  sigemptyset(&all);
  for (const int signal : ending) sigaddset(&all, signal);
  return all;
}

[[noreturn]] void run_copy(const std::function<std::string()>& work,
                           int to,
                           pid_t parent,
                           const sigset_t& signals_before) {
  for (const int signal : ending)
    if (struct sigaction now{};
        ::sigaction(signal, nullptr, &now) == 0 && now.sa_handler != SIG_IGN)
      ::signal(signal, SIG_DFL);
  ::sigprocmask(SIG_SETMASK, &signals_before, nullptr);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);  // it ended before that was said
  const std::string out = work();
  for (std::size_t at = 0; at < out.size();) {
    const auto n = ::write(to, out.data() + at, out.size() - at);
    if (n <= 0) ::_exit(1);
    at += static_cast<std::size_t>(n);
  }
  ::_exit(0);
}

}  // namespace

std::string answer_of_copy(const std::function<std::string()>& work, std::size_t most) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return {};
  // Until the copy has its own handlers, and this process knows its number, no signal comes in
  // between.
  const sigset_t ending = ending_signals();
  sigset_t before;
  ::pthread_sigmask(SIG_BLOCK, &ending, &before);
  const pid_t parent = ::getpid(), child = ::fork();
  if (child == 0) {
    ::close(ends[0]);
    run_copy(work, ends[1], parent, before);
  }
  if (child > 0) swap_running(0, child);
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  ::close(ends[1]);
  std::string all;
  std::array<char, 65536> piece{};
  for (ssize_t n = 0; child > 0 && (n = ::read(ends[0], piece.data(), piece.size())) != 0;) {
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) break;
    if (all.size() <= most) all.append(piece.data(), static_cast<std::size_t>(n));
  }
  ::close(ends[0]);
  if (child < 0) return {};
  swap_running(child, 0);
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? all : std::string();
}

std::string this_program() {
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/exe", error).string();
}

}  // namespace gonio
