#include "stability/answer.h"

#include <array>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "brdf/model/spec.h"
#include "stability/evaluate.h"
#include "stability/exhaustive.h"
#include "stability/prove.h"
#include "stability/prove_relative.h"
#include "stability/search.h"

#include <fmt/format.h>

namespace gonio::stability {
namespace {

constexpr std::string_view relative_prefix = "relative=", absolute_prefix = "absolute=";

NamedInput named(const Subject& s, const Arithmetic& a, std::span<const double> inputs) {
  const Number number = a.number;
  NamedInput out{{}, {}, value_of(s, a, inputs), truth_of(s, rounded(s, number, inputs)).value};
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    out.inputs.emplace_back(s.inputs[k].name, inputs[k]);
    out.inputs_hex.emplace_back(s.inputs[k].name, hex(number, inputs[k], k < s.parameters));
  }
  return out;
}

/// Arithmetic that is looked at: of any GPU IEEE's, which is one of those that the rule allows.
Arithmetic looked_at(const Arithmetic& a) {
  return a.any_gpu ? Arithmetic{a.number} : a;
}

/// Inputs for which looking found that the requirement does not hold; empty: none.  What has no value keeps none, and
/// an error is asked of what is small, too.
std::vector<double> broken_at(const Looked& looked, const Requirement& required) {
  const auto first = [](std::initializer_list<const Count*> counts) {
    for (const Count* c : counts)
      if (c->count > 0) return c->first;
    return std::vector<double>{};
  };
  const auto none = first({&looked.no_value, &looked.overflow, &looked.undefined});
  if (!none.empty() || required.kind == Requirement::Kind::finite) return none;
  if (required.kind == Requirement::Kind::nonnegative)
    return first({&looked.negative, &looked.negative_too});
  if (required.kind == Requirement::Kind::relative && looked.relative.value > required.limit)
    return looked.relative.at;
  return first({&looked.lost});
}

bool is_of_error(const Requirement& r) {
  return r.kind == Requirement::Kind::relative || r.kind == Requirement::Kind::absolute;
}
Tolerance tolerance_of(const Requirement& r, Number number) {
  if (r.kind == Requirement::Kind::absolute) return {0, r.limit};
  return r.kind == Requirement::Kind::relative ? r.limit : usual_tolerance(number);
}
Range required_values(Requirement::Kind kind, Number number) {
  return kind == Requirement::Kind::finite ? finite_values(number)
                                           : finite_and_not_negative(number);
}

/// Least value from which a requirement holds.  \param looked  of its tolerance
std::optional<Least> least_of(const Question& q,
                              const Requirement& required,
                              const Looked& looked) {
  if (!q.subject.decides || !q.safe_from) return {};
  const auto& a = q.arithmetic;
  Least least{required.text(), a.flush, looked.from(required.kind), looked.evidence};
  if (looked.evidence == Evidence::exhaustive && !a.any_gpu) return least;
  least.evidence = Evidence::searched;
  if (is_of_error(required) || a.number == Number::mixed || !least.value || !q.proves ||
      q.subject.narrows)
    return least;
  // Below what looking finds broken nothing is proved.
  Subject above = q.subject;
  above.inputs[*above.decides].domain.low = *least.value;
  if (const auto from =
          proved_from(above, a.number, rounding_of(a), required_values(required.kind, a.number)))
    least = {least.requirement, a.flush, from, Evidence::proved};
  return least;
}

void prove_into(Answer& a, const Question& q) {
  const auto number = q.arithmetic.number;
  const auto usual_boxes = static_cast<std::uint64_t>(20'000 * share_of_cheap(q.subject));
  const auto proof =
      prove(q.subject, number, rounding_of(q.arithmetic),
            required_values(q.requirement.kind, number), {.boxes = q.boxes.value_or(usual_boxes)});
  a.evidence = proof.evidence;
  a.boxes = proof.boxes;
  a.open_share = proof.open_share;
  a.range = proof.range;
  if (const auto& c = proof.counterexample) {
    a.counterexample = named(q.subject, looked_at(q.arithmetic), c->inputs);
    a.counterexample->value = c->value;  // of any GPU that of one which flushes
  }
  if (a.evidence != Evidence::open) return;
  a.unproved_because =
      proof.out_of_budget ? "the proof ran out of boxes" : "inputs cannot be told apart further";
  if (!proof.open.empty()) a.unproved_because += "; open is " + proof.open[0].text(q.subject);
}

/// Proof of a bound of the relative error; of all inputs but the ends that it leaves out it holds, and then the rest is open.
void prove_relative_into(Answer& a, const Question& q) {
  const auto proof = prove_relative(q.subject, q.arithmetic.number, rounding_of(q.arithmetic));
  if (!proof.bound) {
    a.unproved_because = proof.why;
    return;
  }
  a.proved_rel = proof.bound;
  if (*proof.bound > q.requirement.limit)
    a.unproved_because = "the bound that is proved is larger";
  else if (!proof.whole)
    a.unproved_because = "the bound that is proved leaves out the domain's very ends";
  else
    a.evidence = Evidence::proved;
}

}  // namespace

std::string Requirement::text() const {
  if (kind == Kind::finite) return "finite";
  if (kind == Kind::nonnegative) return "nonnegative";
  return fmt::format("{}{:g}", kind == Kind::relative ? relative_prefix : absolute_prefix, limit);
}
Requirement parse_requirement(std::string_view text) {
  if (text == "finite") return {};
  if (text == "nonnegative") return {Requirement::Kind::nonnegative, 0};
  for (const auto& [prefix, kind] : {std::pair(relative_prefix, Requirement::Kind::relative),
                                     std::pair(absolute_prefix, Requirement::Kind::absolute)}) {
    if (!text.starts_with(prefix)) continue;
    const auto what = fmt::format("required {}", prefix.substr(0, prefix.size() - 1));
    const double x = parse_number(text.substr(prefix.size()), what);
    if (!(x > 0) || std::isinf(x))
      throw wrong_usage(fmt::format("{}: found {}, expected a number above 0", what, x));
    return {kind, x};
  }
  throw wrong_usage(fmt::format(
      "required: found '{}', expected finite, nonnegative, relative=X or absolute=X", text));
}

std::string text_of(const Arithmetic& a) {
  return fmt::format("{}{}{}{}", name_of(a.number), a.flush ? ", flushed" : "",
                     a.contract ? ", contracted" : "", a.any_gpu ? ", on any GPU" : "");
}
std::string text_of(const Subject& s, std::span<const double> inputs) {
  std::string text;
  for (std::size_t k = 0; k < inputs.size(); ++k)
    text += fmt::format("{}{} {:.6g}", k ? ", " : "", s.inputs[k].name, inputs[k]);
  return text;
}
std::string hex_of(const Subject& s, Number number, std::span<const double> inputs) {
  std::string text;
  for (std::size_t k = 0; k < inputs.size(); ++k)
    text += fmt::format("{}{} {}", k ? ", " : "", s.inputs[k].name,
                        hex(number, inputs[k], k < s.parameters));
  return text;
}

Looked look(const Subject& s,
            const Arithmetic& a,
            const Tolerance& tolerance,
            std::uint64_t seed,
            bool measures_errors,
            bool exhausts) {
  if (exhausts && a.number == Number::half && can_be_exhausted(s))
    return exhaustive(s, {a.flush, a.contract}, tolerance);
  return search(s, a, {.tolerance = tolerance, .seed = seed, .measures_errors = measures_errors});
}

Answer answer(const Question& q) {
  const auto number = q.arithmetic.number;
  const bool any_gpu = q.arithmetic.any_gpu;
  if (any_gpu && number == Number::mixed)
    throw wrong_usage("any GPU: found mixed numbers, expected half, float or double");
  if (any_gpu && q.arithmetic.flush)
    throw wrong_usage("any GPU: found flushing too, expected neither: any GPU may flush or not");
  Answer a;
  a.id = q.subject.id;
  a.form = q.subject.form();
  a.arithmetic = q.arithmetic;
  a.requirement = q.requirement.text();
  for (const auto& i : q.subject.inputs)
    a.domain.emplace_back(i.name, std::vector{i.domain.low, i.domain.high});

  const bool relative = q.requirement.kind == Requirement::Kind::relative;
  a.looked = look(q.subject, looked_at(q.arithmetic), tolerance_of(q.requirement, number), q.seed,
                  q.measures_errors, q.exhausts);
  a.worst_at = text_of(q.subject, a.looked.relative.at);
  a.worst_hex = hex_of(q.subject, number, a.looked.relative.at);
  if (const auto at = broken_at(a.looked, q.requirement); !at.empty()) {
    a.evidence = a.looked.evidence;
    a.counterexample = named(q.subject, looked_at(q.arithmetic), at);
    a.safe_from = least_of(q, q.requirement, a.looked);
    return a;
  }
  if (a.looked.evidence == Evidence::exhaustive && !any_gpu)
    a.evidence = Evidence::exhaustive;
  else if (relative && number != Number::mixed)
    prove_relative_into(a, q);
  else if (q.requirement.kind == Requirement::Kind::absolute)
    a.unproved_because = "no proof of an absolute error is known";
  else if (number != Number::mixed && q.proves)
    prove_into(a, q);
  a.holds = !a.counterexample && a.evidence != Evidence::open;
  if (a.holds && q.subject.decides)
    a.safe_from =
        Least{a.requirement, q.arithmetic.flush, a.looked.from(q.requirement.kind), a.evidence};
  else
    a.safe_from = least_of(q, q.requirement, a.looked);
  return a;
}

std::vector<Least> least_values(const Question& q) {
  using Kind = Requirement::Kind;
  const auto number = q.arithmetic.number;
  const auto limit = [&](Kind kind, double usual) {
    return Requirement{kind, q.requirement.kind == kind ? q.requirement.limit : usual};
  };
  const std::array errors{limit(Kind::relative, usual_tolerance(number)),
                          limit(Kind::absolute, usual_absolute)};
  std::vector<Least> all;
  Question one = q;
  for (const bool flush : {false, true}) {
    if (flush && (number != Number::half || q.arithmetic.any_gpu)) continue;
    one.arithmetic.flush = flush;
    for (const auto& error : errors) {
      const Looked looked =
          look(q.subject, looked_at(one.arithmetic), tolerance_of(error, number), q.seed);
      const auto add = [&](const Requirement& r) {
        if (auto least = least_of(one, r, looked)) all.push_back(std::move(*least));
      };
      if (&error == &errors[0]) add({Kind::finite, 0}), add({Kind::nonnegative, 0});
      add(error);
    }
  }
  return all;
}

}  // namespace gonio::stability
