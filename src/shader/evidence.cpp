#include "shader/evidence.h"

#include <algorithm>
#include <set>

#include "brdf/catalogue/foreign_terms.h"
#include "brdf/catalogue/registry.h"
#include "stability/answer.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio::shader {
namespace {

using namespace stability;

/// The hard domain narrowed to what a shader meets.
Subject subject_of(const UsedTerm& used) {
  const auto& entry = catalogue()[used.term];
  Subject s = subjects_of_term(used.term).front();  // of a distribution by |n × h|²
  const auto narrow = [&](Input& input, double low, double high) {
    set_domain(s, input.name,
               {std::clamp(low, input.domain.low, input.domain.high),
                std::clamp(high, input.domain.low, input.domain.high)});
  };
  for (std::size_t k = 0; k < s.inputs.size(); ++k) {
    Input& input = s.inputs[k];
    if (k >= s.parameters) {
      if (input.name == "nol" || input.name == "nov" || input.name == "voh" || input.name == "noh")
        narrow(input, least_cosine, 1);
      continue;
    }
    if (used.known[k])
      narrow(input, *used.known[k], *used.known[k]);
    else
      narrow(input, entry.parameters[k].fit.low, entry.parameters[k].fit.high);
  }
  return s;
}

/// The same of a whole model: parameters that are folded in lie where they are, of a colour between its channels.
Subject subject_of(const TracedFormula& f) {
  Subject s = subjects_of(f.id).front();
  const auto narrow = [&](const Input& input, double low, double high) {
    set_domain(s, input.name,
               {std::clamp(low, input.domain.low, input.domain.high),
                std::clamp(high, input.domain.low, input.domain.high)});
  };
  for (std::size_t k = 0; k < s.inputs.size(); ++k) {
    const Input input = s.inputs[k];
    if (input.name == "nol" || input.name == "nov") narrow(input, least_cosine, 1);
    if (k >= s.parameters) continue;
    const auto known =
        std::ranges::find(f.known, input.name, &std::pair<std::string, std::vector<double>>::first);
    if (known != f.known.end()) {
      const auto [low, high] = std::ranges::minmax(known->second);
      narrow(input, low, high);
    } else if (const auto* p = s.model->find(input.name)) {
      narrow(input, p->about->fit.low, p->about->fit.high);
    }
  }
  return s;
}

std::string sentence(const Subject& s, const Answer& a) {
  std::vector<std::string> domain;
  for (const auto& [name, ends] : a.domain)
    if (ends[0] == ends[1])
      domain.push_back(fmt::format("{} = {:g}", name, ends[0]));
    else
      domain.push_back(fmt::format("{} in [{:g}, {:g}]", name, ends[0], ends[1]));
  std::string finite = "whether it is always finite stays open";
  if (a.holds)
    finite = fmt::format("finite ({})", name_of(a.evidence));
  else if (a.counterexample) {
    std::vector<std::string> at;
    for (const auto& [name, value] : a.counterexample->inputs)
      at.push_back(fmt::format("{} = {:.9g}", name, value));
    finite = fmt::format("not finite at {}", fmt::join(at, ", "));
  }
  std::string error;
  if (a.proved_rel) error = fmt::format("; relative error at most {:.2g} (proved)", *a.proved_rel);
  if (!a.worst_at.empty())
    error += fmt::format("; largest relative error found {:.2g} ({}), at {}",
                         a.looked.relative.value, name_of(a.looked.evidence), a.worst_at);
  if (const auto& gone = a.looked.vanished; gone.count > 0)
    error += fmt::format("; 0 where it should not be, as at {}", text_of(s, gone.first));
  return fmt::format("{} in {}: {}{}.  For {}.", a.id, text_of(a.arithmetic), finite, error,
                     fmt::join(domain, ", "));
}

}  // namespace

std::vector<std::string> evidence_of(const TracedFormula& f,
                                     Language language,
                                     const std::function<void(std::string_view term)>& progress) {
  std::vector<std::string> sentences;
  for (const auto& used : f.terms) {
    progress(catalogue()[used.term].id());
    Question q;
    q.subject = subject_of(used);
    q.arithmetic = {f.precision == Precision::half ? Number::half : Number::float_, false,
                    language == Language::wgsl, true};
    sentences.push_back(sentence(q.subject, answer(q)));
  }
  if (f.terms.empty())
    sentences.emplace_back(
        "Its roundings were not measured: gonio stability looks at terms and models.");
  if (f.is_model && !is_foreign(f.id)) {  // a file's function is one term, looked at above
    progress(f.id);
    Question q;
    q.subject = subject_of(f);
    q.arithmetic = {f.precision == Precision::half ? Number::half : Number::float_, false,
                    language == Language::wgsl, true};
    q.boxes = 100;  // of so many inputs nothing is proved in seconds
    sentences.push_back("The whole, " + sentence(q.subject, answer(q)));
  }
  // A second lobe's terms may be the first's over again.
  std::set<std::string> seen;
  std::erase_if(sentences, [&](const std::string& s) { return !seen.insert(s).second; });
  return sentences;
}

}  // namespace gonio::shader
