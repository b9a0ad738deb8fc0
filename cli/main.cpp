// gonio: reads the words, runs one subcommand, turns its outcome into an exit code.
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <new>
#include <string_view>
#include <system_error>

#include "base/file.h"
#include "base/path_error.h"
#include "base/text.h"
#include "brdf/catalogue/foreign_terms.h"
#include "cli/line/command.h"
#include "reports/measure/machine.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio {
extern const char* const commit;  ///< that this was built from, by cmake/commit.cmake
}  // namespace gonio

namespace {

/// The version, and in a second line what a report of a defect has to name.
std::string version() {
  const auto m = gonio::this_machine();
  return fmt::format("{}\ncommit {}, {}, vector units here: {}", GONIO_VERSION, gonio::commit,
                     m.compiler, fmt::join(m.instruction_sets, " "));
}

int finish(gonio::Exit code) {
  return static_cast<int>(code);
}

/// Not by fmt::print, which throws where standard error cannot be written.
int fail(gonio::Exit code, const char* what) {
  std::fprintf(stderr, "gonio: %s\n", what);
  return finish(code);
}

/// Standard output took no more. Whoever closed it has seen enough, as head: no message.
int fail_printing(int error) {
  if (error == EPIPE) return finish(gonio::Exit::bad_input);
  return fail(gonio::Exit::bad_input,
              fmt::format("standard output: writing: found {}, expected room", std::strerror(error))
                  .c_str());
}

/// A write that fails is told by its result, like any other: a closed pipe and the limit of a file's
/// size kill nobody.  A standard stream that the caller closed keeps its number, as something that
/// cannot be written: the next file opened would get it, and what is printed would land there.
void make_writes_fail_in_the_open() {
  for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_IGN);
  for (const int stream : {0, 1, 2})
    if (::fcntl(stream, F_GETFD) < 0) static_cast<void>(::open("/", O_RDONLY));
}

/// One subcommand, as the words say; or help, which was printed.
int run(int argc, char** argv) {
  gonio::cli::CommandLine line(
      "gonio fits analytic BRDF models to tabulated reflectance and says how far to trust the "
      "result.",
      version,
      "Exit codes: 0 done, 1 a check failed, 2 wrong usage, 3 bad input or output, 4 the fit did "
      "not converge.");
  // As one needs them: tables, formulas, reports, scenes.
  gonio::cli::add_inspect(line);
  gonio::cli::add_columns(line);
  gonio::cli::add_fit(line);
  gonio::cli::add_gather(line);
  gonio::cli::add_batch(line);
  gonio::cli::add_stack(line);
  gonio::cli::add_fit_map(line);
  gonio::cli::add_compare(line);
  gonio::cli::add_convert(line);
  gonio::cli::add_synth(line);
  gonio::cli::add_explore(line);
  gonio::cli::add_models(line);
  gonio::cli::add_term(line);
  gonio::cli::add_eval(line);
  gonio::cli::add_albedo(line);
  gonio::cli::add_split_sum(line);
  gonio::cli::add_audit(line);
  gonio::cli::add_stability(line);
  gonio::cli::add_validate(line);
  gonio::cli::add_export(line);
  gonio::cli::add_shader(line);
  gonio::cli::add_report(line);
  gonio::cli::add_bench(line);
  gonio::cli::add_plan(line);
  gonio::cli::add_verify(line);
  gonio::cli::add_render(line);
  gonio::cli::add_schema(line);
  gonio::cli::add_manual(line);
  const auto action = line.parse(argc, argv);
  const gonio::Exit code = action ? action() : gonio::Exit::done;
  for (const auto& guess : gonio::take_foreign_guesses())
    std::fprintf(stderr, "gonio: %s\n", guess.c_str());
  // A stream above it may have lost the error.
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
    return fail_printing(errno != 0 ? errno : EIO);
  return finish(code);
}

}  // namespace

int main(int argc, char** argv) {
  using gonio::Exit;
  make_writes_fail_in_the_open();
  gonio::remove_unfinished_files_on_signals();
  const gonio::FileGuard guard;
  try {
    return run(argc, argv);
  } catch (const gonio::Error& e) {
    return fail(e.code(), e.what());
  } catch (const gonio::NameTaken& e) {
    return fail(Exit::usage, e.what());
  } catch (const std::filesystem::filesystem_error& e) {
    return fail(Exit::bad_input, gonio::path_error(e).what());
  } catch (const std::system_error& e) {  // fmt::print and the like
    return fail_printing(e.code().value());
  } catch (const std::bad_alloc&) {
    return fail(Exit::bad_input, "out of memory");
  } catch (const std::exception& e) {
    return fail(Exit::bad_input, gonio::printable(e.what(), 1000).c_str());
  }
}
