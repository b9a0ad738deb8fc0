#include "reports/own/audit_file.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "base/error.h"
#include "base/letters.h"
#include "brdf/catalogue/foreign_terms.h"
#include "brdf/in_number/number.h"
#include "foreign/callers.h"
#include "integrate/albedo/normalisation.h"
#include "reports/measure/samples.h"
#include "reports/own/in_half.h"
#include "reports/own/pairing.h"
#include "reports/own/parameters.h"
#include "reports/own/parts.h"
#include "reports/own/slip_forms.h"

#include <fmt/format.h>

namespace gonio {
namespace {

bool is_fresnel_name(const std::string& name) {
  std::string n = name;
  std::ranges::transform(n, n.begin(), lower_case);
  return n.starts_with("f_") || n.find("fresnel") != n.npos || n.find("schlick") != n.npos;
}

void add(std::vector<std::string>& all, const std::vector<std::string>& more) {
  for (const auto& s : more)
    if (std::ranges::find(all, s) == all.end()) all.push_back(s);
}

/// A smooth highlight that returns all light has the factor that it should have, whatever a form of ours returns, as those of mobile
/// shaders do.
bool is_whole(const std::optional<FoundAt>& highlight) {
  constexpr double most_off = 0.05;
  return highlight && std::abs(highlight->value - 1) < most_off;
}

/// \return  false where it is ours only without the π that was guessed
bool audit_whole(FunctionAudit& a, const std::string& token, std::size_t term) {
  const auto parameters = known_parameters(term);
  const auto& f = *a.of.function;
  const bool guessed_pi = f.guessed && f.includes.find("pi") != std::string::npos;
  a.model = nearest_model(term, a.no_model);
  if (a.model && guessed_pi && is_without_pi(*a.model)) return false;
  if (a.model) {
    const auto& width = parameters[a.model->width];
    a.width_of_model = width.name;
    add(a.to_check, to_check(*a.model, width));
  }
  if (!a.model) a.of_the_kind = model_of_the_kind(term);
  const bool of_sheen = a.model ? is_sheen(*a.model) : a.of_the_kind->is_sheen;
  const OwnAlbedo albedo(token, parameters, f.programs.size(), f.anisotropic);
  const auto parts = audit_parts(term, albedo, a.model, of_sheen, guessed_pi);
  a.highlight = parts.highlight;
  if (a.model) {
    auto of_model = *a.model;
    if (is_whole(a.highlight)) of_model.factor = 1;
    add(a.slips, likely_slips(of_model, parameters[a.model->width], guessed_pi));
  }
  add(a.slips, parts.slips);
  add(a.to_check, parts.to_check);
  a.energy = energy_of(albedo);
  return true;
}

/// A distribution without 1/π is right where its caller divides: it is asked of one whose name says so, and of one that functions
/// of its file call beside π, unless such a caller lacks π itself.
void ask_of_pi(FunctionAudit& a, const std::vector<FunctionAudit>& all) {
  constexpr const char* lacks = "1/π is missing";
  const auto at = std::ranges::find_if(a.slips, [&](const auto& s) { return s.ends_with(lacks); });
  if (a.of.function->stands != foreign::Stands::distribution || at == a.slips.end()) return;
  const auto& name = a.of.function->name;
  auto callers = foreign::callers_with_pi(name.file, name.function);
  std::erase_if(callers, [&](const std::string& c) {
    return std::ranges::any_of(all, [&](const FunctionAudit& b) {
      return b.of.entry.function == c && std::ranges::any_of(b.slips, [](const std::string& s) {
               return s.find("π times too large") != s.npos;
             });
    });
  });
  if (callers.empty() && plain_name(name.function).find("nopi") == std::string::npos) return;
  a.to_check.push_back(fmt::format(
      "{}: right where its caller divides by π{}; otherwise highlights are π times too bright", *at,
      callers.empty() ? "" : ", as " + callers[0] + " may"));
  a.slips.erase(at);
}

/// Names the factor that a distribution of no form of ours lacks, where it is the same at two widths; otherwise "".
std::string slip_of_norm(std::size_t term, double norm) {
  constexpr double pi = std::numbers::pi, same = 2e-3;
  std::vector<double> usual;
  for (const auto& p : known_parameters(term)) usual.push_back(usual_of(p));
  const double other = normalisation(term, usual).value;
  for (const auto& [factor, lacks] :
       {std::pair{pi, "1/π"}, {2 * pi, "1/(2π)"}, {4 * pi, "1/(4π)"}, {2.0, "½"}})
    if (std::abs(norm / factor - 1) < same && std::abs(other / factor - 1) < same)
      return fmt::format("its norm ∫ D NoH dω is {:.4g}, expected 1: {} is missing", norm, lacks);
  return "";
}

/// Where a distribution is normalised over directions, at two widths and more: a sentence; otherwise "".
std::string slip_of_directions(std::size_t term) {
  const auto known = known_parameters(term);
  const auto width = width_of(known);
  if (!width || catalogue()[term].anisotropic) return "";
  constexpr std::size_t places = 5, steps = 4000, enough = 2;
  constexpr double pi = std::numbers::pi, same = 2e-3, other = 5e-3;
  std::vector<auditing::Row> rows;
  std::vector<double> weights;
  for (std::size_t i = 0; i < steps; ++i) {
    const double t = (static_cast<double>(i) + 0.5) / steps, theta = pi / 2 * t * t * t;
    rows.push_back(auditing::row(theta, 0, theta, 0));
    weights.push_back(2 * pi * std::sin(theta) * pi / 2 * 3 * t * t / steps);
  }
  std::size_t over_hemisphere = 0, over_sphere = 0;
  for (const double w : values_between(known[*width], places)) {
    std::vector<double> p;
    for (const auto& q : known) p.push_back(usual_of(q));
    p[*width] = w;
    const auto d = values_in(Number::double_, term, p, rows);
    double sum = 0, projected = 0;
    for (std::size_t i = 0; i < steps; ++i)
      sum += d[i] * weights[i], projected += d[i] * weights[i] * rows[i].noh;
    if (!(std::abs(projected - 1) > other)) continue;
    over_hemisphere += std::abs(sum - 1) < same;
    over_sphere += std::abs(sum - 0.5) < same;
  }
  if (over_hemisphere < enough && over_sphere < enough) return "";
  return fmt::format(
      "it is normalised over the {}, ∫ D dω = 1: expected ∫ D NoH dω = 1, over the projected "
      "hemisphere",
      over_hemisphere < enough ? "whole sphere" : "hemisphere");
}

FunctionAudit audit_function(const FileFunction& of, bool looks_in_half) {
  FunctionAudit a{of};
  const auto& f = *of.function;
  if (!is_audited(f)) return a;
  const auto token = foreign::text_of(f.name);
  const std::size_t term = foreign_term_named(token);
  const auto hold = hold_foreign(term);
  const Role role = catalogue()[term].role();
  a.laws = laws_of(f, term);
  a.operations_in_one = operations_in_one(term);
  for (const auto& name : a.laws.without_effect) {
    const auto known = known_parameters(term);
    const auto width = width_of(known);
    const bool is_slip =
        name.starts_with("No") || name == "VoH" || (width && known[*width].name == name);
    (is_slip ? a.slips : a.to_check)
        .push_back(
            name + " changes nothing" +
            (is_slip ? ": it is not read, or a clamp holds it, as min in the place of max" : ""));
  }
  if (a.laws.fails_behind)
    a.to_check.emplace_back(
        "a light behind the horizon has no value: right where the caller leaves such lights out");
  if (role == Role::ndf && is_fresnel_name(f.name.function)) {
    a.laws.normalisation.reset();
    a.slips.emplace_back(
        "its name is that of a Fresnel term, whose cosine is VoH, and it takes NoH");
  }
  if (role == Role::diffuse && !audit_whole(a, token, term)) {
    auto name = f.name;
    name.reading.includes = f.includes == "pi" ? "nothing" : "cosine";
    FileFunction again = of;
    again.function = foreign::read_function(name);
    return audit_function(again, looks_in_half);
  }
  // Light and view that graze from opposite sides leave no half vector: most shaders exclude it.
  constexpr Range cosines{0.05, 1};
  const auto known = known_parameters(term);
  Domain domain;
  for (const auto& p : known)
    if (std::isnan(p.start) && (is_colour(p) || is_metallic(p) || is_eta(p)))
      domain.emplace_back(p.name, Range{low_of(p), high_of(p)});
  if (role == Role::diffuse) {
    domain.emplace_back("nol", cosines);
    domain.emplace_back("nov", cosines);
  }
  if (looks_in_half)
    a.half = (role == Role::diffuse ? "for NoL and NoV from 0.05: " : "") + in_half(term, domain);
  const bool is_looked_up = role != Role::ndf || a.laws.normalisation;
  if (!a.model && is_looked_up && (role != Role::diffuse || !f.anisotropic)) {
    constexpr double far_off = 0.5;  // no form resembles it
    a.nearest = nearest_form(term);
    if (a.nearest && a.nearest->difference > (a.nearest->of_one ? same_within : far_off))
      a.nearest.reset();
    if (a.nearest) {
      add(a.slips, likely_slips(term, *a.nearest));
      add(a.to_check, to_check(*a.nearest));
      a.no_model.clear();
    }
    if (!a.nearest || !is_same(*a.nearest))
      if (const auto slip = slip_form(term); !slip.empty())
        (slip == f0_after ? a.to_check : a.slips).push_back(slip);
    if (role == Role::ndf)
      if (const auto slip = slip_of_directions(term); !slip.empty()) a.slips.push_back(slip);
    if (role == Role::ndf && a.slips.empty() && (!a.nearest || !is_same(*a.nearest)))
      if (const auto slip = slip_of_norm(term, a.laws.normalisation->value); !slip.empty())
        a.slips.push_back(slip);
  }
  if (a.of_the_kind) {
    if (a.nearest && is_same(*a.nearest))
      a.of_the_kind.reset();
    else
      a.nearest.reset();
  }
  for (const auto& p : f.parameters) {
    const auto role_of = std::ranges::find_if(
        known, [&](const Parameter& q) { return stem_of(q.name) == stem_of(p.name); });
    if (p.bounded || role_of == known.end()) continue;
    const Range range{low_of(*role_of), high_of(*role_of)};
    a.not_looked_at.push_back(fmt::format("{} beyond {:.4g} to {:.4g}: no bounds were given",
                                          p.name, range.low, range.high));
  }
  return a;
}

}  // namespace

bool is_audited(const foreign::Function& f) {
  return f.stands != foreign::Stands::lobe || takes_light(f);
}

std::vector<FunctionAudit> audit_file(const std::string& name,
                                      const std::function<void(const std::string&)>& begins,
                                      bool looks_in_half) {
  std::vector<FunctionAudit> all;
  for (auto& f : file_functions(name).functions) {
    const bool is_named = !foreign::parse_name(name).function.empty();
    if (f.function && begins) begins(f.entry.function);
    if (f.function) try {
        all.push_back(audit_function(f, looks_in_half));
        continue;
      } catch (const Error& e) {
        if (is_named) throw;
        f.function.reset();
        f.entry.refused = e.what();
      }
    all.emplace_back();
    all.back().of = std::move(f);
  }
  for (auto& a : all)
    if (a.of.function) ask_of_pi(a, all);
  return all;
}

}  // namespace gonio
