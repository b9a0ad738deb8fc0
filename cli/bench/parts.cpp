// gonio bench parts: what a part of many tables takes beside one process for all, in one run.
#include <algorithm>
#include <fstream>

#include "base/error.h"
#include "cli/bench/bench.h"
#include "cli/bench/place.h"
#include "cli/line/terminal.h"
#include "data_synth/synth.h"
#include "table/format/formats.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gonio::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t tables = 256;
constexpr int counts[] = {2, 4, 8};

/// Tables of paints, each another, and the list that names them.
std::string make_list(const BenchFolder& place) {
  const std::string list = place / "list.txt";
  std::ofstream out(list);
  for (std::size_t k = 0; k < tables; ++k) {
    const double u = static_cast<double>(k) / tables;
    const auto model = bind_model(
        "lambert+ggx/smith_ggx.correlated/schlick",
        {{"alpha", {0.1 + 0.4 * u}}, {"f0", {0.05}}, {"kd", {0.4 - 0.2 * u, 0.2, 0.1}}}, 3);
    SynthOptions options;
    options.layout = Layout::random;
    options.samples = 500;
    options.noise = 0.02;
    options.seed = k + 1;
    const std::string path = place / fmt::format("table{:03}.csv", k);
    write_table(synthesize(model, options), path);
    out << path << '\n';
  }
  if (!out.flush()) throw bad_input(list, "writing", "no success", "room");
  return list;
}

/// Milliseconds of one process on one thread that fits the list, or a part of it.
double time_of(const std::string& list, const std::string& results, const std::string& part) {
  std::vector<std::string> words{"fit", "@" + list, "-o", results, "--quiet", "--jobs", "1"};
  if (!part.empty()) words.insert(words.end(), {"--part", part});
  const Stopwatch begin;
  if (run_program(words) != 0)
    throw bad_input(list, "fitting its tables", "another exit code", "0, as of any such list");
  return begin.ms();
}

}  // namespace

Exit bench_parts(const FitBench& o, const Common& common) {
  Progress progress(common.quiet);
  const BenchFolder place;
  progress("making tables");
  const std::string list = make_list(place);
  std::vector<double> whole, nothing;
  std::vector<std::vector<double>> slowest(std::size(counts)), share(std::size(counts));
  for (int i = 0; i < o.repeats; ++i) {
    progress(fmt::format("round {} of {}", i + 1, o.repeats));
    whole.push_back(time_of(list, place / fmt::format("whole{}", i), ""));
    for (std::size_t c = 0; c < std::size(counts); ++c) {
      const std::string results = place / fmt::format("parts{}_{}", i, counts[c]);
      double most =
          0;  // one after the other: each has a processor to itself, as on a machine of its own
      for (int k = 1; k <= counts[c]; ++k)
        most = std::max(most, time_of(list, results, fmt::format("{}/{}", k, counts[c])));
      slowest[c].push_back(most);
      share[c].push_back(most * counts[c] / whole.back());
      if (counts[c] == 8) nothing.push_back(time_of(list, results, "1/8"));
    }
  }
  Json json{{"tables", tables}, {"whole_ms", spread_of(whole)}, {"rows", Json::array()}};
  for (std::size_t c = 0; c < std::size(counts); ++c)
    json["rows"].push_back({{"parts", counts[c]},
                            {"slowest_ms", spread_of(slowest[c])},
                            {"ratio_to_an_even_share", spread_of(share[c])}});
  json["nothing_to_do_ms"] = spread_of(nothing);
  progress.clear();
  if (common.json) {
    print_document(json);
    return Exit::done;
  }
  const auto words = [](const std::vector<double>& x, std::string_view form) {
    const Json s = spread_of(x);
    return fmt::format(fmt::runtime(form), s["median"].get<double>(), s["least"].get<double>(),
                       s["most"].get<double>());
  };
  fmt::print("{} tables of 500 directions, one thread a process; median [least, most] of {}\n",
             tables, o.repeats);
  fmt::print("one process for all               {}\n",
             words(whole, "{:8.0f} ms  [{:.0f}, {:.0f}]"));
  for (std::size_t c = 0; c < std::size(counts); ++c)
    fmt::print("slowest of {} parts, × {} over that {}\n", counts[c], counts[c],
               words(share[c], "{:8.2f}     [{:.2f}, {:.2f}]"));
  fmt::print("part 1/8 that finds all done      {}\n",
             words(nothing, "{:8.0f} ms  [{:.0f}, {:.0f}]"));
  return Exit::done;
}

}  // namespace gonio::cli
