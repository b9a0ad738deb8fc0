#include "stability/answer.h"

#include <cmath>

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

constexpr std::string_view relative_prefix = "relative=";

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
  return looked.relative.value > required.limit ? looked.relative.at : first({&looked.lost});
}

void prove_into(Answer& a, const Question& q) {
  const auto number = q.arithmetic.number;
  const bool finite = q.requirement.kind == Requirement::Kind::finite;
  const auto usual_boxes = static_cast<std::uint64_t>(20'000 * share_of_cheap(q.subject));
  const auto proof = prove(q.subject, number, rounding_of(q.arithmetic),
                           finite ? finite_values(number) : finite_and_not_negative(number),
                           {.boxes = q.boxes.value_or(usual_boxes)});
  a.evidence = proof.evidence;
  a.boxes = proof.boxes;
  a.open_share = proof.open_share;
  a.range = proof.range;
  if (const auto& c = proof.counterexample) {
    a.counterexample = named(q.subject, looked_at(q.arithmetic), c->inputs);
    a.counterexample->value = c->value;  // of any GPU that of one which flushes
  }
  if (a.evidence != Evidence::open) return;
  a.unproved_because = proof.out_of_budget ? "out of boxes" : "inputs cannot be told apart further";
  if (!proof.open.empty()) a.unproved_because += "; " + proof.open[0].text(q.subject);
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
  return fmt::format("{}{:g}", relative_prefix, limit);
}
Requirement parse_requirement(std::string_view text) {
  if (text == "finite") return {};
  if (text == "nonnegative") return {Requirement::Kind::nonnegative, 0};
  if (!text.starts_with(relative_prefix))
    throw wrong_usage(
        fmt::format("required: found '{}', expected finite, nonnegative or relative=X", text));
  const double x = parse_number(text.substr(relative_prefix.size()), "required relative");
  if (!(x > 0) || std::isinf(x))
    throw wrong_usage(fmt::format("required relative: found {}, expected a number above 0", x));
  return {Requirement::Kind::relative, x};
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

Looked look(const Subject& s, const Arithmetic& a, double tolerance, std::uint64_t seed) {
  if (a.number == Number::half && can_be_exhausted(s))
    return exhaustive(s, {a.flush, a.contract}, tolerance);
  return search(s, a, {.tolerance = tolerance, .seed = seed});
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
  a.looked = look(q.subject, looked_at(q.arithmetic),
                  relative ? q.requirement.limit : usual_tolerance(number), q.seed);
  a.worst_at = text_of(q.subject, a.looked.relative.at);
  a.worst_hex = hex_of(q.subject, number, a.looked.relative.at);
  if (const auto at = broken_at(a.looked, q.requirement); !at.empty()) {
    a.evidence = a.looked.evidence;
    a.counterexample = named(q.subject, looked_at(q.arithmetic), at);
    return a;
  }
  if (a.looked.evidence == Evidence::exhaustive && !any_gpu)
    a.evidence = Evidence::exhaustive;
  else if (relative && number != Number::mixed)
    prove_relative_into(a, q);
  else if (number != Number::mixed)
    prove_into(a, q);
  a.holds = !a.counterexample && a.evidence != Evidence::open;
  return a;
}

}  // namespace gonio::stability
