#include "reports/own/audit_file.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/json/describe.h"
#include "base/letters.h"
#include "brdf/cost/model_operations.h"
#include "brdf/in_number/number.h"
#include "brdf/model/evaluate.h"
#include "brdf/model/own_files.h"
#include "geometry/direction.h"
#include "integrate/albedo/directional_albedo.h"
#include "integrate/albedo/normalisation.h"
#include "reports/finding/words.h"
#include "reports/measure/samples.h"
#include "reports/own/parameters.h"
#include "reports/own/slip_forms.h"
#include "stability/answer.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

using auditing::Row;
using auditing::Values;

constexpr double steepest = 0.035;  ///< cosine of 88°, the steepest view whose albedo is looked at

void take_largest(std::optional<FoundAt>& w, double v, const std::string& at) {
  if (!w || v > w->value || std::isnan(v)) w = FoundAt{v, at};
}
void take_smallest(std::optional<FoundAt>& w, double v, const std::string& at) {
  if (!w || v < w->value || std::isnan(w->value)) w = FoundAt{v, at};
}

/// Five widths, both ends among them.
std::vector<double> widths_of(const Parameter& p) {
  auto at = values_between(p, 5);
  at.front() = low_of(p);
  at.back() = high_of(p);
  return at;
}

using Settings = std::vector<std::vector<double>>;

/// Values of parameters that laws are looked at with: five widths with the ends and the default of some others, colours at their
/// upper ends; and each parameter at its ends with the others at their defaults.
Settings looked_at(std::span<const Parameter> parameters) {
  const auto width = width_of(parameters);
  const auto is_width = [&](const Parameter& p) { return width && &p == &parameters[*width]; };
  std::size_t rows = 1;
  constexpr std::size_t many = 60;
  auto all = auditing::combinations(parameters, [&](const Parameter& p) {
    const auto at = is_width(p)    ? widths_of(p)
                    : is_colour(p) ? std::vector{high_of(p)}
                    : rows > many || std::isnan(p.start)
                        ? std::vector{usual_of(p)}
                        : std::vector{p.legal.low, p.start, p.legal.high};
    rows *= at.size();
    return at;
  });
  std::vector<double> usual;
  for (const auto& p : parameters) usual.push_back(usual_of(p));
  for (const double w :
       width ? std::vector{low_of(parameters[*width]), usual[*width], high_of(parameters[*width])}
             : std::vector{0.0}) {
    auto at = usual;
    if (width) at[*width] = w;
    all.push_back(at);
    for (std::size_t k = 0; k < parameters.size(); ++k)
      for (const double v : {low_of(parameters[k]), high_of(parameters[k])}) {
        if (is_width(parameters[k])) continue;
        auto one = at;
        one[k] = v;
        all.push_back(one);
      }
  }
  return all;
}

/// Values of parameters with which albedos are integrated: of all colours at their lower bounds, of each alone at its upper one, and
/// of all of them there.
struct Furnace {
  std::vector<double> dark, together;
  std::vector<std::vector<double>> alone;
};
std::vector<Furnace> furnaces(std::span<const Parameter> parameters) {
  const auto width = width_of(parameters);
  std::vector<std::string_view> colours;
  std::vector<double> usual;
  for (const auto& p : parameters) {
    usual.push_back(usual_of(p));
    if (is_colour(p) && (colours.empty() || colours.back() != stem_of(p.name)))
      colours.push_back(stem_of(p.name));
  }
  const auto with_colours = [&](std::vector<double> at, const auto& is_high) {
    for (std::size_t k = 0; k < parameters.size(); ++k)
      if (const auto& p = parameters[k]; is_colour(p))
        at[k] = is_high(stem_of(p.name)) ? high_of(p) : low_of(p);
    return at;
  };
  const auto every = [](std::string_view) { return true; };
  const auto none = [](std::string_view) { return false; };
  std::vector<Furnace> all;
  for (const double w : width ? widths_of(parameters[*width]) : std::vector{0.0}) {
    auto at = usual;
    if (width) at[*width] = w;
    all.push_back({with_colours(at, none), with_colours(at, every), {}});
    for (const auto c : colours)
      all.back().alone.push_back(with_colours(at, [&](std::string_view n) { return n == c; }));
  }
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    if (is_colour(parameters[k]) || (width && k == *width)) continue;
    for (const double v : {low_of(parameters[k]), high_of(parameters[k])}) {
      auto at = usual;
      at[k] = v;
      all.push_back({{}, with_colours(at, every), {}});
      if (colours.size() == 1)
        all.back() = {with_colours(at, none), all.back().together, {all.back().together}};
    }
  }
  return all;
}

std::string lowered(std::string s) {
  std::ranges::transform(s, s.begin(), lower_case);
  return s;
}

std::string half_text(const stability::Answer& a, std::optional<std::size_t> decides) {
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
  if (!a.safe_from || !a.safe_from->value || !decides) return s;
  const auto& [name, range] = a.domain[*decides];
  const double from = *a.safe_from->value;
  // From its lower end on says nothing.
  if (from - range.front() < 1e-3 * (range.back() - range.front())) return s;
  s += fmt::format("; from {} {} on it is finite ({})", name, rounded_up(from, 4),
                   name_of(a.safe_from->evidence));
  return s;
}

/// \param proves  false of a whole model, about which a proof takes long and reaches only its largest widths
std::string in_half(stability::Subject subject,
                    const std::vector<std::pair<std::string, Range>>& domain,
                    bool proves = true) {
  stability::Question q;
  q.subject = std::move(subject);
  for (const auto& [name, range] : domain)
    for (const auto& i : q.subject.inputs)
      if (lowered(i.name) == lowered(name)) stability::set_domain(q.subject, i.name, range);
  constexpr double unbounded = 1e29;  // looked at where the laws are
  for (auto& i : q.subject.inputs)
    if (i.domain.high > unbounded) i.domain = {0.05, 1};
  q.boxes = 2000;
  q.proves = proves;
  return half_text(stability::answer(q), q.subject.decides);
}
std::string in_half(std::size_t term, const std::vector<std::pair<std::string, Range>>& domain) {
  // A distribution by its cosine NoH, as shaders have it.
  return in_half(stability::subjects_of_term(term).back(), domain,
                 catalogue()[term].role() != Role::diffuse);
}

/// Takes the albedo of the highlight alone, F0 = 1, along the normal: there masking takes nothing from a smooth one, and all light
/// returns.  Says what is lost or gained.
void take_highlight(FunctionAudit& a, std::span<const Parameter> parameters, const auto& albedo) {
  const auto width = width_of(parameters);
  const auto colours = part_colours(parameters);
  if (!width || !colours || std::isnan(parameters[*width].start)) return;
  const auto& w = parameters[*width];
  const std::string name(w.name);
  const double power = is_rough(name) ? 2 : powers_of(name)[0];
  const double narrow = narrows(power) ? w.legal.high : w.legal.low;
  constexpr double smooth = 0.1;  // of alpha: GGX still returns 0.98 there
  if (!(alpha_of(narrow, power) <= smooth)) return;
  const auto at = [&](double v, Others others) {
    auto p = with_highlight(parameters, *colours, high_of(parameters[colours->f0[0]]), others);
    p[*width] = v;
    return albedo(p);
  };
  // With all else at its lower end there may be no light at all.
  const Others others = at(w.start, Others::low) > 0 ? Others::low : Others::usual;
  const double least = 1e-3 * (w.legal.high - w.legal.low);
  const double narrowest = narrows(power) ? narrow : std::max(narrow, least);
  a.highlight = FoundAt{at(narrowest, others), fmt::format("{} {:.4g}", name, narrowest)};
  if (a.model && (a.model->bite || a.model->factor != 1)) return;  // named by its form
  constexpr double rounded = 0.02;
  for (const double factor : {std::numbers::pi, 4.0, 4 * std::numbers::pi})
    if (std::abs(a.highlight->value / factor - 1) < rounded)
      a.slips.push_back("its highlight is " + factor_text(factor));
  if (const auto bite = bite_of(w, power, [&](double v) { return at(v, others); })) {
    const auto text = fmt::format(
        "its smooth highlight loses light: {:.2g} of it returns along the normal at "
        "{}, and 0.9 only {} {:.3g}; a guard or a clamp cuts its peak{}",
        a.highlight->value, a.highlight->at, narrows(power) ? "to" : "from", bite->from,
        bite->is_little ? "; right where no material is so smooth" : "");
    (bite->is_little ? a.to_check : a.slips).push_back(text);
  }
}

void energy_of_lobe(FunctionAudit& a,
                    const std::string& token,
                    std::span<const Parameter> parameters) {
  constexpr std::array mu{steepest, 0.1, 0.5, 1.0};
  constexpr Goal goal{1e-3, 200'000};
  if (std::ranges::none_of(parameters, [](const Parameter& p) { return std::isnan(p.start); })) {
    const auto usual = directional_albedo(bind_model(token, {}), std::array{0.5}, 0, goal)[0];
    a.usual = FoundAt{*std::ranges::max_element(usual.value), "defaults, NoV 0.5"};
  }
  const auto albedos = [&](const std::vector<double>& values) {
    std::vector<Setting> set;
    for (std::size_t k = 0; k < parameters.size(); ++k)
      set.push_back({std::string(parameters[k].name), {values[k]}});
    std::vector<double> v;
    for (const auto& at : directional_albedo(bind_model(token, set, 1), mu, 0, goal))
      v.push_back(at.value[0]);
    return v;
  };
  const auto place = [&](const std::vector<double>& values, std::size_t i) {
    return auditing::joined(auditing::text(parameters, values), fmt::format("NoV {}", mu[i]));
  };
  take_highlight(a, parameters,
                 [&](const std::vector<double>& values) { return albedos(values).back(); });
  for (const auto& f : furnaces(parameters)) {
    const auto together = albedos(f.together);
    for (std::size_t i = 0; i < mu.size(); ++i) {
      take_largest(a.together, together[i], place(f.together, i));
      take_smallest(a.darkest, together[i], place(f.together, i));
      if (f.alone.empty() && f.dark.size() == parameters.size())  // there are no colours
        take_largest(a.albedo, together[i], place(f.together, i));
    }
    if (f.alone.empty()) continue;
    const auto dark = albedos(f.dark);
    for (const auto& colour : f.alone) {
      const auto whole = f.alone.size() == 1 ? together : albedos(colour);
      std::vector<double> own;
      for (std::size_t i = 0; i < mu.size(); ++i) own.push_back(whole[i] - dark[i]);
      // What a diffuse part adds is the same whatever the view; then each part stands for itself.
      const auto [least, most] = std::ranges::minmax(own);
      constexpr double same = 0.01;
      const bool adds = most > same && most - least < same;
      for (std::size_t i = 0; i < mu.size(); ++i) {
        take_largest(a.together, whole[i], place(colour, i));
        take_largest(a.albedo, adds ? own[i] : whole[i], place(colour, i));
        take_largest(a.albedo, dark[i], place(f.dark, i));
      }
    }
  }
  if (a.together && a.albedo && !(a.together->value > a.albedo->value)) a.together.reset();
}

/// Directions nearer to the horizon than those that laws are looked at with: there many shaders divide by 0 or take roots of less.
std::vector<Row> grazing() {
  std::vector<Row> rows;
  for (const double nol : {0.001, 0.01, 0.03, 0.5, 1.0})
    for (const double nov : {0.001, 0.01, 0.03, 0.5, 1.0})
      for (const double phi : {0.0, 90.0, 180.0})
        rows.push_back(auditing::row(std::acos(nol), 0, std::acos(nov), phi * degree));
  return rows;
}

/// False of a function that takes no light: an argument of another name may be a cosine.
bool is_audited(const foreign::Function& f) {
  return f.stands != foreign::Stands::lobe || takes_light(f);
}

bool is_fresnel_name(const std::string& name) {
  const auto n = lowered(name);
  return n.starts_with("f_") || n.find("fresnel") != n.npos || n.find("schlick") != n.npos;
}

bool takes_both_cosines(const foreign::Function& f) {
  const auto takes = [&](std::string_view scalar, std::string_view vector) {
    return std::ranges::any_of(f.arguments, [&](const foreign::Argument& a) {
      return a.stands_for == scalar || a.stands_for == vector;
    });
  };
  return takes("nol", "L") && takes("nov", "V");
}

FunctionAudit audit_function(FileFunction f) {
  FunctionAudit a;
  if (!is_audited(*f.function)) {
    a.of = std::move(f);
    return a;
  }
  const auto token = foreign::text_of(f.function->name);
  const std::size_t term = foreign_term_named(token);
  const auto& entry = catalogue()[term];
  const auto parameters = entry.parameters;
  const auto settings = looked_at(parameters);
  const Role role = entry.role();
  const auto& rows = auditing::rows_of(role);
  std::vector<Row> other;
  for (const auto& r : rows) other.push_back(auditing::exchanged(r));
  const auto horizon = role == Role::ndf || role == Role::fresnel ? std::vector<Row>{} : grazing();
  constexpr double below_by_rounding = 1e-12;  // as (1 − VoH)⁵ is where VoH rounds to more than 1
  const auto count_finite = [&](const std::vector<double>& v, const Values& p,
                                const std::vector<Row>& at) {
    for (std::size_t i = 0; i < v.size(); ++i) {
      if (std::isfinite(v[i])) continue;
      if (a.not_finite++ == 0)
        a.not_finite_at = auditing::joined(auditing::text(parameters, p), auditing::text(at[i]));
    }
  };
  for (const auto& p : settings)
    for (std::size_t c = 0; c < f.function->programs.size(); ++c) {
      count_finite(values_in(Number::double_, term + c, p, horizon), p, horizon);
      const auto v = values_in(Number::double_, term + c, p, rows);
      const auto w = values_in(Number::double_, term + c, p, other);
      count_finite(v, p, rows);
      for (std::size_t i = 0; i < v.size(); ++i) {
        if (!std::isfinite(v[i])) continue;
        const auto at = [&] {
          return auditing::joined(auditing::text(parameters, p), auditing::text(rows[i]));
        };
        if (v[i] < -below_by_rounding) take_smallest(a.lowest, v[i], at());
        const double size = std::max(std::abs(v[i]), std::abs(w[i]));
        const double off = std::abs(v[i] - w[i]);
        if ((role == Role::diffuse || role == Role::masking) && size > 0 &&
            (!a.reciprocity || off / size > a.reciprocity->value))
          a.reciprocity = FoundAt{off / size, at()};
      }
    }
  if (role == Role::diffuse && a.not_finite == 0 && takes_both_cosines(*f.function)) {
    const Row behind = auditing::row(100 * degree, 0, 30 * degree, 90 * degree);
    const auto v = values_in(Number::double_, term, settings[0], std::span(&behind, 1));
    if (!std::isfinite(v[0]))
      a.to_check.emplace_back(
          "a light behind the horizon has no value: right where the caller leaves such lights out");
  }
  // Masking by one cosine is half of a product, which alone keeps the law.
  if (role == Role::masking && !takes_both_cosines(*f.function)) a.reciprocity.reset();
  if (role == Role::ndf)
    for (const auto& p : settings)
      if (const double v = normalisation(term, p).value;
          !a.normalisation || std::abs(v - 1) > std::abs(a.normalisation->value - 1))
        a.normalisation = FoundAt{v, auditing::text(parameters, p)};
  if (role == Role::ndf && is_fresnel_name(f.function->name.function)) {
    a.normalisation.reset();
    a.slips.emplace_back(
        "its name is that of a Fresnel term, whose cosine is VoH, and it takes NoH");
  }
  if (role == Role::diffuse) {
    a.model = nearest_model(term, a.no_model);
    if (a.model) {
      a.slips = likely_slips(*a.model);
      std::ranges::copy(to_check(*a.model), std::back_inserter(a.to_check));
    }
    energy_of_lobe(a, token, parameters);
  }
  // Light and view that graze from opposite sides leave no half vector: most shaders exclude it.
  constexpr Range cosines{0.05, 1};
  a.half = role == Role::diffuse
               ? "for NoL and NoV from 0.05: " + in_half(term, {{"nol", cosines}, {"nov", cosines}})
               : in_half(term, {});
  const bool is_looked_up = role != Role::ndf || a.normalisation;
  if (!a.model && is_looked_up && (role != Role::diffuse || !f.function->reads_frame)) {
    constexpr double far_off = 0.5;  // no form resembles it
    a.nearest = nearest_form(term);
    if (a.nearest && a.nearest->difference > far_off) a.nearest.reset();
    if (a.nearest) {
      std::ranges::copy(likely_slips(term, *a.nearest), std::back_inserter(a.slips));
      std::ranges::copy(to_check(*a.nearest), std::back_inserter(a.to_check));
      a.no_model.clear();
    }
    if (!a.nearest || !is_same(*a.nearest))
      if (const auto slip = slip_form(term); !slip.empty()) a.slips.push_back(slip);
  }
  for (const auto& p : f.function->parameters)
    if (!p.bounded)
      a.not_looked_at.push_back(fmt::format("{} beyond 0.05 to 1: no bounds were given", p.name));
  a.of = std::move(f);
  return a;
}

std::string width_text(const std::string& width, double power) {
  return width.empty() ? "" : ", alpha = " + alpha_text(width, power);
}

std::string nearest_text(const FunctionAudit& a) {
  const auto& n = *a.nearest;
  const auto id = catalogue()[n.term].id();
  const std::string map = width_text(n.width, n.power);
  if (!is_same(n)) return fmt::format("{}{}: up to {} apart", id, map, rounded_up(n.difference));
  return fmt::format("{}{}", id, map);
}

}  // namespace

std::vector<FunctionAudit> audit_file(const std::string& name) {
  std::vector<FunctionAudit> all;
  for (auto& f : file_functions(name).functions) {
    const bool is_named = !foreign::parse_name(name).function.empty();
    if (f.function) try {
        all.push_back(audit_function(f));
        continue;
      } catch (const Error& e) {
        if (is_named) throw;
        f.function.reset();
        f.entry.refused = e.what();
      }
    all.emplace_back();
    all.back().of = std::move(f);
  }
  return all;
}

std::string to_json(const std::vector<FunctionAudit>& all) {
  Json rows = Json::array();
  const auto found = [](const std::optional<FoundAt>& w) {
    return w ? Json{{"value", w->value}, {"at", w->at}} : Json();
  };
  for (const auto& a : all) {
    Json j{{"function", a.of.entry.function}, {"line", a.of.entry.line}};
    if (!a.of.function) {
      j["refused"] = a.of.entry.refused;
      rows.push_back(j);
      continue;
    }
    j["stands_for"] = name_of(a.of.function->stands);
    j["includes"] = a.of.function->includes;
    j["guessed"] = a.of.function->guessed;
    j["unclear"] = a.of.function->unclear;
    j["operations"] = a.of.operations.total();
    j["normalisation"] = found(a.normalisation);
    j["reciprocity"] = found(a.reciprocity);
    j["albedo"] = found(a.albedo);
    j["together"] = found(a.together);
    j["usual"] = found(a.usual);
    j["darkest"] = found(a.darkest);
    j["highlight"] = found(a.highlight);
    j["lowest"] = found(a.lowest);
    j["not_finite"] = a.not_finite;
    j["not_finite_at"] = a.not_finite ? Json(a.not_finite_at) : Json();
    j["half"] = a.half;
    j["nearest"] = Json();
    if (a.nearest)
      j["nearest"] = {{"id", catalogue()[a.nearest->term].id()},
                      {"same", is_same(*a.nearest)},
                      {"width", a.nearest->width},
                      {"power", a.nearest->power},
                      {"factor", a.nearest->factor},
                      {"difference", a.nearest->difference},
                      {"operations", operations_of(a.nearest->term).sample.total()}};
    j["model"] = Json();
    if (a.model)
      j["model"] = {{"spec", a.model->spec},
                    {"width", a.model->width},
                    {"power", a.model->power},
                    {"masking_power", a.model->masking_power},
                    {"factor", a.model->factor},
                    {"operations", a.model->operations},
                    {"lacks_diffuse", a.model->lacks_diffuse},
                    {"diffuse_factor", a.model->diffuse_factor}};
    j["no_model"] = a.no_model.empty() ? Json() : Json(a.no_model);
    j["slips"] = a.slips;
    j["to_check"] = a.to_check;
    j["not_looked_at"] = a.not_looked_at;
    rows.push_back(j);
  }
  Json document{{"rows", rows}};
  for (const auto& a : all)
    if (const auto& f = a.of.function; f && !document.contains(own_files_key))
      document[std::string(own_files_key)] = json_of(std::vector{OwnFile{f->name.file, f->sha256}});
  return text_of(document);
}

std::string text_of(const FunctionAudit& a) {
  if (!a.of.function) return fmt::format("{}: {}\n", a.of.entry.function, a.of.entry.refused);
  const auto& f = *a.of.function;
  std::string s =
      fmt::format("{}{}: {} operations a sample\n", foreign::text_of(f.name),
                  f.line > 0 ? fmt::format(", line {}", f.line) : "", a.of.operations.total());
  const auto line = [&](const char* name, const std::string& text) {
    if (!text.empty()) s += fmt::format("  {:<16}{}\n", name, text);
  };
  if (!is_audited(f)) {
    line("not audited",
         takes_direction(f)
             ? "it takes a view and no light, as an albedo does: it is no BRDF. Where an argument "
               "is the light's, say which: --argument u=nol"
             : "it takes no direction. Where an argument is a cosine, say which: --argument u=voh");
    return s;
  }
  if (f.stands == foreign::Stands::lobe)
    line("includes", f.includes + (f.unclear   ? " (not clear: --includes pi or nothing says it)"
                                   : f.guessed ? " (guessed; --includes says it)"
                                               : ""));
  if (const auto& n = a.normalisation)
    line("∫ D cos θ", std::abs(n->value - 1) < 1e-4 ? "1: normalised"
                                                    : fmt::format("{:.5g} at {}", n->value, n->at));
  if (const auto& e = a.albedo; e && std::isnan(e->value)) {
    line("energy", "the albedo has no value at " + e->at);
  } else if (e) {
    line("energy",
         e->value > 1 + 1e-3
             ? fmt::format("gains: albedo {:.4g} at {}", e->value, e->at)
             : fmt::format("gains none: albedo at most {:.4g} up to 88°{}", e->value,
                           a.together ? ", a diffuse part and a highlight each for itself" : ""));
    if (f.unclear && e->value > 1 + 1e-3)
      line("",
           fmt::format("albedo {:.4g} there if the value includes π", e->value / std::numbers::pi));
    if (const auto& t = a.together)
      line("", fmt::format("together at most {:.4g}, at {}{}", t->value, t->at,
                           t->value > 1 + 1e-3 && e->value <= 1 + 1e-3
                               ? ": so does any sum of a diffuse part and a highlight"
                               : ""));
    if (a.usual) line("", fmt::format("albedo {:.4g} at {}", a.usual->value, a.usual->at));
    if (const auto& h = a.highlight)
      line("", fmt::format("the highlight with F0 = 1 returns {:.3g} along the normal at {}, "
                           "expected 1 where it is smooth",
                           h->value, h->at));
    line("", fmt::format("of colours at their upper bounds no less than {:.4g}, at {}",
                         a.darkest->value, a.darkest->at));
  }
  if (const auto& r = a.reciprocity)
    line("reciprocity",
         r->value < 1e-6 ? "kept" : fmt::format("off by {:.2g} at {}", r->value, r->at));
  if (a.lowest) line("negative", fmt::format("{:.3g} at {}", a.lowest->value, a.lowest->at));
  if (a.not_finite)
    line("without a value",
         fmt::format("{} inputs, in double; the first at {}", a.not_finite, a.not_finite_at));
  line("in half", a.half);
  if (a.nearest) {
    line(is_same(*a.nearest) ? "it is" : "nearest", nearest_text(a));
    line("beside ours", fmt::format("{} operations, ours {}", a.of.operations.total(),
                                    operations_of(a.nearest->term).sample.total()));
  }
  if (const auto& m = a.model) {
    line("D and V",
         fmt::format("those of {}{}{}{}", m->spec, width_text(m->width, m->power),
                     m->masking_power == m->power
                         ? ""
                         : " in D" + width_text(m->width, m->masking_power) + " in V",
                     m->other_fresnel ? "; its Fresnel term is that of none of ours" : ""));
    line("beside ours",
         fmt::format("{} operations, ours {}{}", a.of.operations.total(), m->operations,
                     m->lacks_diffuse ? " without a diffuse part" : ""));
  }
  if (!a.no_model.empty()) line("beside ours", "none: " + a.no_model);
  for (const auto& slip : a.slips) line("likely slip", slip);
  for (const auto& c : a.to_check) line("check", c);
  for (const auto& n : f.notes) line("note", fmt::format("line {}: {}", n.line, n.text));
  for (const auto& n : a.not_looked_at) line("not looked at", n);
  return s;
}

bool is_term_name(const std::string& name) {
  return foreign::is_name(name) || std::ranges::any_of(names_of<Role>, [&](auto role) {
           return name.starts_with(std::string(role) + ".");
         });
}

namespace {

/// Differences of a comparison as they come: the largest goes into it with its place.
class Differences {
 public:
  explicit Differences(TermComparison& c) : of_(c) {}
  /// One that is no number is left out.
  void take(double d, std::span<const Parameter> parameters, const Values& at, const Row& row) {
    if (!std::isfinite(d)) return;
    squares_ += d * d;
    ++count_;
    if (!(d > of_.largest)) return;
    of_.largest = d;
    of_.at = auditing::joined(auditing::text(parameters, at), auditing::text(row));
  }
  double rms() const { return count_ ? std::sqrt(squares_ / static_cast<double>(count_)) : 0; }

 private:
  TermComparison& of_;
  double squares_ = 0;
  std::size_t count_ = 0;
};

}  // namespace

TermComparison compare_terms(const std::string& a,
                             const std::string& b,
                             const std::vector<std::pair<std::string, Range>>& domain) {
  const bool a_is_own = foreign::is_name(a), b_is_own = foreign::is_name(b);
  const std::size_t first = a_is_own ? 0 : find_term(a), second = b_is_own ? 0 : find_term(b);
  std::optional<Role> role;
  if (!a_is_own) role = catalogue()[first].role();
  if (!b_is_own) role = catalogue()[second].role();
  if (!role) role = catalogue()[foreign_term_named(a)].role();
  std::vector<std::string> tries{a};
  if (*role == Role::masking && a_is_own && a.find("includes=") == a.npos) {
    const auto close = a.rfind('}');
    const auto with = [&](const std::string& what) {
      return close == a.npos ? a + "{includes=" + what + "}"
                             : a.substr(0, close) + ";includes=" + what + "}";
    };
    tries = {with("v"), with("g")};
  }
  std::optional<TermComparison> best;
  for (const auto& name : tries) {
    const std::size_t x = a_is_own ? foreign_term_named(name, role) : first;
    const std::size_t y = b_is_own ? foreign_term_named(b, role) : second;
    const auto &own = catalogue()[x], &other = catalogue()[y];
    if (own.role() != other.role())
      throw wrong_usage(fmt::format("{} is of {}, {} of {}: terms of one role are compared", a,
                                    name_of(own.role()), b, name_of(other.role())));
    TermComparison c;
    c.a = a, c.b = b;
    if (tries.size() > 1) c.read_as = name.find("includes=v") != name.npos ? "V" : "G";
    // The parameters of both by name; a width by another name, or as roughness, is the other's.
    const auto domain_of = [&](const Parameter& p) {
      for (const auto& [n, r] : domain)
        if (lowered(n) == lowered(std::string(p.name))) return r;
      if (std::isnan(p.start))
        throw wrong_usage(fmt::format("{} of {} has no bounds: give them by --domain {}=LOW,HIGH",
                                      p.name, a, p.name));
      return p.fit;
    };
    constexpr std::size_t places = 9;
    const auto& rows = auditing::rows_of(*role);
    const auto width_a = width_of(own.parameters), width_b = width_of(other.parameters);
    Differences differences(c);
    for (std::size_t k = 0; k < places; ++k) {
      std::vector<double> p, q;
      for (const auto& w : own.parameters) {
        Parameter at = w;
        at.legal = domain_of(w);
        at.start = at.legal.low;
        p.push_back(values_between(at, places)[k]);
      }
      for (std::size_t j = 0; j < other.parameters.size(); ++j) {
        const auto& w = other.parameters[j];
        const auto same = std::ranges::find(own.parameters, w.name, &Parameter::name);
        double v = std::isnan(w.start) ? 0.5 : w.start;
        if (same != own.parameters.end()) {
          v = p[static_cast<std::size_t>(same - own.parameters.begin())];
        } else if (width_b == j && width_a) {
          const bool rough_a = is_rough(own.parameters[*width_a].name), rough_b = is_rough(w.name);
          v = p[*width_a];
          v = rough_a && !rough_b ? v * v : rough_b && !rough_a ? std::sqrt(v) : v;
        }
        q.push_back(std::clamp(v, w.legal.low, w.legal.high));
      }
      const auto f = shown_in(Number::double_, x, p, rows),
                 g = shown_in(Number::double_, y, q, rows);
      const double scale = *role == Role::ndf ? *std::ranges::max_element(g) : 1;
      for (std::size_t i = 0; i < rows.size(); ++i)
        differences.take(std::abs(f[i] - g[i]) / scale, own.parameters, p, rows[i]);
    }
    static constexpr std::string_view measures[] = {"D over the peak", "G2", "F", "f"};
    c.measure = measures[static_cast<std::size_t>(*role)];
    c.rms = differences.rms();
    c.operations_a = operations_of(x).sample.total();
    c.operations_b = operations_of(y).sample.total();
    if (!best || c.largest < best->largest) {
      best = c;
      best->half_a = in_half(x, domain);
      best->half_b = in_half(y, domain);
    }
  }
  return *best;
}

namespace {

/// Says which of a function's parameters stand for which of a model's, and what the others are.
std::string pairs_of(const BoundModel& model,
                     std::span<const Parameter> own,
                     const auto& stands_for,
                     const auto& scale_of,
                     const auto& note_of) {
  std::vector<std::string> all, alone;
  std::vector<bool> is_paired(own.size(), false);
  for (const auto& q : model.model.parameters) {
    std::string text = fmt::format("{} {:.4g}", q.name, model.values[q.first]);
    for (std::size_t j = 0; j < own.size(); ++j)
      if (stands_for(q.name, own[j])) {
        is_paired[j] = true;
        const double scale = scale_of(q.name, own[j]);
        text = fmt::format("{} = {}{}", q.name, scale == 1 ? "" : fmt::format("{} ", scale),
                           alpha_text(std::string(stem_of(own[j].name)),
                                      q.name == "alpha" && is_rough(own[j].name) ? 2 : 1));
      }
    all.push_back(std::move(text));
  }
  for (std::size_t j = 0; j < own.size(); ++j)
    if (!is_paired[j]) alone.push_back(note_of(own[j]));
  return fmt::format("{}{}", fmt::join(all, ", "),
                     alone.empty() ? "" : fmt::format("; only yours: {}", fmt::join(alone, ", ")));
}

}  // namespace

TermComparison compare_with_model(const std::string& own,
                                  const std::string& spec,
                                  const std::vector<std::pair<std::string, Range>>& domain) {
  const std::size_t term = foreign_term_named(own);
  const auto& entry = catalogue()[term];
  if (entry.role() != Role::diffuse)
    throw wrong_usage(fmt::format("{} is of {}, and {} a whole model: name a term of ours, as {}.…",
                                  own, name_of(entry.role()), spec, name_of(entry.role())));
  const auto width = width_of(entry.parameters);
  const auto is_one_of = [](std::string_view name, std::initializer_list<std::string_view> names) {
    return std::ranges::find(names, lowered(std::string(name))) != names.end();
  };
  const auto stands_for = [&](std::string_view ours, const Parameter& p) {
    if (lowered(std::string(stem_of(p.name))) == ours) return true;
    if (ours == "alpha") return width && &p == &entry.parameters[*width];
    const auto name = stem_of(p.name);
    if (ours == "kd") return is_one_of(name, {"albedo", "diffuse", "basecolor", "base_color"});
    return ours == "f0" && is_one_of(name, {"specular", "r0", "ks"});
  };
  TermComparison c;
  c.a = own, c.b = spec, c.measure = "f over its own value";
  constexpr std::size_t places = 9;
  const auto& rows = auditing::rows_of(Role::diffuse);
  Differences differences(c);
  BoundModel model = bind_model(spec, {}, 1);
  // In a metallic workflow specular is F0 of a dielectric over 0.08; metals are left out where
  // nothing is said of them.
  const auto is_metallic = [](const Parameter& p) {
    return plain_name(p.name).starts_with("metal");
  };
  const bool has_metals = std::ranges::any_of(entry.parameters, is_metallic);
  const auto scale_of = [&](std::string_view ours, const Parameter& p) {
    return has_metals && ours == "f0" && lowered(std::string(p.name)) == "specular" ? 0.08 : 1.0;
  };
  const auto is_said = [&](const Parameter& p) {
    return std::ranges::any_of(
        domain, [&](const auto& d) { return lowered(d.first) == lowered(std::string(p.name)); });
  };
  const auto note_of = [&](const Parameter& p) {
    return is_metallic(p) && !is_said(p) ? fmt::format("{} {:.4g}", p.name, low_of(p))
                                         : std::string(p.name);
  };
  c.pairs = pairs_of(model, entry.parameters, stands_for, scale_of, note_of);
  for (std::size_t k = 0; k < places; ++k) {
    std::vector<double> p;
    for (const auto& w : entry.parameters) {
      Parameter at = w;
      for (const auto& [n, r] : domain)
        if (lowered(n) == lowered(std::string(w.name))) at.legal = r, at.start = r.low;
      if (std::isnan(at.start))
        throw wrong_usage(fmt::format("{} of {} has no bounds: give them by --domain {}=LOW,HIGH",
                                      w.name, own, w.name));
      p.push_back(is_metallic(w) && !is_said(w) ? low_of(w) : values_between(at, places)[k]);
    }
    for (const auto& q : model.model.parameters)
      for (std::size_t j = 0; j < p.size(); ++j)
        if (const auto& w = entry.parameters[j]; stands_for(q.name, w))
          model.values[q.first] =
              q.name == "alpha" && is_rough(w.name) ? p[j] * p[j] : scale_of(q.name, w) * p[j];
    const auto f = values_in(Number::double_, term, p, rows), g = evaluate(model, rows)[0];
    for (std::size_t i = 0; i < rows.size(); ++i)
      differences.take(std::abs(f[i] / g[i] - 1), entry.parameters, p, rows[i]);
  }
  c.rms = differences.rms();
  c.operations_a = operations_of(*foreign_term(term)->function, 3).total();
  c.operations_b = operations_of(compose(spec, 3)).total();
  c.half_a = in_half(term, domain);
  c.half_b = in_half(stability::subjects_of(spec).back(), {});
  return c;
}

std::string to_json(const TermComparison& c) {
  Json document{{"a", c.a},
                {"b", c.b},
                {"read_as", c.read_as.empty() ? Json() : Json(c.read_as)},
                {"parameters", c.pairs.empty() ? Json() : Json(c.pairs)},
                {"measure", c.measure},
                {"largest", c.largest},
                {"at", c.at},
                {"rms", c.rms},
                {"operations", {c.operations_a, c.operations_b}},
                {"half", {c.half_a, c.half_b}}};
  const auto files = own_files({c.a, c.b});
  if (!files.empty()) document[std::string(own_files_key)] = json_of(files);
  return text_of(document);
}

std::string text_of(const TermComparison& c) {
  std::string s = fmt::format("{} beside {}{}\n", c.a, c.b,
                              c.read_as.empty() ? "" : fmt::format(", read as {}", c.read_as));
  if (!c.pairs.empty()) s += fmt::format("  {:<14}{}\n", "parameters", c.pairs);
  s += c.largest < 1e-12 ? fmt::format("  {:<14}none, in {}\n", "difference", c.measure)
                         : fmt::format("  {:<14}{:.4g} at most, RMS {:.3g}, in {}; at {}\n",
                                       "difference", c.largest, c.rms, c.measure, c.at);
  s += fmt::format("  {:<14}{} and {} operations\n", "cost", c.operations_a, c.operations_b);
  s += fmt::format("  {:<14}{}\n  {:<14}{}\n", "in half", c.half_a, "", c.half_b);
  return s;
}

}  // namespace gonio
