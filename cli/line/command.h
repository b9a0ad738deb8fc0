#pragma once
/// \file
/// A subcommand: it declares its options and says what to run; parsing and printing only.

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "brdf/model/model.h"
#include "cli/line/command_line.h"
#include "table/table.h"

namespace gonio::cli {

void add_models(CommandLine&);
void add_term(CommandLine&);
void add_audit(CommandLine&);
void add_eval(CommandLine&);
void add_explore(CommandLine&);
void add_synth(CommandLine&);
void add_columns(CommandLine&);
void add_convert(CommandLine&);
void add_inspect(CommandLine&);
void add_compare(CommandLine&);
void add_fit(CommandLine&);
void add_gather(CommandLine&);
void add_batch(CommandLine&);
void add_bench(CommandLine&);
void add_albedo(CommandLine&);
void add_split_sum(CommandLine&);
void add_report(CommandLine&);
void add_stability(CommandLine&);
void add_validate(CommandLine&);
void add_export(CommandLine&);
void add_shader(CommandLine&);
void add_plan(CommandLine&);
void add_verify(CommandLine&);
void add_render(CommandLine&);
void add_stack(CommandLine&);
void add_fit_map(CommandLine&);
void add_schema(CommandLine&);
void add_manual(CommandLine&);

/// Help of an argument that takes either.
inline constexpr const char* spec_or_fit = "Model, or the fit.json of a fit";

/// --set NAME=VALUE …
void add_set(Command&, std::vector<std::string>& words);
/// --bins centre|edge
void add_bins(Command&, std::optional<Bins>&);
/// Two whole numbers of a word: "3,4"; "5" is 5,5 where one stands for both.
/// \throws Error  wrong usage, of a word that is none or numbers outside [low, high]
std::array<std::size_t, 2> two_numbers(const std::string& word,
                                       const char* option,
                                       std::size_t low,
                                       std::size_t high,
                                       bool one_for_both);
/// Options that most subcommands share.
struct Common {
  bool json = false, quiet = false, follow_paths = false;
  int jobs = 0;
};
/// --json, --quiet
void add_output(Command&, Common&);
/// --follow-paths, of commands whose documents name files
void add_follow_paths(Command&, Common&);
/// --jobs N
void add_jobs(Command&, Common&);
/// From now on at most `jobs` threads, 0 for all, and documents that may name files elsewhere.
void use(const Common&);
int threads_in_use();
/// Refuses inputs that are not there, before anything is said of the outputs; outputs that are an input, or its side file, or
/// each other, or "-".  What the inputs name is held against the outputs when it is read (FileGuard).
void check_outputs(const std::vector<std::string>& inputs, const std::vector<std::string>& outputs);

}  // namespace gonio::cli
