// The cross fit report in sentences: made from its figures alone.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "base/quantile.h"
#include "base/rounded.h"
#include "reports/cross_fit/cases.h"
#include "reports/finding/names.h"
#include "reports/finding/words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio {
namespace {

using Cases = std::vector<const CrossCase*>;

/// What sentences are of that name no other metric and directions: Where's.
constexpr std::string_view by_log = "by the log metric on a slice to 80°";

constexpr std::string_view once = "GGX", all_orders = "GGX, all orders", glass = "IOR 1.5",
                           both = "gtr/schlick_ggx.direct/schlick";

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
Cases metals(Cases all) {
  std::erase_if(all, [](const CrossCase* c) { return c->is_dielectric(); });
  return all;
}
struct Interfaces {
  std::string_view name;
  Cases (*of)(Cases);
};
constexpr std::array interfaces{Interfaces{"dielectrics", dielectrics},
                                Interfaces{"metals", metals}};

/// A shift of a parameter: roughness and gamma absolute, F0 relative.
struct Shift {
  double by;
  const CrossCase* in;
};
struct Shifts {
  std::vector<Shift> found{};         ///< of what was determined
  std::size_t at_bound = 0, all = 0;  ///< at_bound: not determined

  explicit operator bool() const { return !found.empty(); }
  const Shift& least() const { return *std::ranges::min_element(found, {}, &Shift::by); }
  const Shift& most() const { return *std::ranges::max_element(found, {}, &Shift::by); }
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

std::string signed_number(double x) {
  return std::abs(x) < 5e-5 ? "0" : fmt::format("{}{:.2g}", x < 0 ? "−" : "+", std::abs(x));
}
std::string signed_percent(double x) {
  return std::abs(x) < 5e-5 ? "0\u00a0%" : fmt::format("{}{}", x > 0 ? "+" : "", percent(x, 2));
}
/// "by −0.013 to +0.0012"
std::string span(double least, double most, std::string (*said)(double)) {
  const auto a = said(least), b = said(most);
  return a == b ? fmt::format("by {}", a) : fmt::format("by {} to {}", a, b);
}
std::string span(const Shifts& s, std::string (*said)(double)) {
  return span(s.least().by, s.most().by, said);
}
double rms_residual(const Cases& cases) {
  double squares = 0;
  for (const auto* c : cases) squares += c->log_rms * c->log_rms;
  return std::sqrt(squares / static_cast<double>(cases.size()));
}
double most_residual(const Cases& cases) {
  return (*std::ranges::max_element(cases, {}, &CrossCase::log_rms))->log_rms;
}
double rms_noise(const Cases& cases) {
  double squares = 0;
  for (const auto* c : cases) squares += c->log_rms_truth * c->log_rms_truth;
  return std::sqrt(squares / static_cast<double>(cases.size()));
}

/// Form in a sentence, after "with": "Schlick's k = (r+1)²/8", "Schlick in place of exact Fresnel".
std::string with(std::string_view form) {
  return form == form_id::schlick ? "Schlick in place of exact Fresnel" : in_text(form);
}

/// Range of F0 over metrics, directions and roughnesses; no value where there is one metric alone.
/// \param to_the_horizon  of the slice to there, by itself: no instrument is trusted there, and least squares of f follow it alone
std::optional<std::pair<double, double>> over_all(const std::vector<CrossRange>& all,
                                                  std::string_view form,
                                                  bool to_the_horizon) {
  std::optional<std::pair<double, double>> out;
  for (const auto& x : all) {
    if (x.fitted != form || x.material != glass || x.parameter != "f0" || !std::isfinite(x.least) ||
        (x.layout == "image_slice_whole") != to_the_horizon)
      continue;
    if (!out) out = {x.least, x.most};
    out = {std::min(out->first, x.least), std::max(out->second, x.most)};
  }
  return out;
}

/// A share with its sign, rounded away from 0: an end of a range.
std::string outward(double share) {
  return (share < 0 ? "−" : "+") + rounded_up(100 * std::abs(share)) + "\u202f%";
}
/// F0 by metric and directions: a figure for one of them alone is none.
void f0_of_glass(Findings& to, const CrossFitRows& r) {
  const auto all = ranges(r);
  for (const auto form : {form_id::direct_k, form_id::schlick}) {
    const auto f0 = over_all(all, form, false), whole = over_all(all, form, true);
    if (!f0) continue;
    to.say(
        fmt::format("F0 of glass (IOR 1.5), fitted with {} to single scattering, is off {} where "
                    "the fit bounds it. The range is over all metrics and sets of directions{}.",
                    with(form), span(f0->first, f0->second, outward),
                    whole ? " except one, a slice down to the horizon" : ""));
    if (to.headline.empty())
      to.headline = fmt::format("A fit of glass with {} gets F0 wrong {}.{}", with(form),
                                span(f0->first, f0->second, outward),
                                whole ? " Tables that reach the horizon are left out." : "");
    if (whole)
      to.say(fmt::format(
          "On a slice down to the horizon, where no instrument is trusted, it is off {}.",
          span(whole->first, whole->second, outward)));
  }
}

void roughness_of_dielectrics(Findings& to, const CrossFitRows& r) {
  for (const auto form :
       {form_id::direct_k, std::string_view("masking.ue_joint"), form_id::schlick})
    if (const auto s = shifts(dielectrics(cases_of(r, {once, form})), "roughness"))
      to.say(fmt::format("With {} the roughness of dielectrics shifts {}, {}.", with(form),
                         span(s, signed_number), by_log));
}

/// Gamma that takes up what two approximations leave.
void gamma_of_both(Findings& to, const CrossFitRows& r) {
  const auto s =
      shifts(cases_of(r, {once, both, Metric::log, cross_layouts[0].name, glass}), "gamma");
  if (!s) return;
  constexpr double usual = 0.3;
  const auto& near = *std::ranges::min_element(
      s.found, {}, [](const Shift& x) { return std::abs(x.in->roughness - usual); });
  to.say(
      fmt::format("Schlick and k = (r+1)²/8 together bend the tail of glass (IOR 1.5): at "
                  "roughness {:g} GTR's gamma shifts by {}, by the log metric on that slice.",
                  near.in->roughness, signed_number(near.by)));
  const auto& most =
      *std::ranges::max_element(s.found, {}, [](const Shift& x) { return std::abs(x.by); });
  if (most.in != near.in)
    to.say(fmt::format("That shift grows to {} at roughness {:g}.", signed_number(most.by),
                       most.in->roughness));
}

/// Words for where a material looks rougher than it is, or smoother.
std::string looks(const Shift& s) {
  return fmt::format("{} by up to {} ({} at roughness {:g})", s.by > 0 ? "rougher" : "smoother",
                     rounded_up(std::abs(s.by)), s.in->material, s.in->roughness);
}

void lost_energy(Findings& to, const CrossFitRows& r) {
  for (const auto& group : interfaces) {
    const auto all = group.of(cases_of(r, {all_orders, "exact"}));
    const auto roughness = shifts(all, "roughness"), f0 = shifts(all, "f0");
    if (!roughness || !f0) continue;
    const auto &up = roughness.most(), &down = roughness.least();
    const bool both_ways = up.by > 0 && down.by < 0;
    const auto& most = std::abs(up.by) > std::abs(down.by) ? up : down;
    to.say(
        fmt::format("Fitted with single scattering, {} whose light meets several facets look {}.",
                    group.name, looks(both_ways ? up : most)));
    if (both_ways) to.say(fmt::format("At other roughnesses {} look {}.", group.name, looks(down)));
    to.say(
        fmt::format("F0 of {} shifts {} there, {}.", group.name, span(f0, signed_percent), by_log));
    if (f0.at_bound > 0)
      to.say(
          fmt::format("The shift of F0 is known for {} values; the fits do not determine the "
                      "others.",
                      of_all(f0.found.size(), f0.all)));
  }
  const auto all = cases_of(r, {all_orders, "exact"});
  if (!all.empty())
    to.say(
        fmt::format("These fits leave a log-RMS residual of {:.2g} over all of them, of which "
                    "{:.1g} is noise of the random walks that made the truth.",
                    rms_residual(all), rms_noise(all)));
}

/// Effect of a further free parameter on the lost energy.
void takes_it_up(Findings& to,
                 const CrossFitRows& r,
                 std::string_view form,
                 std::string_view what) {
  for (const auto& group : interfaces) {
    const auto alone = group.of(cases_of(r, {all_orders, "exact"})),
               with = group.of(cases_of(r, {all_orders, form}));
    if (alone.empty() || with.empty()) continue;
    const double before = rms_residual(alone), after = rms_residual(with);
    // a tenth less is a change that a reader would see
    to.say(fmt::format(
        "{} takes up {} of the light of several facets on {}: the residual is {:.2g} "
        "in place of {:.2g}.",
        what, after < 0.9 * before ? "some" : "little or nothing", group.name, after, before));
  }
}

void other_gammas(Findings& to, const CrossFitRows& r) {
  std::vector<std::string_view> truths;
  for (const auto& c : r.cases)
    if (c.truth.starts_with("GTR ") && std::ranges::find(truths, c.truth) == truths.end())
      truths.push_back(c.truth);
  for (const auto truth : truths)
    if (const auto s = shifts(cases_of(r, {truth, "ggx/smith_ggx.correlated/exact"}), "roughness"))
      to.say(
          fmt::format("GGX fitted to a surface of GTR with gamma {} shifts roughness {}, by the "
                      "log metric on that slice.",
                      truth.substr(4), span(s, signed_number)));
}

double middle_of(std::vector<double> all) {
  return median(all);
}
std::vector<double> each(const CrossFitRows& r, double PublishedFit::*of) {
  std::vector<double> out;
  for (const auto& p : r.published) out.push_back(p.*of);
  return out;
}

/// Tails and roughness of measured materials, by what others published of them.
void published(Findings& to, const CrossFitRows& r) {
  if (r.published.empty()) return;
  const auto tails = each(r, &PublishedFit::tail);
  const auto longer =
      static_cast<std::size_t>(std::ranges::count_if(tails, [](double c) { return c < 2; }));
  const double ggx = middle_of(each(r, &PublishedFit::ggx_log_rms)),
               gtr = middle_of(each(r, &PublishedFit::gtr_log_rms));
  to.judge("for many materials even GGX's tail is not long enough", "",
           verdict(2 * longer > tails.size(), longer > 0),
           fmt::format("{} by their published exponents", of_all(longer, tails.size())),
           "these are fits of measured materials of MERL by Löw and others.");
  std::vector<double> gamma;
  for (const auto& p : r.published)
    if (p.gamma_determined) gamma.push_back(p.gamma);
  const auto below =
      static_cast<std::size_t>(std::ranges::count_if(gamma, [](double g) { return g < 2; }));
  if (!gamma.empty())
    to.say(
        fmt::format("{} of these materials determine GTR's gamma. It is below GGX's 2 for {} of "
                    "them, with a median of {:.3g}.",
                    gamma.size(), below, middle_of(gamma)));
  to.say(
      fmt::format("A free gamma takes the median log-RMS residual of all {} from {:.2g} "
                  "to {:.2g}, each distribution with its own height-correlated Smith.",
                  r.published.size(), ggx, gtr));
  to.say(
      fmt::format("GGX's roughness of them is {:.2g} on the median, where Beckmann's was "
                  "published as {:.2g}.",
                  middle_of(each(r, &PublishedFit::ggx_roughness)),
                  middle_of(each(r, &PublishedFit::beckmann))));
}

/// Fits of what was made from the same forms, which ought to give everything back.
void trust(Findings& to, const CrossFitRows& r) {
  double roughness = 0, f0 = 0, error = 0;
  std::size_t own = 0, lost = 0, without = 0, values = 0, loose = 0;
  for (const auto& c : r.cases) {
    lost += !c.converged;
    for (const auto& v : c.values) {
      ++values, without += v.status != ParameterStatus::free;
      loose += v.status == ParameterStatus::unbounded;
    }
    if (c.kind != "exact") continue;
    if (c.truth == all_orders) {
      for (const auto& v : c.values)
        if (v.parameter == "roughness" && c.is_determined(v)) error = std::max(error, v.error);
      continue;
    }
    ++own;
    for (const auto& v : c.values) {
      if (v.parameter == "roughness") roughness = std::max(roughness, std::abs(v.shift()));
      if (v.parameter == "f0") f0 = std::max(f0, std::abs(v.shift()));
    }
  }
  if (own == 0) return;
  to.say(roughness < 1e-6 && f0 < 1e-5
             ? "A slice fitted with the forms that it was made from gives its parameters back."
             : fmt::format("A slice fitted with the forms that it was made from gives its "
                           "parameters back only roughly: roughness is off by up to {:.1g}.",
                           roughness));
  to.say(lost == 0 ? fmt::format("All {} fits converged.", r.cases.size())
                   : fmt::format("Of {} fits {} did not converge.", r.cases.size(), lost));
  if (without > 0)
    to.say(fmt::format(
        "{} of {} fitted parameters have no interval: they ended at a bound, were not determined, "
        "or belong to models that miss the truth by too much to bound them ({}).",
        without, values, number_or_none(loose)));
  if (without > 0)
    to.say(
        "Shifts leave these out, but for forms that are the truth to the last digits at a bound.");
  if (error > 0)
    to.say(fmt::format(
        "The random walks' noise shifts a fitted roughness of the exact form by at most {}.",
        rounded_up(error)));
}

}  // namespace

std::vector<CrossRange> ranges(const CrossFitRows& r) {
  std::vector<CrossRange> out;
  const auto by_another = [&](const CrossCase& c) {
    return std::ranges::any_of(r.cases, [&](const CrossCase& other) {
      return other.fitted == c.fitted && other.material == c.material && other.truth == c.truth &&
             other.metric != Metric::log;
    });
  };
  for (const auto& c : r.cases) {
    const auto layout = std::ranges::find(cross_layouts, c.layout, &CrossLayout::name);
    if (c.truth != once || c.kind == "exact" || layout->finer > 1 || !by_another(c)) continue;
    for (const std::string_view parameter : {"roughness", "f0"}) {
      const auto same = [&](const CrossRange& x) {
        return x.fitted == c.fitted && x.material == c.material && x.parameter == parameter &&
               x.metric == c.metric && x.layout == c.layout;
      };
      if (std::ranges::any_of(out, same)) continue;
      const auto s =
          shifts(cases_of(r, {once, c.fitted, c.metric, c.layout, c.material}), parameter);
      out.push_back({c.fitted, c.material, std::string(parameter), c.metric, layout->name,
                     s ? s.least().by : no_value, s ? s.most().by : no_value, s.all, s.at_bound});
    }
  }
  return out;
}

std::vector<CrossSentence> sentences_of_forms(const CrossFitRows& r) {
  std::vector<CrossSentence> out;
  for (const auto& c : r.cases) {
    const auto same = [&](const CrossSentence& s) {
      return s.truth == c.truth && s.fitted == c.fitted;
    };
    if (std::ranges::any_of(out, same)) continue;
    std::vector<std::string> parts;
    for (const auto& group : interfaces) {
      const auto cases = group.of(cases_of(r, {c.truth, c.fitted}));
      if (cases.empty()) continue;
      const auto tell = [&](std::string_view parameter, std::string_view name,
                            std::string (*said)(double)) {
        const auto s = shifts(cases, parameter);
        if (s.all == 0) return;
        parts.push_back(s ? fmt::format("{} of {} shifts {}", name, group.name, span(s, said))
                          : fmt::format("{} of {} has no interval", name, group.name));
        if (s && s.at_bound > 0)
          parts.push_back(fmt::format("{} of {} values have no interval", s.at_bound, s.all));
      };
      tell("roughness", "Roughness", signed_number);
      tell("f0", "F0", signed_percent);
      tell("gamma", "Gamma", signed_number);
      parts.push_back(fmt::format("The residual is up to {}", rounded_up(most_residual(cases))));
      if (const double noise = rms_noise(cases); noise > 0)
        parts.back() += fmt::format(", with {:.1g} of the walks' noise in it", noise);
    }
    out.push_back({c.truth, c.fitted, c.kind, fmt::format("{}.", fmt::join(parts, ". "))});
  }
  return out;
}

Findings findings(const CrossFitRows& r) {
  Findings all;
  f0_of_glass(all, r);
  roughness_of_dielectrics(all, r);
  gamma_of_both(all, r);
  lost_energy(all, r);
  takes_it_up(all, r, "ndf.gtr", "A free gamma");
  takes_it_up(all, r, "lambert+ggx/smith_ggx.correlated/exact", "A free Lambertian");
  other_gammas(all, r);
  published(all, r);
  trust(all, r);
  return all;
}

}  // namespace gonio
