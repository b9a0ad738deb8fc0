#include "stability/subject.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/letters.h"
#include "base/nearest_names.h"
#include "brdf/catalogue/foreign_terms.h"
#include "brdf/catalogue/registry.h"
#include "brdf/in_number/one_term.h"
#include "brdf/model/evaluate.h"
#include "brdf/model/presets.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio::stability {
namespace {

using Row = FrameAngles<double>;

/// Least width and least cosine that are looked at, whatever a fit or a scene may have.
constexpr double least_width = 1e-6, least_cosine = 1e-8;

std::vector<Given> given_to(std::size_t term) {
  const auto& entry = catalogue()[term];
  if (const auto* f = foreign_term(term); f && f->function->reads_frame)
    return {entry.role() == Role::ndf ? Given::frame : Given::turned};
  const bool half = reads_angle(term, &Row::noh) || reads_angle(term, &Row::voh);
  switch (entry.role()) {
    case Role::ndf:
      if (entry.anisotropic) return {Given::frame};
      if (reads_angle(term, &Row::sin2_theta_h)) return {Given::cross, Given::cosine};
      return {Given::cosine};
    case Role::fresnel:
      return {Given::facet};
    case Role::masking:
    case Role::diffuse:
      break;
  }
  return {entry.anisotropic ? Given::turned : half ? Given::directions : Given::cosines};
}

/// \param own  of a person's function, whose bounds hold where it has some
Input input_of(const Parameter& p, bool own) {
  Input i{std::string(p.name), p.legal, p.legal, {}};
  if (p.name.starts_with("alpha") && !(own && !std::isnan(p.start))) {
    // Two widths: their ratio is a surface's anisotropy, up to 1e4.
    i.legal = {least_width, p.legal.high};
    i.domain = {p.name == "alpha" ? least_width : 1e-4, 1};
  }
  if (p.name == "eta" || p.name == "gamma") i.edges = {1};
  return i;
}

/// A person's function by the value of its text: G, not G/(4 NoL NoV), whose division it does not make.
std::size_t as_written(std::size_t term) {
  const auto* f = foreign_term(term);
  if (!f) return term;
  const Role role = catalogue()[term].role();
  const std::string_view plain = role == Role::masking ? "v" : "nothing";
  if (f->function->includes == plain) return term;
  auto name = f->function->name;
  name.reading.includes = plain;
  return foreign_term_named(foreign::text_of(name), role) + f->channel;
}

std::vector<Input> angles_given(Given given) {
  const Range part{0, 1}, above{least_cosine, 1}, turn{-1, 1};
  const auto angle = [](const char* name, Range domain, Range legal) {
    return Input{name, domain, legal, {}};
  };
  const Input nol = angle("nol", above, part), nov = angle("nov", above, part);
  switch (given) {
    case Given::cross:
      return {angle("sin2_theta_h", part, part)};
    case Given::cosine:
      return {angle("noh", above, part)};
    case Given::frame:
      return {angle("sin2_theta_h", part, part), angle("cos_phi_h", part, turn)};
    case Given::facet:
      return {angle("voh", part, part)};
    case Given::cosines:
      return {nol, nov};
    case Given::directions:
      return {nol, nov, angle("cos_phi", turn, turn)};
    case Given::turned:
      break;
  }
  return {nol, angle("cos_phi_l", part, turn), nov, angle("cos_phi_v", turn, turn)};
}

Subject subject(std::string id, Given given, std::vector<Input> inputs) {
  Subject s{std::move(id), {}, {}, given, std::move(inputs), 0, {}};
  s.parameters = s.inputs.size();
  auto width =
      std::ranges::find_if(s.inputs, [](const auto& i) { return i.name.starts_with("alpha"); });
  const auto named = [&](std::initializer_list<std::string_view> parts) {
    return std::ranges::find_if(s.inputs, [&](const Input& i) {  // a file's own, whatever its case
      std::string name = i.name;
      std::ranges::transform(name, name.begin(), lower_case);
      return std::ranges::any_of(parts, [&](auto p) { return name.find(p) != name.npos; });
    });
  };
  if (width == s.inputs.end()) width = named({"rough", "alpha"});
  if (width == s.inputs.end()) {
    width = named({"smooth", "gloss", "shin"});
    s.narrows = width != s.inputs.end();
  }
  if (s.parameters > 0)
    s.decides = width == s.inputs.end() ? 0 : static_cast<std::size_t>(width - s.inputs.begin());
  for (auto& i : angles_given(given)) s.inputs.push_back(std::move(i));
  return s;
}

/// True where a function of a file reads directions: they are given as a shader has them.
bool reads_foreign_frame(const Model& m) {
  return std::ranges::any_of(terms_of(m), [](const TermUse* t) {
    const auto* f = foreign_term(t->term);
    return f && f->function->reads_frame;
  });
}

bool is_own(const Model& m, const Parameter* p) {
  return std::ranges::any_of(terms_of(m), [&](const TermUse* t) {
    const auto all = catalogue()[t->term].parameters;
    return foreign_term(t->term) &&
           std::ranges::any_of(all, [&](const Parameter& q) { return &q == p; });
  });
}

Subject subject_of_model(std::string_view spec) {
  Model m = compose(spec, 1);
  std::vector<Input> inputs;
  for (const auto& p : m.parameters) {
    if (&p == m.tangent()) continue;  // azimuths are given from there
    inputs.push_back(input_of(*p.about, is_own(m, p.about)));
    inputs.back().name = p.name;
  }
  const bool turned = m.anisotropic || reads_foreign_frame(m);
  auto s = subject(to_text(m.spec), turned ? Given::turned : Given::directions, std::move(inputs));
  s.model = std::move(m);
  return s;
}

}  // namespace

std::size_t angle_count(Given given) {
  return angles_given(given).size();
}

void expect_bounded(const Subject& s) {
  constexpr double unbounded = 1e29;
  for (const auto& i : s.inputs)
    if (i.domain.high > unbounded || i.domain.low < -unbounded)
      throw wrong_usage(fmt::format("{} of {} has no bounds: give them by --domain {}=LOW,HIGH",
                                    i.name, s.id, i.name));
}

std::vector<Subject> subjects_of_term(std::size_t named) {
  const std::size_t term = as_written(named);
  const auto& entry = catalogue()[named];
  std::vector<Subject> all;
  for (const auto given : given_to(term)) {
    std::vector<Input> inputs;
    for (const auto& p : entry.parameters) inputs.push_back(input_of(p, foreign_term(term)));
    all.push_back(subject(std::string(entry.id()), given, std::move(inputs)));
    all.back().term = term;
  }
  return all;
}

std::vector<Subject> subjects_of(std::string_view id_or_spec) {
  if (is_foreign(id_or_spec)) return subjects_of_term(find_term(id_or_spec));
  const bool is_id = std::ranges::any_of(
      names_of<Role>, [&](auto role) { return id_or_spec.starts_with(std::string(role) + "."); });
  if (is_id) return subjects_of_term(find_term(id_or_spec));
  const Preset* const preset = find_preset(id_or_spec);
  return {subject_of_model(preset ? preset->spec : id_or_spec)};
}

Subject subject_of(std::string_view id_or_spec, std::string_view form) {
  auto all = subjects_of(id_or_spec);
  const auto at = std::ranges::find(all, form, &Subject::form);
  if (at != all.end()) return std::move(*at);
  std::vector<std::string_view> forms;
  for (const auto& s : all) forms.push_back(s.form());
  refuse_name(form, forms, fmt::format("form of {}", id_or_spec));
}

void set_domain(Subject& s, std::string_view name, Range range) {
  const auto input = std::ranges::find(s.inputs, name, &Input::name);
  if (input == s.inputs.end()) {
    std::vector<std::string_view> names;
    for (const auto& i : s.inputs) names.push_back(i.name);
    throw wrong_usage(fmt::format("{}, given by {}, has no input '{}'; it has: {}", s.id, s.form(),
                                  name, fmt::join(names, ", ")));
  }
  const auto refuse = [&](std::string_view why) {
    throw wrong_usage(
        fmt::format("domain {}={},{}: {}; expected LOW,HIGH within [{}, {}], LOW at most HIGH",
                    name, range.low, range.high, why, input->legal.low, input->legal.high));
  };
  if (std::isnan(range.low) || std::isnan(range.high)) refuse("not a number");
  if (range.high < range.low) refuse("reversed");
  if (!input->legal.holds(range.low) || !input->legal.holds(range.high))
    refuse("outside its range");
  input->domain = range;
}

}  // namespace gonio::stability
