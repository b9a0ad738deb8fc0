// The cross fit report in sentences: made from its figures alone.
#include <algorithm>
#include <array>
#include <cmath>

#include "reports/cross_fit/cases.h"
#include "reports/finding/words.h"

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
Cases cases_of(const CrossFitRows& r, const Where& w) {
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
      if (c->is_determined(v))
        out.found.push_back({v.shift(), c});
      else
        ++out.at_bound;
    }
  return out;
}

std::string number(double x) {
  return x < 1e-7 ? "0" : fmt::format("{:.2g}", x);
}
std::string signed_number(double x) {
  return std::abs(x) < 5e-5 ? "0" : fmt::format("{}{:.2g}", x < 0 ? "−" : "+", std::abs(x));
}
std::string signed_percent(double x) {
  return std::abs(x) < 5e-5 ? "0\u00a0%" : fmt::format("{}{}", x > 0 ? "+" : "", percent(x, 2));
}
std::string place(const CrossCase& c) {
  return fmt::format("{}, roughness {:g}", c.material, c.roughness);
}
/// Number that bounds have cut off.
std::string at_bounds(const Shifts& s) {
  return s.at_bound == 0 ? "" : fmt::format(" [{} of {} at a bound]", s.at_bound, s.all);
}

/// "by −0.013 (IOR 2, roughness 1) to +0.0012 (gold, roughness 0.3)", with what bounds cut off
std::string span(const Shifts& s, std::string (*said)(double)) {
  if (!s) return "not at all within its bounds";
  const auto &a = s.least(), &b = s.most();
  std::string text = said(a.by) == said(b.by) ? fmt::format("by {}", said(a.by))
                                              : fmt::format("by {} ({}) to {} ({})", said(a.by),
                                                            place(*a.in), said(b.by), place(*b.in));
  return text + at_bounds(s);
}
std::string residuals(const Cases& cases) {
  const auto [a, b] = std::ranges::minmax_element(cases, {}, &CrossCase::log_rms);
  return fmt::format("{} to {}", number((*a)->log_rms), number((*b)->log_rms));
}
double rms_residual(const Cases& cases) {
  double squares = 0;
  for (const auto* c : cases) squares += c->log_rms * c->log_rms;
  return std::sqrt(squares / static_cast<double>(cases.size()));
}

double most_residual(const Cases& cases) {
  return (*std::ranges::max_element(cases, {}, &CrossCase::log_rms))->log_rms;
}
std::string roughness_and_f0(const Cases& cases) {
  return fmt::format("the fitted roughness {} and F0 {}",
                     span(shifts(cases, "roughness"), signed_number),
                     span(shifts(cases, "f0"), signed_percent));
}

/// The causes that hurt, side by side.
void summary(Findings& to, const CrossFitRows& r) {
  struct Cause {
    std::string_view truth, fitted, what;
  };
  const auto say = [&](Cases (*of)(Cases), std::string_view on) {
    std::vector<std::string> words;
    for (const auto& [truth, fitted, what] :
         {Cause{once, "fresnel.schlick", "Schlick"},
          Cause{once, "masking.ue_joint", "Unreal's joint masking"},
          Cause{once, "masking.schlick_ggx.half_alpha", "k = r²/2"},
          Cause{once, "masking.schlick_ggx.direct", "k = (r+1)²/8"},
          Cause{all_orders, "exact", "the energy lost between facets"}}) {
      const auto all = of(cases_of(r, {truth, fitted}));
      const auto roughness = shifts(all, "roughness"), f0 = shifts(all, "f0");
      if (!roughness) continue;
      words.push_back(fmt::format(
          "{} {:.2g}{} and {}", what, roughness.rms(), at_bounds(roughness),
          2 * f0.at_bound > f0.all ? "mostly a bound" : percent(f0.rms(), 2) + at_bounds(f0)));
    }
    if (!words.empty())
      to.say(fmt::format("RMS shifts of roughness and of F0 that fits bring about on {}: {}.", on,
                         fmt::join(words, ", ")));
  };
  say(dielectrics, "dielectrics");
  say(metals, "metals");
  const auto off = [&](std::string_view form) {
    return shifts(dielectrics(cases_of(r, {once, form})), "roughness");
  };
  if (const auto k = off("masking.schlick_ggx.direct"), f = off("fresnel.schlick"); k && f)
    to.headline = fmt::format(
        "Fitted with Schlick's k = (r+1)²/8, the roughness of dielectrics comes out wrong by "
        "{:.2g} "
        "(RMS, log metric); with Schlick's Fresnel by {:.2g}.",
        k.rms(), f.rms());
}

void schlick(Findings& to, const CrossFitRows& r) {
  const auto all = cases_of(r, {once, "fresnel.schlick"});
  const auto glass = dielectrics(all), metal = metals(all);
  if (glass.empty() || metal.empty()) return;
  to.say(fmt::format(
      "Schlick instead of exact Fresnel shifts {} for dielectrics (log-RMS residual {}); "
      "for metals {} (residual {}).",
      roughness_and_f0(glass), residuals(glass), roughness_and_f0(metal), residuals(metal)));
}

/// The fit by l2_cosine follows the bright peak, that by log all directions alike.
std::string by_the_other_metric(const CrossFitRows& r, std::string_view form) {
  const auto all = dielectrics(cases_of(r, {once, form, Metric::l2_cosine}));
  const auto s = shifts(all, "roughness");
  return s ? fmt::format(
                 ". By the metric l2_cosine, which follows the bright peak, roughness goes {}",
                 span(s, signed_number))
           : "";
}

void maskings(Findings& to, const CrossFitRows& r) {
  struct Form {
    std::string_view id, what;
  };
  for (const auto& [id, what] : {Form{"masking.schlick_ggx.direct", "k = (r+1)²/8"},
                                 Form{"masking.schlick_ggx.half_alpha", "k = r²/2"},
                                 Form{"masking.ue_joint", "Unreal's joint form"},
                                 Form{"masking.smith_ggx.separable", "Separable Smith"}}) {
    const auto all = dielectrics(cases_of(r, {once, id}));
    if (all.empty()) continue;
    const double residual = most_residual(all);
    to.say(fmt::format(
        "{} in place of Smith's correlated masking shifts {} for dielectrics by the log metric; "
        "residual up to {:.2g}, a factor of {:.2g}{}.",
        what, roughness_and_f0(all), residual, std::exp(residual), by_the_other_metric(r, id)));
  }
}

/// Words over roughness: where a material looks rougher than it is, and where smoother.
std::string looks(const Shifts& s) {
  if (!s) return "end at bounds";
  const auto &up = s.most(), &down = s.least();
  std::vector<std::string> words;
  if (up.by > 0) words.push_back(fmt::format("rougher by up to {:.2g} ({})", up.by, place(*up.in)));
  if (down.by < 0)
    words.push_back(fmt::format("smoother by up to {:.2g} ({})", -down.by, place(*down.in)));
  return fmt::format("look {}", fmt::join(words, " and "));
}

void lost_energy(Findings& to, const CrossFitRows& r) {
  const auto all = cases_of(r, {all_orders, "exact"});
  const auto said = [](const Cases& cases) {
    return fmt::format("{}, their F0 shifts {}", looks(shifts(cases, "roughness")),
                       span(shifts(cases, "f0"), signed_percent));
  };
  const auto glass = dielectrics(all), metal = metals(all);
  if (glass.empty() || metal.empty()) return;
  to.say(fmt::format(
      "The energy that single scattering loses: fitted with the exact forms of single scattering, "
      "surfaces whose light meets several facets do not look as they are. Dielectrics {}; metals "
      "{}.",
      said(glass), said(metal)));
}

/// Effect of a further free parameter on the lost energy.
void takes_it_up(Findings& to,
                 const CrossFitRows& r,
                 std::string_view form,
                 std::string_view parameter,
                 std::string_view what) {
  bool falls = true;
  std::vector<std::string> words;
  const auto look_at = [&](Cases (*of)(Cases), std::string_view name) {
    const auto alone = of(cases_of(r, {all_orders, "exact"})),
               with = of(cases_of(r, {all_orders, form}));
    const auto s = shifts(with, parameter), before = shifts(alone, "roughness"),
               after = shifts(with, "roughness");
    if (!s || !before || !after) return;
    falls = falls && rms_residual(with) < rms_residual(alone);
    words.push_back(
        fmt::format("of {} it goes {}, the RMS residual from {:.2g} to {:.2g} and the RMS shift of "
                    "roughness from "
                    "{:.2g} to {:.2g}",
                    name, span(s, signed_number), rms_residual(alone), rms_residual(with),
                    before.rms(), after.rms()));
  };
  look_at(dielectrics, "dielectrics");
  look_at(metals, "metals");
  if (!words.empty())
    to.say(fmt::format("{} takes up {} of it: {}.", what, falls ? "some" : "little or nothing",
                       fmt::join(words, "; ")));
}

void other_gammas(Findings& to, const CrossFitRows& r) {
  std::vector<std::string> words;
  std::vector<std::string_view> truths;
  for (const auto& c : r.cases)
    if (c.truth.starts_with("GTR ") && std::ranges::find(truths, c.truth) == truths.end())
      truths.push_back(c.truth);
  for (const auto truth : truths) {
    const auto all = cases_of(r, {truth, "ggx/smith_ggx.correlated/exact"});
    if (const auto s = shifts(all, "roughness"))
      words.push_back(fmt::format("of {} {}, residual up to {:.2g}", truth, span(s, signed_number),
                                  most_residual(all)));
  }
  if (!words.empty())
    to.say(fmt::format(
        "GGX with its masking, fitted to surfaces of another gamma, shifts roughness {}.",
        fmt::join(words, "; ")));
}

/// Forms of a kind by what they leave, from the least.
void ranking(Findings& to,
             const CrossFitRows& r,
             std::string_view truth,
             std::string_view kind,
             std::string_view what,
             Cases (*of)(Cases)) {
  struct Place {
    std::string_view form;
    double residual, roughness;
    std::size_t at_bound;
  };
  std::vector<Place> places;
  for (const auto& c : r.cases) {
    if (c.kind != kind || c.truth != truth ||
        std::ranges::find(places, c.fitted, &Place::form) != places.end())
      continue;
    const auto all = of(cases_of(r, {truth, c.fitted}));
    const auto s = shifts(all, "roughness");
    if (s) places.push_back({c.fitted, rms_residual(all), s.rms(), s.at_bound});
  }
  if (places.size() < 2) return;
  std::ranges::stable_sort(places, {}, &Place::residual);
  const auto said = [](const Place& p) {
    return fmt::format("{} {} ({}{})", short_form(p.form), number(p.residual), number(p.roughness),
                       p.at_bound > 0 ? fmt::format(", {} at a bound", p.at_bound) : "");
  };
  std::vector<std::string> words;
  for (const auto& p : places) words.push_back(said(p));
  to.say(fmt::format(
      "{}, by RMS residual over materials and roughnesses (RMS shift of roughness): {}.", what,
      ranking_text(words, "; furthest ")));
}

/// Shifts of some forms over the other layouts.
void directions(Findings& to, const CrossFitRows& r) {
  std::vector<std::string> words;
  for (const std::string_view form :
       {"fresnel.schlick", "masking.smith_ggx.separable", "masking.schlick_ggx.half_alpha",
        "masking.schlick_ggx.direct"}) {
    std::vector<std::string> parts;
    for (const auto& layout : cross_layouts)
      if (const auto s =
              shifts(cases_of(r, {once, form, Metric::log, layout.name, "IOR 1.5"}), "roughness"))
        parts.push_back(
            fmt::format("{} to {}", signed_number(s.least().by), signed_number(s.most().by)));
    if (parts.size() == cross_layouts.size())
      words.push_back(fmt::format("{} {}", short_form(form), fmt::join(parts, ", ")));
  }
  std::vector<std::string_view> where;
  for (const auto& layout : cross_layouts) where.push_back(layout.what);
  if (!words.empty())
    to.say(
        fmt::format("A shift belongs to the directions too. Of roughness at IOR 1.5, over {}: {}.",
                    fmt::join(where, ", "), fmt::join(words, "; ")));
}

void trust(Findings& to, const CrossFitRows& r) {
  double roughness = 0, f0 = 0, residual = 0, error = 0;
  std::size_t own = 0, lost = 0;
  for (const auto& c : r.cases) {
    lost += !c.converged;
    if (c.kind != "exact") continue;
    if (c.truth == all_orders) {
      for (const auto& v : c.values)
        if (v.parameter == "roughness" && c.is_determined(v)) error = std::max(error, v.error);
      continue;
    }
    ++own;
    residual = std::max(residual, c.log_rms);
    for (const auto& v : c.values) {
      if (v.parameter == "roughness") roughness = std::max(roughness, std::abs(v.shift()));
      if (v.parameter == "f0") f0 = std::max(f0, std::abs(v.shift()));
    }
  }
  if (own == 0) return;
  to.say(fmt::format(
      "The ruler: fitted with the forms that it was made from a slice gives its parameters {}: "
      "over {} fits roughness is off by {:.1g} "
      "at most, F0 by {:.1g} of itself, residual {:.1g}. Of {} fits {} did not converge. What the "
      "random walks of "
      "several facets leave uncertain shifts the roughness of the exact form by {:.1g} at most.",
      roughness < 1e-6 && f0 < 1e-5 ? "back" : "back only roughly", own, roughness, f0, residual,
      r.cases.size(), number_or_none(lost), error));
}

}  // namespace

std::vector<CrossSentence> sentences_of_forms(const CrossFitRows& r) {
  std::vector<CrossSentence> out;
  for (const auto& c : r.cases) {
    const auto same = [&](const CrossSentence& s) {
      return s.truth == c.truth && s.fitted == c.fitted;
    };
    if (std::ranges::any_of(out, same)) continue;
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
    out.push_back({c.truth, c.fitted, c.kind, fmt::format("{}.", fmt::join(parts, ". "))});
  }
  return out;
}

Findings findings(const CrossFitRows& r) {
  Findings all;
  summary(all, r);
  schlick(all, r);
  maskings(all, r);
  lost_energy(all, r);
  takes_it_up(all, r, "ndf.gtr", "gamma", "A free gamma");
  takes_it_up(all, r, "lambert+ggx/smith_ggx.correlated/exact", "kd",
              "A free Lambertian (kd is 0 in truth)");
  other_gammas(all, r);
  ranking(all, r, once, "fresnel", "Fresnel terms on dielectrics", dielectrics);
  ranking(all, r, once, "fresnel", "Fresnel terms on metals", metals);
  ranking(all, r, once, "masking", "Masking terms", any);
  ranking(all, r, once, "distribution", "Distributions, gamma free where there is one", any);
  ranking(all, r, all_orders, "model", "Whole models, fitted to all orders", any);
  directions(all, r);
  trust(all, r);
  return all;
}

}  // namespace gonio
