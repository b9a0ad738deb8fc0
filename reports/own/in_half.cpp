#include "reports/own/in_half.h"

#include "base/letters.h"
#include "brdf/catalogue/registry.h"
#include "reports/finding/words.h"
#include "reports/own/parameters.h"
#include "stability/answer.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio {
namespace {

std::string half_text(const stability::Answer& a, const stability::Subject& subject) {
  if (a.holds) return "finite for every input of its domain";
  std::string s = "not finite";
  if (a.counterexample) {
    std::vector<std::string> in;
    for (const auto& [n, v] : a.counterexample->inputs)
      in.push_back(fmt::format("{} {:.4g}", n, v));
    s += fmt::format(" at {}", fmt::join(in, ", "));
  } else {
    s = "open: a search found nothing, and there is no proof";
  }
  if (!a.safe_from || !a.safe_from->value || !subject.decides) return s;
  const auto& [name, range] = a.domain[*subject.decides];
  const double from = *a.safe_from->value;
  // From its lower end on says nothing, nor up to its upper end.
  const double part = (from - range.front()) / (range.back() - range.front());
  constexpr double little = 1e-3;
  if (subject.narrows ? part > 1 - little : part < little) return s;
  s += subject.narrows ? fmt::format("; up to {} {} it is finite", name, rounded_down(from, 4))
                       : fmt::format("; from {} {} on it is finite", name, rounded_up(from, 4));
  s += fmt::format(" ({})", name_of(a.safe_from->evidence));
  return s;
}

stability::Question question_of(stability::Subject subject, const Domain& domain, bool proves) {
  stability::Question q;
  q.subject = std::move(subject);
  for (const auto& [name, range] : domain)
    for (const auto& i : q.subject.inputs)
      if (same_letters(i.name, name) || same_letters(stem_of(i.name), name))
        stability::set_domain(q.subject, i.name, range);
  constexpr double unbounded = 1e29;  // looked at where the laws are
  for (auto& i : q.subject.inputs)
    if (i.domain.high > unbounded) i.domain = {0.05, 1};
  q.boxes = 2000;
  // All halves of two cosines are 240 million pairs; of a width they are far fewer.
  q.exhausts = q.subject.parameters > 0 || q.subject.inputs.size() == 1;
  q.proves = proves;
  q.measures_errors = false;
  return q;
}

/// Of masking that fails at grazing angles, as every V of Smith's does in half, the cosines from which it does not: ", …"; else "".
std::string from_cosines(std::size_t term, const Domain& domain) {
  for (const double least : {0.001, 0.01, 0.05}) {
    auto steep = domain;
    for (const char* cosine : {"nol", "nov"}) steep.emplace_back(cosine, Range{least, 1});
    const auto q = question_of(stability::subjects_of_term(term).back(), steep, true);
    if (stability::answer(q).holds)
      return fmt::format("; for NoL and NoV from {:g} it is finite", least);
  }
  return "";
}

}  // namespace

std::string in_half(stability::Subject subject, const Domain& domain, bool proves) {
  const auto q = question_of(std::move(subject), domain, proves);
  return half_text(stability::answer(q), q.subject);
}

std::string in_half(std::size_t term, const Domain& domain) {
  const bool is_masking = catalogue()[term].role() == Role::masking;
  const auto q = question_of(stability::subjects_of_term(term).back(), domain,
                             catalogue()[term].role() != Role::diffuse);
  const auto answer = stability::answer(q);
  return half_text(answer, q.subject) +
         (is_masking && answer.counterexample ? from_cosines(term, domain) : "");
}

}  // namespace gonio
