#include "fitting/batch/fit_file.h"

#include "base/stopwatch.h"
#include "base/text.h"
#include "table/format/as_one.h"
#include "table/format/formats.h"

namespace gonio {
namespace {

using SayPhase = std::function<void(const std::string&)>;

/// \param name    of what is read
/// \param read    makes the table and keeps what finish() needs
/// \param finish  waits for the SHA-256 of what was read
FittedFile fit_what_is_read(const std::string& name,
                            const HowFitted& how,
                            const SayPhase& phase,
                            const std::function<Table&()>& read,
                            const std::function<void()>& finish) {
  const auto say = [&](const std::string& what) {
    if (phase) phase(what);
  };
  say("reading " + name);
  const Stopwatch begin;
  Table& table = read();
  if (how.mask) leave_out(table, *how.mask);
  const double load_ms = begin.ms();
  FitResult result = fit(table, how.options, say);
  const Stopwatch since_fitted;
  finish();
  FitDocument& d = result.document;
  d.input_path = table.path;
  d.input_sha256 = table.sha256;
  d.solver.phase_ms.insert(d.solver.phase_ms.begin(), {"load_ms", load_ms});
  d.solver.phase_ms.emplace_back("digest_ms", since_fitted.ms());
  return {std::move(table), std::move(result)};
}

}  // namespace

FittedFile fit_file(const std::string& path, const HowFitted& how, const SayPhase& phase) {
  std::optional<TableAndDigest> in;
  return fit_what_is_read(
      path, how, phase, [&]() -> Table& { return in.emplace(path, how.bins).table; },
      [&] { in->finish(); });
}

FittedFile fit_as_one(const std::vector<std::string>& paths,
                      const HowFitted& how,
                      const SayPhase& phase) {
  Table all;
  return fit_what_is_read(
      counted(paths.size(), "file"), how, phase,
      [&]() -> Table& { return all = read_as_one(paths, how.bins); }, [] {});
}

}  // namespace gonio
