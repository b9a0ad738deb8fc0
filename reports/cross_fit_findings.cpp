// The cross fit report in sentences: made from its figures alone.
#include <algorithm>
#include <array>
#include <cmath>

#include "reports/cross_fit_parts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio {
namespace {

using Cases = std::vector<const CrossCase*>;

constexpr std::string_view once = "GGX", all_orders = "GGX, all orders";

struct Where {
  std::string_view truth, fitted;
  Metric metric = Metric::log;
  std::string_view layout = cross_layouts[0].name;
  std::string_view material = {};  ///< empty: all
};
Cases cases_of(const CrossFitReport& r, const Where& w) {
  Cases out;
  for (const auto& c : r.cases)
    if (c.truth == w.truth && c.fitted == w.fitted && c.metric == w.metric &&
        c.layout == w.layout && (w.material.empty() || c.material == w.material))
      out.push_back(&c);
  return out;
}
Cases dielectrics(Cases all) {
  std::erase_if(all, [](const CrossCase* c) { return !c->is_dielectric(); });
  return all;
}
Cases any(Cases all) {
  return all;
}
Cases metals(Cases all) {
  std::erase_if(all, [](const CrossCase* c) { return c->is_dielectric(); });
  return all;
}

/// A shift of a parameter: roughness and gamma absolute, F0 relative.
struct Shift {
  double by;
  const CrossCase* in;
};
struct Shifts {
  std::vector<Shift> found{};         ///< of what was determined, and free to move
  std::size_t at_bound = 0, all = 0;  ///< at_bound: or not determined

  explicit operator bool() const { return !found.empty(); }
  const Shift& least() const { return *std::ranges::min_element(found, {}, &Shift::by); }
  const Shift& most() const { return *std::ranges::max_element(found, {}, &Shift::by); }
  double furthest() const { return std::max(std::abs(least().by), std::abs(most().by)); }
  double rms() const {
    double sum = 0;
    for (const auto& s : found) sum += s.by * s.by;
    return std::sqrt(sum / static_cast<double>(found.size()));
  }
};
Shifts shifts(const Cases& cases, std::string_view parameter) {
  Shifts out;
  for (const auto* c : cases)
    for (const auto& v : c->values) {
      if (v.parameter != parameter) continue;
      ++out.all;
      if (v.is_free())
        out.found.push_back({v.shift(), c});
      else
        ++out.at_bound;
    }
  return out;
}

std::string signed_number(double x) {
  return std::abs(x) < 5e-5 ? "0" : fmt::format("{}{:.2g}", x < 0 ? "−" : "+", std::abs(x));
}
std::string signed_percent(double x) {
  return std::abs(x) < 5e-5 ? "0 %"
                            : fmt::format("{}{:.2g} %", x < 0 ? "−" : "+", 100 * std::abs(x));
}
std::string place(const CrossCase& c) {
  return fmt::format("{}, roughness {:g}", c.material, c.roughness);
}
/// "by −0.013 (IOR 2, roughness 1) to +0.0012 (gold, roughness 0.3)", with what bounds cut off
std::string span(const Shifts& s, std::string (*said)(double)) {
  if (!s) return "not at all within its bounds";
  const auto &a = s.least(), &b = s.most();
  std::string text = said(a.by) == said(b.by) ? fmt::format("by {}", said(a.by))
                                              : fmt::format("by {} ({}) to {} ({})", said(a.by),
                                                            place(*a.in), said(b.by), place(*b.in));
  if (s.at_bound > 0)
    text += fmt::format("; in {} of {} fits it ends at a bound", s.at_bound, s.all);
  return text;
}
std::string residuals(const Cases& cases) {
  const auto [a, b] = std::ranges::minmax_element(cases, {}, &CrossCase::log_rms);
  return fmt::format("{:.2g} to {:.2g}", (*a)->log_rms, (*b)->log_rms);
}
double most_residual(const Cases& cases) {
  return (*std::ranges::max_element(cases, {}, &CrossCase::log_rms))->log_rms;
}
std::string roughness_and_f0(const Cases& cases) {
  return fmt::format("the fitted roughness {} and F0 {}",
                     span(shifts(cases, "roughness"), signed_number),
                     span(shifts(cases, "f0"), signed_percent));
}

void own_truth(CrossFitReport& r) {
  double roughness = 0, f0 = 0, residual = 0;
  std::size_t n = 0;
  for (const auto& c : r.cases) {
    if (c.kind != "exact" || c.truth == all_orders) continue;
    ++n;
    residual = std::max(residual, c.log_rms);
    for (const auto& v : c.values) {
      if (v.parameter == "roughness")
        roughness = std::max(roughness, std::abs(v.fitted / v.truth - 1));
      if (v.parameter == "f0") f0 = std::max(f0, std::abs(v.fitted / v.truth - 1));
    }
  }
  if (n == 0) return;
  const bool right = roughness < 1e-6 && f0 < 1e-5;
  r.findings.push_back(
      fmt::format("The ruler: fitted with the forms it was made from, a slice gives its parameters "
                  "{}: over {} fits roughness is "
                  "off by {:.1g} of itself at most, F0 by {:.1g}, residual {:.1g}.",
                  right ? "back" : "back only roughly", n, roughness, f0, residual));
}

void schlick(CrossFitReport& r) {
  const auto all = cases_of(r, {once, "fresnel.schlick"});
  const auto glass = dielectrics(all), metal = metals(all);
  if (glass.empty() || metal.empty()) return;
  r.findings.push_back(fmt::format(
      "Schlick instead of exact Fresnel shifts {} for dielectrics (log-RMS residual {}); for "
      "metals {} (residual {}).",
      roughness_and_f0(glass), residuals(glass), roughness_and_f0(metal), residuals(metal)));
}

void maskings(CrossFitReport& r) {
  struct Form {
    std::string_view id, what;
  };
  std::vector<std::string> words;
  for (const auto& [id, what] : {Form{"masking.schlick_ggx.direct", "k = (r+1)²/8"},
                                 Form{"masking.schlick_ggx.half_alpha", "k = r²/2"},
                                 Form{"masking.ue_joint", "Unreal's joint form"},
                                 Form{"masking.smith_ggx.separable", "separable Smith"}}) {
    const auto all = dielectrics(cases_of(r, {once, id}));
    if (all.empty()) continue;
    words.push_back(fmt::format("{} shifts {}; residual up to {:.2g}, a factor of {:.2g}", what,
                                roughness_and_f0(all), most_residual(all),
                                std::exp(most_residual(all))));
  }
  if (!words.empty())
    r.findings.push_back(fmt::format("In place of Smith's correlated masking, on dielectrics: {}.",
                                     fmt::join(words, ". ")));
}

/// Forms of a kind by what they do to roughness, from the least.
void ranking(CrossFitReport& r,
             std::string_view kind,
             std::string_view what,
             Cases (*of)(Cases),
             std::string_view of_what) {
  struct Place {
    std::string_view form;
    double rms, residual;
    std::size_t at_bound;
  };
  std::vector<Place> places;
  for (const auto& c : r.cases) {
    if (c.kind != kind || c.truth != once ||
        std::ranges::find(places, c.fitted, &Place::form) != places.end())
      continue;
    const auto all = of(cases_of(r, {once, c.fitted}));
    const auto s = shifts(all, "roughness");
    if (!s) continue;
    double squares = 0;
    for (const auto* x : all) squares += x->log_rms * x->log_rms;
    places.push_back(
        {c.fitted, s.rms(), std::sqrt(squares / static_cast<double>(all.size())), s.at_bound});
  }
  if (places.size() < 2) return;
  std::ranges::stable_sort(places, {}, &Place::residual);
  std::vector<std::string> words;
  for (const auto& p : places)
    words.push_back(fmt::format("{} {:.2g} ({:.2g}{})", short_form(p.form), p.residual, p.rms,
                                p.at_bound > 0 ? fmt::format(", {} at a bound", p.at_bound) : ""));
  r.findings.push_back(
      fmt::format("{} by their log-RMS residual over all {} and roughnesses, in brackets the RMS "
                  "shift of roughness: {}.",
                  what, of_what, fmt::join(words, ", ")));
}

/// Over roughness: where a material looks rougher than it is, and where smoother.
std::string looks(const Cases& cases) {
  const auto s = shifts(cases, "roughness");
  if (!s) return "";
  const auto &up = s.most(), &down = s.least();
  std::vector<std::string> words;
  if (up.by > 0)
    words.push_back(fmt::format("rougher by up to {:.2g} (at {:g})", up.by, up.in->roughness));
  if (down.by < 0)
    words.push_back(
        fmt::format("smoother by up to {:.2g} (at {:g})", -down.by, down.in->roughness));
  return fmt::format("{}", fmt::join(words, ", "));
}

void lost_energy(CrossFitReport& r) {
  std::vector<std::string> words;
  for (const auto& material : r.materials) {
    const auto all =
        cases_of(r, {all_orders, "exact", Metric::log, cross_layouts[0].name, material});
    if (all.empty()) continue;
    const auto f0 = shifts(all, "f0");
    const std::string of_f0 = f0 ? fmt::format("F0 by {} to {}", signed_percent(f0.least().by),
                                               signed_percent(f0.most().by))
                                 : "F0";
    words.push_back(fmt::format(
        "{} {}, {}{}", material, looks(all), of_f0,
        f0.at_bound > 0 ? fmt::format(" or to its bound ({} of {})", f0.at_bound, f0.all) : ""));
  }
  if (!words.empty())
    r.findings.push_back(
        fmt::format("The energy that single scattering loses: where light meets the facets as "
                    "often as it will, the exact forms of "
                    "single scattering make a surface look so: {}.",
                    fmt::join(words, "; ")));
}

void what_takes_it_up(CrossFitReport& r) {
  const auto alone = cases_of(r, {all_orders, "exact"}),
             gamma = cases_of(r, {all_orders, "ndf.gtr"}),
             diffuse = cases_of(r, {all_orders, "lambert+ggx/smith_ggx.correlated/exact"});
  const auto rms = [](const Cases& cases) {
    double sum = 0;
    for (const auto* c : cases) sum += c->log_rms * c->log_rms;
    return std::sqrt(sum / static_cast<double>(cases.size()));
  };
  const auto g = shifts(gamma, "gamma");
  if (!alone.empty() && g)
    r.findings.push_back(
        fmt::format("A free gamma {} of it: from 2 it goes {}, and the log-RMS residual over all "
                    "slices from {:.2g} to {:.2g}; the "
                    "RMS shift of roughness from {:.2g} to {:.2g}.",
                    rms(gamma) < 0.5 * rms(alone) ? "takes up most" : "takes up a part",
                    span(g, signed_number), rms(alone), rms(gamma),
                    shifts(alone, "roughness").rms(), shifts(gamma, "roughness").rms()));
  const auto kd = shifts(diffuse, "kd");
  if (!alone.empty() && kd)
    r.findings.push_back(fmt::format(
        "A free Lambertian beside the lobe {} of it: it is fitted with a kd of up to {:.2g} ({}) "
        "where there is none, the residual goes to "
        "{:.2g} and the RMS shift of roughness to {:.2g}.",
        rms(diffuse) < 0.5 * rms(alone) ? "takes up most" : "takes up a part", kd.most().by,
        place(*kd.most().in), rms(diffuse), shifts(diffuse, "roughness").rms()));
}

void other_gammas(CrossFitReport& r) {
  std::vector<std::string> words;
  std::vector<std::string_view> truths;
  for (const auto& c : r.cases)
    if (c.truth.starts_with("GTR ") && std::ranges::find(truths, c.truth) == truths.end())
      truths.push_back(c.truth);
  for (const auto truth : truths) {
    const auto all = cases_of(r, {truth, "ggx/smith_ggx.correlated/exact"});
    if (const auto s = shifts(all, "roughness"))
      words.push_back(
          fmt::format("{}: {}, residual {}", truth, span(s, signed_number), residuals(all)));
  }
  if (!words.empty())
    r.findings.push_back(fmt::format(
        "GGX fitted to surfaces of another gamma shifts roughness: {}.", fmt::join(words, "; ")));
}

void whole_models(CrossFitReport& r) {
  std::vector<std::string> words;
  for (const auto* name : {"model.gltf", "model.filament", "model.ue_mobile",
                           "model.ue_mobile_simple", "model.unity_mobile"}) {
    const auto all = cases_of(r, {all_orders, name});
    if (const auto s = shifts(all, "roughness"))
      words.push_back(fmt::format(
          "{} {:.2g}{}", short_form(name), s.rms(),
          s.at_bound > 0 ? fmt::format(" ({} of {} at a bound)", s.at_bound, s.all) : ""));
  }
  if (!words.empty())
    r.findings.push_back(
        fmt::format("Whole models fitted to all orders of scattering, RMS shift of roughness: {}.",
                    fmt::join(words, ", ")));
}

/// The same forms by the other metric, and over the other layouts.
void what_else_decides(CrossFitReport& r) {
  std::vector<std::string> words;
  for (const auto* form :
       {"fresnel.schlick", "masking.smith_ggx.separable", "masking.schlick_ggx.half_alpha",
        "masking.schlick_ggx.direct", "ndf.beckmann"}) {
    const auto said = [&](Metric metric, std::string_view layout) -> std::string {
      const auto s = shifts(cases_of(r, {once, form, metric, layout, "IOR 1.5"}), "roughness");
      if (2 * s.at_bound > s.all) return "mostly at a bound";
      return fmt::format("{} to {}", signed_number(s.least().by), signed_number(s.most().by));
    };
    if (cases_of(r, {once, form, Metric::l2_cosine, cross_layouts[0].name, "IOR 1.5"}).empty())
      continue;
    words.push_back(fmt::format(
        "{} {} (by l2_cosine {}; slice to the horizon {}; hemisphere {})", short_form(form),
        said(Metric::log, cross_layouts[0].name), said(Metric::l2_cosine, cross_layouts[0].name),
        said(Metric::log, cross_layouts[1].name), said(Metric::log, cross_layouts[2].name)));
  }
  if (!words.empty())
    r.findings.push_back(fmt::format(
        "A shift belongs to a metric and to the directions measured. Of roughness at IOR 1.5: {}.",
        fmt::join(words, "; ")));
}

void trust(CrossFitReport& r) {
  std::size_t lost = 0;
  double error = 0;
  for (const auto& c : r.cases) {
    lost += !c.converged;
    if (const auto* v = c.find("roughness");
        v && c.kind == "exact" && v->status == ParameterStatus::free)
      error = std::max(error, v->error);
  }
  r.findings.push_back(
      fmt::format("Of {} fits {} did not converge. What the random walks of multiple scattering "
                  "leave uncertain shifts the roughness of the exact form by {:.1g} at most.",
                  r.cases.size(), lost == 0 ? "none" : fmt::format("{}", lost), error));
}

}  // namespace

void add_sentences(CrossFitReport& r) {
  for (const auto& c : r.cases) {
    const auto same = [&](const CrossSentence& s) {
      return s.truth == c.truth && s.fitted == c.fitted;
    };
    if (std::ranges::any_of(r.sentences, same)) continue;
    const auto all = cases_of(r, {c.truth, c.fitted});
    std::vector<std::string> parts;
    const auto add = [&](const Cases& cases, std::string_view of) {
      if (cases.empty()) return;
      parts.push_back(
          fmt::format("{}: shifts {}; residual {}", of, roughness_and_f0(cases), residuals(cases)));
      if (const auto gamma = shifts(cases, "gamma"); gamma.all > 0)
        parts.back() += fmt::format("; gamma {}", span(gamma, signed_number));
    };
    add(dielectrics(all), "Dielectrics");
    add(metals(all), "Metals");
    r.sentences.push_back({c.truth, c.fitted, c.kind, fmt::format("{}.", fmt::join(parts, ". "))});
  }
}

void add_findings(CrossFitReport& r) {
  schlick(r);
  maskings(r);
  lost_energy(r);
  what_takes_it_up(r);
  other_gammas(r);
  ranking(r, "fresnel", "Fresnel terms", dielectrics, "dielectrics");
  ranking(r, "fresnel", "Fresnel terms", metals, "metals");
  ranking(r, "masking", "Masking terms", any, "materials");
  ranking(r, "distribution", "Distributions", any, "materials");
  whole_models(r);
  what_else_decides(r);
  own_truth(r);
  trust(r);
}

}  // namespace gonio
