#pragma once
/// \file
/// Other programs, run without a shell.

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>

namespace gonio {

struct ProcessResult {
  int status;          ///< exit status; −1: it was ended by a signal, or by the limit
  bool out_of_time;    ///< it ran longer than it may
  std::string output;  ///< of both its streams
};

/// A program of that name among those of PATH, given the input; no value where there is none, or it cannot be started.
///
/// \param seconds  after which it is ended
std::optional<ProcessResult> run_program(const std::string& name,
                                         std::span<const std::string> arguments,
                                         const std::string& input,
                                         double seconds);

/// What a function writes in a process of its own, a copy of this one, which ends with this one; empty where it could not be started,
/// or did not return.  \param most  bytes that are kept of it
///
/// The function may take memory and time as it likes, and end the process: nothing of it comes back but its bytes.  Signals end the
/// copy and do nothing else: the files being made belong to this process.
std::string answer_of_copy(const std::function<std::string()>& work, std::size_t most);

/// Ends the programs that run_program() and answer_of_copy() wait for.  A signal handler may call it.
void end_programs() noexcept;

/// Path by which the running program starts itself once more; empty where nothing says it.
std::string this_program();

}  // namespace gonio
