#pragma once
/// \file
/// A subcommand: it declares its options and says what to run; parsing and printing only.

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "brdf/model.h"
#include "table/table.h"

#include <CLI/CLI.hpp>

namespace gonio::cli {

/// What the program does after parsing; set by the subcommand that was called.
using Action = std::function<Exit()>;

void add_models(CLI::App&, Action&);
void add_term(CLI::App&, Action&);
void add_audit(CLI::App&, Action&);
void add_eval(CLI::App&, Action&);
void add_synth(CLI::App&, Action&);
void add_columns(CLI::App&, Action&);
void add_convert(CLI::App&, Action&);
void add_inspect(CLI::App&, Action&);
void add_compare(CLI::App&, Action&);
void add_fit(CLI::App&, Action&);
void add_bench(CLI::App&, Action&);
void add_albedo(CLI::App&, Action&);
void add_split_sum(CLI::App&, Action&);
void add_report(CLI::App&, Action&);

/// Entries of the catalogue that are neither term nor map nor composed of terms, and what evaluates them.
struct Evaluated {
  const About* about;
  std::string_view by;
};
std::span<const Evaluated> evaluated_by_commands();

/// A subcommand with its example under the help, running `run` on options that it keeps alive.
template <class Options>
CLI::App* add_command(CLI::App& app,
                      Action& action,
                      const std::string& name,
                      const std::string& description,
                      const std::string& example,
                      std::shared_ptr<Options> options,
                      Exit (*run)(const Options&)) {
  auto* c = app.add_subcommand(name, description);
  c->footer("Example:\n  " + example);
  c->callback([options, run, &action] { action = [options, run] { return run(*options); }; });
  return c;
}

/// --set NAME=VALUE …
inline void add_set(CLI::App* c, std::vector<std::string>& words) {
  c->add_option("--set", words, "Parameters: NAME=VALUE …; a colour is one number or r,g,b")
      ->expected(1, 64);
}
/// --seed N; a negative number would wrap around
template <class Seed>
void add_seed(CLI::App* c, Seed& seed, const std::string& what) {
  c->add_option("--seed", seed, what)->check([](const std::string& word) -> std::string {
    return word.starts_with('-') ? "'" + word + "' is below 0" : "";
  });
}
/// --bins centre|edge
inline void add_bins(CLI::App* c, std::optional<std::string>& name) {
  c->add_option(
       "--bins", name,
       "Where a sample sits in its bin: centre or edge (default: as the file says, or centre)")
      ->check(CLI::IsMember({"centre", "edge"}));
}
inline std::optional<Bins> bins_from(const std::optional<std::string>& name) {
  if (!name) return {};
  return *name == "edge" ? Bins::edge : Bins::centre;
}
/// What most subcommands share.
struct Common {
  bool json = false, quiet = false;
  int jobs = 0;
};
/// --json, --quiet
void add_output(CLI::App* c, Common&);
/// --jobs N
void add_jobs(CLI::App* c, Common&);
/// Threads from now on: at most `jobs`, 0 for all.
void use_jobs(int jobs);
/// Refuses outputs that are an input, or its side file, or each other, or "-".
void check_outputs(const std::vector<std::string>& inputs, const std::vector<std::string>& outputs);

/// The position of a name among the fixed names of a contract.
template <std::size_t N, class Name>
std::size_t index_of(const std::array<Name, N>& names, std::string_view name) {
  for (std::size_t i = 0; i < N; ++i)
    if (name == names[i]) return i;
  return N;
}
template <std::size_t N, class Name>
CLI::IsMember one_of(const std::array<Name, N>& names) {
  return CLI::IsMember(std::vector<std::string>(names.begin(), names.end()));
}

}  // namespace gonio::cli
