#pragma once
/// \file
/// Errors: what went wrong, for whom, and where in *their* file; and the program's exit codes.

#include <array>
#include <stdexcept>
#include <string>
#include <string_view>

#include "base/names.h"

namespace gonio {

/// Exit codes of the program, part of its contract.
enum class Exit {
  done = 0,
  check_failed = 1,   ///< a check that the user asked for
  usage = 2,          ///< the words of the call
  bad_input = 3,      ///< a file that cannot be read as what it claims, or an output not written
  not_converged = 4,  ///< the fit
};
template <>
inline constexpr std::array<std::string_view, 5> names_of<Exit>{"ok", "check_failed", "wrong_usage",
                                                                "bad_input", "not_converged"};

/// One line that a user can act on, or a few where what to do depends on what they see.  Bugs are asserted, outcomes of a fit are values in its result;
/// this is for what people bring.
class Error : public std::runtime_error {
 public:
  Error(Exit code, const std::string& line) : std::runtime_error(line), code_(code) {}
  Exit code() const { return code_; }

 private:
  Exit code_;
};

/// A name to write that a file has which the run reads, or another that it writes: wrong usage, whichever document names the file.
/// So it is no Error, whose words whoever reads a document takes for what is wrong in that.
class NameTaken : public std::runtime_error {
 public:
  explicit NameTaken(const std::string& line);
};

/// "FILE: PLACE: found FOUND, expected EXPECTED", each made printable (base/text.h), since any may
/// come from the file, and cut where it is long, the file's name excepted.
Error bad_input(const std::string& file,
                const std::string& place,
                const std::string& found,
                const std::string& expected);
Error wrong_usage(const std::string& line);

}  // namespace gonio
