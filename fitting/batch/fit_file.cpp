#include "fitting/batch/fit_file.h"

#include "base/stopwatch.h"
#include "base/text.h"
#include "table/format/as_one.h"

namespace gonio {

FittedFile fit_files(const std::vector<std::string>& paths,
                     const HowFitted& how,
                     const std::function<void(const std::string&)>& phase) {
  const auto say = [&](const std::string& what) {
    if (phase) phase(what);
  };
  say("reading " + (paths.size() == 1 ? paths[0] : counted(paths.size(), "file")));
  const Stopwatch begin;
  TableAndDigest in = read_files(paths, how.bins);
  take(in.table, how.measured);
  const double load_ms = begin.ms();
  FitResult result = fit(in.table, how.options, say);
  const Stopwatch since_fitted;
  in.finish();
  FitDocument& d = result.document;
  d.input_path = in.table.path;
  d.input_sha256 = in.table.sha256;
  d.solver.phase_ms.insert(d.solver.phase_ms.begin(), {"load_ms", load_ms});
  d.solver.phase_ms.emplace_back("digest_ms", since_fitted.ms());
  return {std::move(in.table), std::move(result)};
}

}  // namespace gonio
