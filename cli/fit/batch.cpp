// gonio batch: a batch in parts, written for the programs that share work among machines.
#include "fitting/batch/batch.h"

#include <algorithm>
#include <filesystem>

#include "base/file.h"
#include "base/process.h"
#include "cli/fit/fit_options.h"
#include "cli/line/command.h"
#include "cli/line/terminal.h"
#include "fitting/batch/job.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gonio::cli {
namespace {

namespace fs = std::filesystem;

struct BatchCall : Common {
  Engine engine{};
  std::string output, results = "results";
  std::vector<std::string> files;
  HowFitted how;
  bool pages = false;
  std::optional<std::size_t> parts;
  std::vector<Option> for_fit;  ///< those that the parts are given
};

/// How the job is begun.
std::string begun_by(Engine engine, const std::string& file) {
  const std::string word = path_word(file);
  switch (engine) {
    case Engine::slurm:
      return "sbatch " + word;
    case Engine::openjd:
      return "openjd run " + word;
    case Engine::commands:
      return "parallel < " + word;
  }
  return "";
}

Exit run(const BatchCall& o) {
  constexpr std::size_t usual_parts = 8;
  if (!is_batch(o.files))
    throw wrong_usage("parts are of many tables: a folder, several files, or @LIST");
  check(o.how.options);
  Job job{this_program(), fs::current_path().string(), o.files, {}, o.results, 0, 1, o.jobs};
  for (const auto& option : o.for_fit)
    std::ranges::copy(option.given(), std::back_inserter(job.options));
  job.tables = tables_of(o.files).size();
  job.parts = o.parts.value_or(std::min(usual_parts, job.tables));
  const std::string text = job_text(o.engine, job), then = gather_command(job);
  if (o.output.empty() && o.json)
    throw wrong_usage("--json prints a document: the job goes to -o FILE");
  if (o.output.empty()) {
    fmt::print("{}", text);
    return Exit::done;
  }
  check_outputs({}, {o.output});
  write_file(o.output, text);
  const std::string begin = begun_by(o.engine, o.output);
  if (o.json) {
    print_document({{"engine", name_of(o.engine)},
                    {"output", o.output},
                    {"tables", job.tables},
                    {"parts", job.parts},
                    {"begin", begin},
                    {"then", then}});
    return Exit::done;
  }
  say("written  {}: {} in {}\n", o.output, counted(job.tables, "table"),
      counted(job.parts, "part"));
  say("begin    {}\n", begin);
  say("then     {}\n", then);
  return Exit::done;
}

}  // namespace

void add_batch(CommandLine& line) {
  auto [c, o] = line.command<BatchCall>(
      "batch",
      "Writes the fit of many tables in parts for Slurm, Open Job Description, or as commands",
      "gonio batch --write slurm @list.txt --parts 8 --results results/ -o job.sh; sbatch job.sh\n"
      "  gonio gather results/",
      run);
  o->jobs = 1;
  add_tables(c, o->files);
  c.option("--write", o->engine,
           "slurm: an array of sbatch, whose tasks are begun again when a node is lost; openjd: a "
           "template of Open Job Description; commands: one a line, for GNU parallel or cuecmd")
      .required();
  c.option("--parts", o->parts, "How many parts (default: 8, or one for each table)")
      .in(std::size_t{1}, std::size_t{1'000'000});
  c.option("--results", o->results, "The folder for the results").show_default();
  c.option("-o,--output", o->output, "The job (default: it is printed)");
  o->for_fit = c.options(o->how);
  o->for_fit.push_back(add_pages(c, o->pages));
  c.option("--jobs", o->jobs, "Threads of each part").in(1, 1024).show_default();
  add_output(c, *o);
}

}  // namespace gonio::cli
