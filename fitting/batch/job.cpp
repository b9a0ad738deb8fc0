#include "fitting/batch/job.h"

#include <algorithm>

#include "base/error.h"
#include "base/json/reader.h"
#include "base/text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

std::string in_words(const std::vector<std::string>& words) {
  std::string line;
  for (const auto& w : words) line += (line.empty() ? "" : " ") + shell_word(w);
  return line;
}

/// Words of a part's fit.  \param part  "2/8", or "slurm"
std::vector<std::string> fit_words(const Job& j, const std::string& part) {
  std::vector<std::string> words{j.program, "fit"};
  std::ranges::transform(j.inputs, std::back_inserter(words), as_path);
  words.insert(words.end(), j.options.begin(), j.options.end());
  words.insert(words.end(), {"--part", part, "--jobs", std::to_string(j.threads), "--quiet", "-o",
                             as_path(j.results)});
  return words;
}
std::vector<std::string> gather_words(const Job& j) {
  std::vector<std::string> words{j.program, "gather", as_path(j.results)};
  std::ranges::transform(j.inputs, std::back_inserter(words), as_path);
  return words;
}

std::string in_folder(const Job& j, const std::vector<std::string>& words) {
  return "cd " + shell_word(j.folder) + " && " + in_words(words);
}

std::string what(const Job& j) {
  return fmt::format("gonio fit of {} in {}", counted(j.tables, "table"), counted(j.parts, "part"));
}

/// A task that a node takes with it is run again, and its part keeps what is there.
std::string slurm(const Job& j) {
  return fmt::format(R"(#!/bin/bash
# {}. When all have ended: {}
#SBATCH --job-name=gonio-fit
#SBATCH --array=1-{}
#SBATCH --cpus-per-task={}
#SBATCH --requeue
#SBATCH --open-mode=append
cd {} || exit 3
exec {}
)",
                     what(j), gather_command(j), j.parts, j.threads, shell_word(j.folder),
                     in_words(fit_words(j, "slurm")));
}

std::string commands(const Job& j) {
  constexpr std::size_t most = std::size_t{1} << 28;
  if (const std::size_t line = in_folder(j, fit_words(j, "")).size(); line > most / j.parts)
    throw wrong_usage(
        fmt::format("--parts {}: {} bytes in each of as many lines, at most {} in all; name the "
                    "tables in @LIST",
                    j.parts, line, most));
  std::string lines;
  for (std::size_t k = 1; k <= j.parts; ++k)
    lines += in_folder(j, fit_words(j, fmt::format("{}/{}", k, j.parts))) + "\n";
  return lines;
}

Json step(const std::string& name, const std::string& command) {
  Json run;
  run["command"] = "sh";
  run["args"] = {"-c", command};
  Json out;
  out["name"] = name;
  out["script"]["actions"]["onRun"] = run;
  return out;
}

/// A step for the parts, and one for the summary after it.
std::string openjd(const Job& j) {
  const std::string part = "{{Task.Param.Part}}/{{Param.Parts}}";  // numbers when the shell sees it
  const Json parts = {{"name", "Parts"},
                      {"type", "INT"},
                      {"default", j.parts},
                      {"minValue", 1},
                      {"description", "How many parts the tables are dealt out to"}};
  const Json range = {{"name", "Part"}, {"type", "INT"}, {"range", "1-{{Param.Parts}}"}};
  const Json threads = {{"name", "amount.worker.vcpu"}, {"min", j.threads}};
  const Json after = {{"dependsOn", "Fit"}};
  Json fit = step("Fit", in_folder(j, fit_words(j, part)));
  fit["parameterSpace"]["taskParameterDefinitions"] = Json::array({range});
  fit["hostRequirements"]["amounts"] = Json::array({threads});
  Json gather = step("Gather", in_folder(j, gather_words(j)));
  gather["dependencies"] = Json::array({after});
  Json out;
  out["specificationVersion"] = "jobtemplate-2023-09";
  out["name"] = what(j);
  out["parameterDefinitions"] = Json::array({parts});
  out["steps"] = Json::array({fit, gather});
  return text_of(out);
}

}  // namespace

std::string job_text(Engine engine, const Job& j) {
  for (const auto& words : {fit_words(j, ""), {j.folder}})
    for (const auto& word : words) {
      if (printable(word) != word)
        throw wrong_usage(
            fmt::format("'{}' cannot stand in a job: it holds a control character, or is no UTF-8",
                        printable(word, 100)));
      if (engine == Engine::openjd && word.find("{{") != word.npos)
        throw wrong_usage(fmt::format(
            "'{}' cannot stand in a template: '{{{{' begins what the engine replaces there",
            printable(word, 100)));
    }
  switch (engine) {
    case Engine::slurm:
      return slurm(j);
    case Engine::openjd:
      return openjd(j);
    case Engine::commands:
      return commands(j);
  }
  return "";
}

std::string gather_command(const Job& j) {
  return in_words(gather_words(j));
}

}  // namespace gonio
