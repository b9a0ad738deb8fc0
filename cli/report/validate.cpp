// gonio validate: whether a choice keeps its budgets.
#include "validate/validate.h"

#include <algorithm>
#include <array>
#include <optional>

#include "cli/line/command.h"
#include "cli/line/output_files.h"
#include "cli/line/terminal.h"
#include "validate/words.h"

#include <fmt/format.h>

namespace gonio::cli {
namespace {

struct ValidateCall : Common {
  std::string choice, output, page, junit, sarif;
  bool suggest = false;
};

void print(const Validation& v, bool suggested) {
  for (const auto& b : v.budgets) {
    say("{}  {:<14}{:>20} of {:<19} {}\n", b.holds ? "kept  " : "BROKEN", b.budget,
        value_text(b.budget, b.found), value_text(b.budget, b.limit), b.evidence);
    if (!b.holds) say("        {}\n", sentence(b));
  }
  const auto parameters = [](std::string_view side, const std::vector<UsedParameter>& all) {
    std::string text;
    for (const auto& p : all)
      text += fmt::format("{}{} {}", text.empty() ? "" : "; ", p.name, value_text(p));
    if (!text.empty()) say("{:<11}{}\n", side, text);
  };
  parameters("model", v.parameters);
  parameters("reference", v.reference_parameters);
  const auto broken = std::ranges::count(v.budgets, false, &BudgetCheck::holds);
  if (broken == 0)
    say("The choice keeps every budget.\n");
  else
    say("The choice breaks {} of {} budgets.\n", broken, v.budgets.size());
  if (const auto& s = v.suggestion)
    say("{} {}{}. {}\n", s->holds ? "Take" : "The nearest is", s->model,
        s->scattering == "single" ? "" : ", scattering " + s->scattering, s->why);
  else if (suggested)
    say("No masking and Fresnel term of the catalogue fit this distribution and domain.\n");
}

Exit run(const ValidateCall& o) {
  use(o);
  OutputFiles files({o.choice}, o.output, o.page);
  check_outputs({o.choice}, {o.output, o.page, o.junit, o.sarif});
  std::array<std::optional<OutputFile>, 2> reports;
  if (!o.junit.empty()) reports[0].emplace(o.junit);
  if (!o.sarif.empty()) reports[1].emplace(o.sarif);
  const Choice choice = read_choice(o.choice);
  Progress progress(o.quiet);
  Validation v =
      validate(choice, [&](std::string_view what, double) { progress(std::string(what)); });
  if (o.suggest)
    v.suggestion =
        suggest(choice, [&](std::string_view what, double) { progress(std::string(what)); });
  progress.clear();
  const auto document = to_json(v);
  files.write_document(document);
  if (files.has_page()) files.write_page(validation_page_html(v), document);
  if (reports[0]) reports[0]->write(junit_of(v));
  if (reports[1]) reports[1]->write(sarif_of(v));
  const auto made = [](std::optional<OutputFile>& f) { return f ? &*f : nullptr; };
  files.commit({made(reports[0]), made(reports[1])});
  if (o.json)
    fmt::print("{}\n", document);
  else
    print(v, o.suggest);
  return v.holds() ? Exit::done : Exit::check_failed;
}

}  // namespace

void add_validate(CommandLine& line) {
  auto [c, o] = line.command<ValidateCall>(
      "validate",
      "Checks a choice of a material model against its budgets, and names "
      "the worst input where one "
      "is broken (exit 1)",
      "gonio validate choice.json --junit gonio.xml", run);
  c.option("CHOICE", o->choice, "Choice, gonio.choice/1").required();
  c.option("-o,--output", o->output, "The validation as a document, gonio.validation/1");
  c.option("--html", o->page, "The validation as a page");
  c.option("--junit", o->junit, "The validation as JUnit's XML: a test case a budget");
  c.option("--sarif", o->sarif, "Budgets that are broken as SARIF 2.1.0");
  c.flag("--suggest", o->suggest,
         "Names the cheapest masking, Fresnel term and scattering that keep every budget, or the "
         "nearest and what stops it");
  add_follow_paths(c, *o);
  add_jobs(c, *o);
  add_output(c, *o);
}

}  // namespace gonio::cli
