// gonio report: studies of the shipped approximations, each as data and as a page.
#include <array>
#include <filesystem>
#include <system_error>

#include "base/file.h"
#include "cli/command.h"
#include "cli/terminal.h"
#include "reports/energy.h"

namespace gonio::cli {
namespace {

struct Options : Common {
  std::string name, output;
  std::vector<std::string> environments;
  bool full = false;
};
constexpr std::array report_names{"energy"};

Exit run(const Options& o) {
  namespace fs = std::filesystem;
  use_jobs(o.jobs);
  auto options = energy_options(o.full);
  for (const auto& path : o.environments)
    options.environments.push_back({fs::path(path).stem().string(), read_environment(path)});
  std::error_code error;
  fs::create_directories(o.output, error);
  if (error) throw bad_input(o.output, "making the folder", error.message(), "a place to write");
  const auto place = [&](const std::string& ending) {
    return (fs::path(o.output) / (o.name + ending)).string();
  };
  OutputFile page(place(".html")), data(place(".json"));

  Progress progress(o.quiet);
  const auto begin = std::chrono::steady_clock::now();
  constexpr std::size_t all = 1000;
  const auto report = energy_report(options, [&](std::string_view what, double part) {
    const auto done = static_cast<std::size_t>(part * all);
    progress(fmt::format("{}, {} %{}", what, done / 10, time_left(begin, done, all)));
  });
  progress.clear();
  const std::string json = to_json(report);
  page.write(energy_page_html(json));
  data.write(json + "\n");
  for (auto* f : {&data, &page}) f->close();  // both whole before the first takes its name
  for (auto* f : {&data, &page}) f->commit();
  if (o.json) {
    fmt::print("{}\n", json);
  } else {
    for (const auto& sentence : report.findings) fmt::print("{}\n", sentence);
    fmt::print("{}\n", place(".html"));
  }
  return Exit::done;
}

}  // namespace

void add_report(CLI::App& app, Action& action) {
  auto o = std::make_shared<Options>();
  auto* c = add_command(
      app, action, "report",
      "Studies what shipped approximations cost and lose: a page DIR/NAME.html and its data, "
      "DIR/NAME.json",
      "gonio report energy -o reports", o, run);
  c->add_option("NAME", o->name, "energy: what single scattering loses, what gives it back")
      ->check(one_of(report_names))
      ->required();
  c->add_option("-o,--output", o->output, "Folder, made where it is not there")->required();
  c->add_option("--environment", o->environments,
                "Environment maps, latitude by longitude in OpenEXR: what the split sum is off by "
                "under each")
      ->expected(1, 64);
  c->add_flag("--full", o->full, "Finer in roughness and angle, some minutes");
  add_jobs(c, *o);
  add_output(c, *o);
}

}  // namespace gonio::cli
