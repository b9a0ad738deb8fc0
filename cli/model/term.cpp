// gonio term: one factor of a model, evaluated on its own.
#include "answer/term.h"

#include "brdf/model/spec.h"
#include "cli/line/command.h"
#include "cli/line/reading.h"
#include "cli/line/terminal.h"

#include <fmt/format.h>

namespace gonio::cli {
namespace {

struct TermCall : Common {
  ReadingWords reading;
  std::string id, number = "double";
  std::vector<std::string> set, at;
};

Exit run(const TermCall& o) {
  TermQuestion question{read_as(o.id, o.reading), o.number, {}, {}};
  for (auto& s : parse_settings(o.set)) {
    if (s.values.size() != 1)
      throw wrong_usage(fmt::format("{}: one number, a term has no channels", s.name));
    question.parameters[s.name] = s.values[0];
  }
  for (auto& s : parse_settings(o.at)) question.at[s.name] = s.values;
  const TermAnswer a = answer(question);
  if (o.json)
    fmt::print("{}", to_json(a, question));
  else
    for (const auto& row : a.values) fmt::print("{}\n", fmt::join(row, " "));
  return Exit::done;
}

}  // namespace

void add_term(CommandLine& line) {
  auto [c, o] = line.command<TermCall>(
      "term", "Evaluates one term or map; a masking term gives G2, or G1 when only nov is given",
      "gonio term ndf.ggx --set alpha=0.25 --at noh=1,0.9 --json", run);
  c.option("ID", o->id, "Term or map, as `gonio models` lists it").required();
  add_set(c, o->set);
  add_reading(c, o->reading);
  c.option("--at", o->at,
           "Cosines: noh, nol, nov, voh or cos; of the tangent frame xoh, yoh, xol, yol, xov, yov; "
           "and sin2_theta_h = values")
      .at_most(64);
  c.option("--number", o->number,
           "Number type: double; float; half, rounded after every operation; wide, fifty "
           "digits; mixed, half parameters and float angles")
      .one_of(names_of<Number>);
  add_output(c, *o);
}

}  // namespace gonio::cli
