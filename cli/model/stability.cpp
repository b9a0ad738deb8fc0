// gonio stability: what a formula keeps in a number, over one's own domain.
#include <algorithm>
#include <cmath>

#include "brdf/catalogue/foreign_terms.h"
#include "brdf/model/roughness.h"
#include "cli/line/command.h"
#include "cli/line/reading.h"
#include "cli/line/terminal.h"
#include "foreign/function.h"
#include "reports/finding/words.h"
#include "stability/answer.h"
#include "stability/search.h"

#include <fmt/format.h>

namespace gonio::cli {
namespace {

using namespace stability;

struct StabilityCall : Common {
  ReadingWords reading;
  std::string subject, number = "half", require = "finite";
  std::optional<std::string> form;
  std::vector<std::string> domain;
  bool flush = false, contract = false, any_gpu = false, least = false;
  std::optional<std::uint64_t> boxes;
  std::uint64_t seed = Question{}.seed;
};

/// The subject in the form that was asked for, or in the one that has the inputs of the domain, or in the first.
Subject chosen(const StabilityCall& o, const std::vector<Setting>& domain) {
  const auto name = read_as(o.subject, o.reading);
  if (o.form) return subject_of(name, *o.form);
  const auto all = subjects_of(name);
  const auto has_all = [&](const Subject& s) {
    return std::ranges::all_of(domain, [&](const Setting& d) {
      return std::ranges::find(s.inputs, d.name, &Input::name) != s.inputs.end();
    });
  };
  const auto at = std::ranges::find_if(all, has_all);
  return at == all.end() ? all.front() : *at;
}

std::string evidence_text(const Answer& a) {
  switch (a.evidence) {
    case Evidence::proved:
      if (a.boxes == 0) return "proved for every input, by Gappa";
      return fmt::format("proved for every input, in {} {}", a.boxes,
                         a.boxes == 1 ? "box" : "boxes");
    case Evidence::exhaustive:
      return a.looked.evaluations == 1
                 ? "its one input was looked at"
                 : fmt::format("every one of {} inputs was looked at", a.looked.evaluations);
    case Evidence::searched:
      return fmt::format("a search of {} inputs found one", a.looked.evaluations);
    case Evidence::open:
      break;
  }
  const auto looking =
      fmt::format("{} of {} inputs{} found nothing",
                  a.looked.evidence == Evidence::exhaustive ? "a look at every one" : "a search",
                  a.looked.evaluations, a.arithmetic.any_gpu ? " in IEEE arithmetic" : "");
  if (a.boxes == 0)
    return fmt::format("{}, which proves nothing{}{}", looking,
                       a.unproved_because.empty() ? "" : "; no proof: ", a.unproved_because);
  return fmt::format("neither proved nor refuted: {:.3g} % of the domain stay open, and {}; {}",
                     100 * a.open_share, looking, a.unproved_because);
}

/// "alpha 0.0042 (roughness 0.065)", "nowhere"
std::string least_text(const Least& l, const std::string& decides, bool narrows) {
  if (!l.value) return "nowhere";
  const auto value = narrows ? rounded_down(*l.value, 4) : rounded_up(*l.value, 4);
  return is_alpha(decides) ? fmt::format("{} {} ({} {})", decides, value, roughness_name(decides),
                                         rounded_up(roughness_of(*l.value), 3))
                           : fmt::format("{} {}", decides, value);
}
std::string evidence_of_least(const Least& l) {
  if (l.evidence == Evidence::exhaustive) return "every input looked at";
  return l.evidence == Evidence::proved ? "proved" : "searched: there may be worse";
}

bool is_relative(const Answer& a) {
  return a.requirement.starts_with("relative=");
}

/// \param decides  name of the parameter from which a requirement holds
/// \param narrows  or up to which
void print(const Answer& a, const std::string& decides, bool narrows) {
  const auto line = [](const char* name, const std::string& text) {
    fmt::print("  {:<16}{}\n", name, text);
  };
  // A file's whole model is no diffuse term, which is only where it stands in a sum.
  constexpr std::string_view role = "diffuse.";
  const bool is_own = a.id.starts_with(role) && foreign::is_name(a.id.substr(role.size()));
  fmt::print("{}, angles by {}, in {}\n", is_own ? a.id.substr(role.size()) : a.id, a.form,
             text_of(a.arithmetic));
  for (const auto& [name, ends] : a.domain)
    line(name.c_str(), fmt::format("{:.6g} to {:.6g}", ends[0], ends[1]));
  line(a.requirement.c_str(), fmt::format("{}: {}",
                                          a.holds            ? "holds"
                                          : a.counterexample ? "does not hold"
                                                             : "open",
                                          evidence_text(a)));
  if (const auto& c = a.counterexample) {
    for (std::size_t k = 0; k < c->inputs.size(); ++k)
      line(k == 0 ? "at" : "", fmt::format("{} = {:.9g}  {}", c->inputs[k].first,
                                           c->inputs[k].second, c->inputs_hex[k].second));
    line("",
         fmt::format("gives {:.9g}{}, exact {:.9g}", c->value,
                     a.arithmetic.any_gpu ? " in an arithmetic that GPUs may have" : "", c->exact));
    if (const double least = least_asked(a.arithmetic.number);
        is_relative(a) && std::abs(c->exact) < least && std::isfinite(c->value))
      line("", fmt::format("off by {:.2g} of {:.3g}, the least that is asked for",
                           std::abs(c->value - c->exact) / least, least));
  }
  if (!a.worst_at.empty())
    line("worst found", fmt::format("{:.2g} relative{}, at {}, where values are normal numbers",
                                    a.looked.relative.value,
                                    a.arithmetic.any_gpu ? " in IEEE arithmetic" : "", a.worst_at));
  if (a.proved_rel) line("proved", fmt::format("{:.2g} relative at most", *a.proved_rel));
  if (a.range) line("within", fmt::format("{:.6g} to {:.6g}, proved", a.range->low, a.range->high));
  if (const auto& from = a.safe_from)
    line(narrows ? "safe up to" : "safe from",
         fmt::format("{}{}: {}{}, {}", least_text(*from, decides, narrows),
                     from->evidence == Evidence::searched && a.arithmetic.any_gpu
                         ? " in IEEE arithmetic"
                         : "",
                     from->requirement,
                     !from->value ? " holds at no value"
                     : narrows    ? " up to there"
                                  : " from there on",
                     evidence_of_least(*from)));
  for (const auto& l : a.least)
    line(&l == &a.least[0] ? "least" : "",
         fmt::format("{:<16}{:<14}{:<33} {}", l.requirement,
                     a.arithmetic.number != Number::half ? ""
                     : l.flush                           ? "flushed"
                                                         : "kept",
                     least_text(l, decides, narrows), evidence_of_least(l)));
  if (!a.looked.settled) line("not settled", "searches from two seeds differ: there may be worse");
}

Exit run(const StabilityCall& o) {
  use(o);
  std::vector<Setting> domain = parse_settings(o.domain);
  Question q;
  q.subject = chosen(o, domain);
  if (is_foreign(o.subject)) take_foreign_guesses();  // nothing is taken out of its text
  q.arithmetic = {value_of<Number>(o.number, "number"), o.flush, o.contract, o.any_gpu};
  q.requirement = parse_requirement(o.require);
  q.boxes = o.boxes;
  q.seed = o.seed;
  for (const auto& d : domain) {
    if (d.values.size() != 2)
      throw wrong_usage(fmt::format("domain {}: expected LOW,HIGH", d.name));
    set_domain(q.subject, d.name, {d.values[0], d.values[1]});
  }
  expect_bounded(q.subject);
  Progress progress(o.quiet);
  progress("looking");
  auto a = answer(q);
  if (o.least) a.least = least_values(q);
  progress.clear();
  if (o.json)
    fmt::print("{}", to_json(a));
  else
    print(a, q.subject.decides ? q.subject.inputs[*q.subject.decides].name : "", q.subject.narrows);
  return a.holds ? Exit::done : Exit::check_failed;
}

}  // namespace

void add_stability(CommandLine& line) {
  auto [c, o] = line.command<StabilityCall>(
      "stability",
      "Says whether a formula keeps what is required of it in few bits, for every input of a "
      "domain; exit 1 with a "
      "counterexample where it does not, or where that stays open",
      "gonio stability ndf.ggx --number half --domain alpha=0.05,1 --require relative=0.02", run);
  c.option("ID", o->subject, "Term, as `gonio models` lists it, or a model's spec").required();
  add_reading(c, o->reading);
  c.option("--number", o->number,
           "Number type: half, rounded after every operation; mixed, half parameters and float "
           "angles; float; double")
      .one_of(std::array{"half", "mixed", "float", "double"});
  c.option("--form", o->form,
           "How a distribution's half vector is given: cross, |n × h|²; cosine, only NoH");
  c.option("--domain", o->domain, "Ends of an input: NAME=LOW,HIGH …  (default: the hard domain)")
      .at_most(64);
  c.option("--require", o->require,
           "finite; nonnegative; relative=X: most |x/f − 1|; absolute=X: most |x − f|");
  c.flag("--least", o->least,
         "Also names, for every requirement, the least alpha (or what else decides) from which it "
         "holds; in half for results below the least normal number kept, and flushed");
  c.flag("--flush", o->flush, "Results below the least normal number become 0");
  c.flag("--contract", o->contract, "A product and a sum are rounded once");
  c.flag("--any-gpu", o->any_gpu,
         "What is proved holds on every GPU that keeps Vulkan 1.4: for half, float, and double, of "
         "which Vulkan asks no "
         "more than of float; for shaders without float controls (no execution mode for rounding, "
         "denormals, infinities "
         "or NaN), every expression `precise`, or with --contract a b + c fused at will; √0 is 0; "
         "subnormals kept or "
         "flushed");
  c.option("--boxes", o->boxes,
           "Boxes of a proof, after which what is unproved is open  (default: 20 000, fewer where "
           "they take longer)")
      .in(std::uint64_t{1}, std::uint64_t{1'000'000});
  c.option("--seed", o->seed, "Seed of the search (1)");
  add_jobs(c, *o);
  add_output(c, *o);
}

}  // namespace gonio::cli
