#include "fitting/batch/fit_file.h"

#include <chrono>

#include "table/format/formats.h"

namespace gonio {

FittedFile fit_file(const std::string& path,
                    std::optional<Bins> bins,
                    const FitOptions& options,
                    const std::function<void(const std::string&)>& phase) {
  using Clock = std::chrono::steady_clock;
  const auto ms_since = [](Clock::time_point begin) {
    return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
  };
  const auto say = [&](const std::string& what) {
    if (phase) phase(what);
  };
  say("reading " + path);
  const auto begin = Clock::now();
  TableAndDigest in(path, bins);
  const double load_ms = ms_since(begin);
  FitResult result = fit(in.table, options, say);
  const auto fitted = Clock::now();
  in.finish();
  FitDocument& d = result.document;
  d.input_path = path;
  d.input_sha256 = in.table.sha256;
  d.solver.phase_ms.insert(d.solver.phase_ms.begin(), {"load_ms", load_ms});
  d.solver.phase_ms.emplace_back("digest_ms", ms_since(fitted));
  return {std::move(in.table), std::move(result)};
}

}  // namespace gonio
