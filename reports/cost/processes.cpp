#include "reports/cost/processes.h"

#include <map>

#include "base/error.h"
#include "base/process.h"

namespace gonio {

std::vector<std::string> arguments_of_a_process(const CostOptions& o) {
  std::vector<std::string> out{
      "bench",       "--json", "--quiet",   "--times",
      "--processes", "1",      "--repeats", std::to_string(o.timing.repetitions)};
  if (o.full) out.emplace_back("--full");
  if (!o.filter.empty()) out.insert(out.end(), {"--filter", o.filter});
  return out;
}

std::vector<std::vector<double>> times_in_processes(const CostOptions& o,
                                                    const std::vector<CostName>& names,
                                                    const std::function<void(double)>& done) {
  if (o.processes < 2 || o.program.empty() || names.empty()) return {};
  constexpr double most_seconds = 3600;
  const auto arguments = arguments_of_a_process(o);
  std::vector<std::vector<double>> out(names.size());
  for (int process = 0; process < o.processes; ++process) {
    const auto ran = run_program(o.program, arguments, "", most_seconds);
    if (!ran || ran->status != 0) return {};
    std::map<CostName, double> found;
    try {
      for (const auto& e : costs_of(ran->output, o.program).entries)
        found.emplace(e.name, e.time.ns);
    } catch (const Error&) {
      return {};  // another program than it should be
    }
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto at = found.find(names[i]);
      if (at == found.end()) return {};
      out[i].push_back(at->second);
    }
    done((process + 1.0) / o.processes);
  }
  return out;
}

}  // namespace gonio
