#include "reports/scenes/plan_page.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/text.h"
#include "reports/finding/names.h"
#include "reports/finding/words.h"
#include "reports/page/numbers.h"
#include "reports/page/render.h"
#include "reports/page/spheres.h"
#include "reports/scenes/measure.h"
#include "scene/plan/cost.h"
#include "scene/plan/samples.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio::page {
namespace {

using page::Table;
using scene::Effect;

std::string spaced(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}
std::string words_of(Effect e) {
  if (e == Effect::coupling) return "coupling of the diffuse";
  if (e == Effect::spectrum) return "spectrum of the metal";
  if (e == Effect::environment) return "integral over the environment";
  if (e == Effect::precision) return "double precision";
  return std::string(scenes::name_of_effect(e));
}
std::string form_words(std::string_view form) {
  return form == "on" || form == "off" ? "" : fmt::format(" ({})", spaced(std::string(form)));
}
/// What a plan has in the place of an effect that it does not keep: " → schlick"; nothing where it leaves it out.
std::string instead(const scene::MaterialPlan& m, const scene::PlannedEffect& e) {
  const auto form = m.forms[e.effect];
  return is_absence(form) ? "" : " → " + spaced(std::string(name_of(form)));
}
template <class Is>
std::string names(const scene::MaterialPlan& m, Is is) {
  std::vector<std::string> out;
  for (const auto& e : m.effects)
    if (is(e)) out.push_back(words_of(e.effect) + (e.keep ? form_words(e.form) : instead(m, e)));
  return out.empty() ? "nothing" : fmt::format("{}", fmt::join(out, ", "));
}
std::string rounded(double n) {
  return count_text(static_cast<std::size_t>(std::max(0.0, std::round(n))));
}

std::string kept_words(const scene::Forms& forms) {
  std::vector<std::string> out;
  for (std::size_t k = 0; k < scene::effect_count; ++k)
    if (const auto e = static_cast<Effect>(k); forms.keeps(e))
      out.push_back(words_of(e) + form_words(forms.name(e)));
  return out.empty() ? "nothing" : fmt::format("{}", fmt::join(out, ", "));
}

/// A bound as it stands in a sentence, without its sign: never below the number.
std::string bound_text(double x, int digits = 2) {
  return significant(std::stod(rounded_up(x, digits)), digits);
}
double error_of(const scene::MaterialPlan& m) {
  return m.bounded ? m.checked.upper : m.checked.quantile;
}
const scene::MaterialPlan* farthest(const scene::Plan& p, bool bounded) {
  const scene::MaterialPlan* far = nullptr;
  for (const auto& m : p.materials)
    if (m.bounded == bounded && (!far || error_of(m) > error_of(*far))) far = &m;
  return far;
}

/// How far the plan was found to be off, in the materials that differ most.
void say_errors(std::vector<std::string>& out, const scene::Plan& p, const std::string& unit) {
  const auto most = percent_given(p.tolerance.quantile);
  const auto of = [&](const scene::MaterialPlan& m) {
    return p.materials.size() == 1 ? std::string() : ", of " + m.name;
  };
  if (const auto* m = farthest(p, true)) {
    const auto& worst = *std::ranges::max_element(
        p.materials, {}, [](const auto& each) { return each.checked.worst; });
    out.push_back(fmt::format(
        "At {} of the fresh points the plan differs by at most {}{}{}; the worst point differs by "
        "{}{}.",
        most, unit, bound_text(error_of(*m), p.holds ? 2 : 3), of(*m),
        bound_text(worst.checked.worst), worst.name == m->name ? "" : of(worst)));
    if (m->reference_error >= 0.1 * error_of(*m))
      out.push_back(fmt::format("Up to {} of {}'s error may be the reference's own.",
                                bound_text(m->reference_error, p.holds ? 2 : 3), m->name));
  }
  if (const auto* m = farthest(p, false))
    out.push_back(fmt::format(
        "The plan{} differs from {} by {}{} at {} of the points; no walk is known of this lobe, so "
        "that is no bound.",
        p.materials.size() == 1 ? std::string() : " of " + m->name,
        scene::compensation_in_words(m->reference), unit, significant(error_of(*m), 2), most));
}

/// True where nothing of what the material has is left out but double precision: its time is that it is compared with.
bool needs_all(const scene::MaterialPlan& m) {
  return std::abs(m.ops_saved) < 1e-12;
}

/// How much faster or slower the plan makes the materials that shaders can run as planned.
void say_speeds(std::vector<std::string>& out, const scene::Plan& p) {
  std::vector<const scene::MaterialPlan*> faster, slower;
  std::vector<std::string> whole, as_fast;
  for (const auto& m : p.materials) {
    if (m.needs_table()) continue;
    if (needs_all(m))
      whole.push_back(m.name);
    else if (scene::is_as_fast(m.speedup))
      as_fast.push_back(m.name);
    else if (m.speedup < 1)
      slower.push_back(&m);
    else
      faster.push_back(&m);
  }
  std::ranges::stable_sort(faster, std::greater{}, &scene::MaterialPlan::speedup);
  const auto* const does =
      p.budget ? "The plan makes" : "Dropping what this scene does not need makes";
  if (!faster.empty()) {
    const auto &first = *faster[0], &last = *faster.back();
    const auto most = scenes::speed(first.speedup), least = scenes::speed(last.speedup);
    out.push_back(
        faster.size() == 1 ? fmt::format("{} {} {}.", does, first.name, most)
        : most == least
            ? fmt::format("{} {} {}.", does,
                          faster.size() == 2 ? first.name + " and " + last.name
                                             : fmt::format("each of {} materials", faster.size()),
                          most)
        : faster.size() == 2
            ? fmt::format("{} {} {}, and {} {}.", does, first.name, most, last.name, least)
            : fmt::format("{} {} materials between {} ({}) and {} ({}).", does,
                          count_text(faster.size()), least, last.name, most, first.name));
  }
  for (const auto* m : slower)
    out.push_back(fmt::format("The plan makes {} {}{}.", m->name, scenes::speed(m->speedup),
                              m->holds && !p.budget && p.cost == scene::Cost::time
                                  ? ": no set of forms as fast as all effects keeps the tolerance "
                                    "with a plan's margin"
                                  : ""));
  if (!as_fast.empty())
    out.push_back(fmt::format("{} {} as long as with all effects.", list_text(as_fast),
                              as_fast.size() == 1 ? "takes" : "take"));
  if (!whole.empty())
    out.push_back(fmt::format("{} {} all effects that {}.", list_text(whole),
                              whole.size() == 1 ? "keeps" : "keep",
                              whole.size() == 1 ? "it has" : "they have"));
}

/// Materials whose plans do not hold, whether the budget does that, and by how much they fail.
void say_broken(std::vector<std::string>& out, const scene::Plan& p, const std::string& unit) {
  for (const auto& m : p.materials) {
    if (m.holds) continue;
    out.push_back(
        capital(not_kept(m, p.budget.has_value(),
                         fmt::format("{}{} for {}", unit, plain(p.tolerance.limit), m.name))) +
        ".");
    out.push_back(fmt::format("The plan of {} {}.", m.name, what_is_exceeded(m)));
  }
}

/// Materials that keep the light between facets as a table: whether the tolerance needs that.
void say_tables(std::vector<std::string>& out, const scene::Plan& p) {
  for (const auto& m : p.materials) {
    if (!m.needs_table()) continue;
    const auto time = m.speedup < 1 ? fmt::format("takes {} the time", times(1 / m.speedup))
                                    : "is " + scenes::speed(m.speedup);
    const bool is_needed = m.holds && m.without_table && !m.without_table->keeps_margin();
    out.push_back(
        is_needed
            ? fmt::format("No forms that shaders have keep the tolerance for {} with a plan's "
                          "margin: it needs the light between facets as a table, and {}.",
                          m.name, time)
            : fmt::format("The plan of {} keeps the light between facets as a table, which no "
                          "shader has, and {}.",
                          m.name, time));
    if (m.without_table) out.push_back(capital(without_table(m, p.tolerance)) + ".");
  }
}

std::vector<std::string> verdict(const scene::Plan& p, const std::string& unit) {
  std::vector<std::string> out;
  say_broken(out, p, unit);
  if (p.budget && !p.budget->fits)
    out.push_back(
        fmt::format("Even the cheapest forms take {} ns a point, more than the {} ns that "
                    "the scene allows.",
                    significant(p.budget->ns), plain(p.budget->budget_ns)));
  say_speeds(out, p);
  say_tables(out, p);
  say_errors(out, p, unit);
  if (p.budget && p.budget->fits)
    out.push_back(fmt::format("A visible point takes {} ns of the {} ns that the scene allows.",
                              significant(p.budget->ns), plain(p.budget->budget_ns)));
  return out;
}

/// The scene as a display shows it, with all effects, as planned, and the difference.
Section spheres(const scene::Scene& s, const scene::Plan& p) {
  constexpr std::size_t pixels = 192, samples = 4;
  const scene::Lit lit(s);
  std::vector<scene::Forms> forms;
  for (const auto& m : s.materials) {
    const auto at = std::ranges::find(p.materials, m.name, &scene::MaterialPlan::name);
    forms.push_back(at == p.materials.end() ? lit.looks[forms.size()].exact() : at->forms);
  }
  const auto made = scenes::picture_of(lit, forms, pixels, samples);
  const auto scale = scenes::difference_scale(p.tolerance);
  const bool under_sky = std::ranges::any_of(
      s.lights, [](const auto& l) { return std::holds_alternative<scene::EnvironmentLight>(l); });
  return {
      "All effects, as planned, and the difference",
      std::string("The pictures leave the reference's own error out.") +
          (under_sky ? " A pixel's light comes from few directions of the sky, so single pixels "
                       "may differ by more than the points of the check."
                     : ""),
      {Markup{sphere_keys(scale) + R"(<div class="scene">)" +
              sphere_figure(
                  fmt::format("ΔE of a pixel up to {}", bound_text(made.worst)), pixels,
                  {{made.everything, "all effects", "all effects"},
                   {made.planned, "as planned", "as planned"},
                   {difference_png(made.difference, pixels, scale), "difference", "difference"}},
                  true) +
              "</div>"}}};
}

/// What a set of the front failed by on fresh points.
std::string failure(const scene::MaterialPlan& m, const scene::Candidate& c) {
  if (c.failed->worst > m.margin.most_worst) return "failed, worst " + rounded_up(c.failed->worst);
  return std::isfinite(c.failed->exceeding_bound)
             ? fmt::format("failed, up to {} beyond the limit",
                           percent_at_most(c.failed->exceeding_bound))
             : "failed";
}

Section one(const scene::MaterialPlan& m, const scene::Plan& p, const std::string& unit_name) {
  Table t{{{"effect"},
           {"here"},
           {unit_name + " if only this is dropped", true},
           {"ns saved", true},
           {"operations saved", true},
           {"why"}},
          {},
          "told-by-cell"};
  auto effects = m.effects;
  std::ranges::stable_sort(effects, {}, [](const auto& e) {
    return e.keep ? 0 : e.why == scene::Why::structural ? 2 : 1;
  });
  for (const auto& e : effects) {
    const bool absent = e.why == scene::Why::structural, proved = e.why == scene::Why::proved;
    t.add(capital(words_of(e.effect)),
          e.keep   ? Cell{"keep" + form_words(e.form), {}, {}, "verdict-yes"}
          : absent ? Cell{"absent", {}, {}, "muted"}
                   : Cell{(is_absence(m.forms[e.effect]) ? "drop" : "simplify") + instead(m, e)},
          absent   ? "–"
          : proved ? at_most(e.error_if_dropped)
                   : significant(e.error_if_dropped, 2),
          absent ? "–" : significant(e.ns_saved, 2), absent ? "–" : rounded(e.ops_saved),
          Cell{absent   ? e.reason
               : proved ? "by proof"
                        : "measured",
               {},
               {},
               "muted"});
  }
  const auto& c = m.checked;
  Section s{m.name,
            "Each effect dropped by itself, all others exact, without the reference's own error. "
            "Errors do not add, so the plan's set is checked as a whole. Savings are those from "
            "all effects in double, as double precision is one of them.",
            {t}};
  if (!m.holds)
    s.parts.emplace_back(Prose{
        fmt::format("{}. It {}.", capital(not_kept(m, p.budget.has_value(), "the tolerance here")),
                    what_is_exceeded(m))});
  const std::string failed =
      (m.passed_over ? fmt::format(" {} failed on such points.", many(m.passed_over, "cheaper set"))
                     : std::string()) +
      (m.failed ? " " + capital(why_passed_over(m, p.cost)) + "." : "") +
      (m.is_unlit() ? " No light comes to any of them: every set of forms looks the same." : "");
  s.parts.emplace_back(Prose{
      m.bounded
          ? fmt::format(
                "Checked on {} fresh points: less than {} of all exceed the limit, with a "
                "confidence of {} over the points. Two standard errors of the reference are in "
                "each difference.{}",
                count_text(c.samples), rounded_up(100 * c.bound, 3) + "\u202f%",
                percent_given(p.tolerance.confidence), failed)
          : fmt::format("Checked on {} fresh points beside {}. No walk is known of this lobe, so "
                        "nothing is claimed beyond these points.{}",
                        count_text(c.samples), scene::compensation_in_words(m.reference), failed),
      "small"});
  if (m.only_unseen && m.holds)
    s.parts.emplace_back(
        Prose{"No other set keeps the tolerance where sets are compared and its margin on fresh "
              "points, so the plan drops only what changes nothing."});
  s.parts.emplace_back(Prose{fmt::format("The model: `{}`", m.spec), "small"});
  if (m.front.size() > 1) {
    const bool by_time = p.cost == scene::Cost::time;
    const auto keeps = [&](const scene::Judgement& j) {
      return m.bounded ? j.keeps(p.tolerance)
                       : j.quantile <= p.tolerance.limit && j.worst <= p.tolerance.max;
    };
    Table front{{{"keeps"},
                 {"ns", true},
                 {"spread", true},
                 {"operations", true},
                 {fmt::format("{} at {}", unit_name, percent_given(p.tolerance.quantile)), true},
                 {"worst", true}},
                {}};
    bool has_plan = false, has_faster = false;
    for (const auto& f : m.front) {
      const bool is_plan = f.forms == m.forms;
      has_plan = has_plan || is_plan;
      has_faster = has_faster || (by_time && !f.failed && f.ns < m.ns && keeps(f.error));
      front.add(Cell{kept_words(f.forms),
                     {},
                     is_plan    ? "the plan"
                     : f.failed ? failure(m, f)
                                : "",
                     ""},
                significant(f.ns), "± " + significant(f.spread(), 2), rounded(f.ops),
                m.bounded ? at_most(f.error.upper) : significant(f.error.quantile, 2),
                bound_text(f.error.worst));
    }
    s.parts.emplace_back(
        Subtitle{fmt::format("{} sets of which none {} and errs less", m.front.size(),
                             by_time ? "is faster" : "takes fewer operations")});
    s.parts.emplace_back(
        Prose{fmt::format("Their errors are of the {} points that sets are compared on, and not of "
                          "the fresh points on which the plan was checked.",
                          count_text(m.front[0].error.samples)),
              "small"});
    s.parts.emplace_back(front);
    if (m.holds && !m.only_unseen && (!has_plan || (has_faster && !p.budget))) {
      const auto which = has_plan
                             ? std::string("A set that took less time keeps the tolerance, too.")
                             : fmt::format("The plan, at {} ± {} ns, is none of them.",
                                           significant(m.ns), significant(m.ns_spread, 2));
      s.parts.emplace_back(Prose{
          by_time
              ? which +
                    " A set counts as no slower than one that computes all it does and more. Times "
                    "within twice their spreads count as the same, and among such sets the "
                    "plan takes the fewest operations, then keeps the fewest effects."
              : "The plan is none of them: among sets of as many operations it keeps the "
                "fewest effects.",
          "small"});
    }
  }
  return s;
}

}  // namespace
}  // namespace gonio::page

namespace gonio {

namespace {

std::string unit_of(const scene::Tolerance& t) {
  return t.metric == scene::Metric::relative ? "" : "ΔE2000 ";
}

/// "3.8", "3.6": a number and what it exceeds, both rounded up as everywhere on the page, to as few digits as tell them apart.
std::pair<std::string, std::string> told_apart(double larger, double smaller, int digits) {
  constexpr int all_digits = 15;
  std::pair<std::string, std::string> both;
  for (; digits <= all_digits && both.first == both.second; ++digits)
    both = {rounded_up(larger, digits), rounded_up(smaller, digits)};
  return both;
}
/// What a set exceeds that a plan may not.
std::string exceeded(const scene::Judgement& j, const scene::Margin& margin, bool bounded) {
  if (bounded ? margin.is_taken_by_worst(j) : j.worst > margin.most_worst) {
    const auto [worst, most] = told_apart(j.worst, margin.most_worst, 2);
    return fmt::format("differs by {} at its worst point, and {} is allowed", worst, most);
  }
  if (!bounded) return "exceeds the limit at too many points";
  const auto [share, most] = told_apart(100 * j.bound, 100 * margin.most_exceeding, 3);
  return fmt::format(
      "may exceed the limit at {} % of all points, and {} % is allowed, so that a verification on "
      "other points agrees",
      share, most);
}

}  // namespace

std::string why_passed_over(const scene::MaterialPlan& m, scene::Cost cost) {
  const auto& f = *m.failed;
  // The nearest set is one by operations, and so may a cheaper one be.
  const bool by_time = cost == scene::Cost::time && m.passed_over > 0 && f.ns < m.ns;
  const auto at = by_time ? fmt::format("{:.3g} ns", f.ns)
                          : counted(static_cast<std::size_t>(std::round(f.ops)), "operation");
  const auto which =
      m.passed_over > 0
          ? fmt::format("the cheapest{} ({})", m.passed_over > 1 ? " of them" : "", at)
          : fmt::format("the nearest set with one form cheaper ({}; judged on {} points)", at,
                        page::count_text(f.error.samples));
  return which + " " + exceeded(f.error, f.margin, m.bounded);
}

std::string not_kept(const scene::MaterialPlan& m, bool has_budget, const std::string& what) {
  return !has_budget ? fmt::format(
                           "no set of forms keeps {} with a plan's margin: this is the "
                           "closest plan",
                           what)
         : m.could_hold
             ? fmt::format("the budget leaves no set that keeps {} with a plan's margin", what)
             : fmt::format(
                   "no set of forms keeps {} with a plan's margin, with the "
                   "budget or without",
                   what);
}

std::string what_is_exceeded(const scene::MaterialPlan& m) {
  return exceeded(m.checked, m.margin, m.bounded);
}

std::string without_table(const scene::MaterialPlan& m, const scene::Tolerance& t) {
  const auto& set = *m.without_table;
  const auto forms =
      fmt::format("Its forms: {}; {} % of the points are within {}{}", page::kept_words(set.forms),
                  in_percent(t.quantile), unit_of(t), rounded_up(set.error.upper));
  return set.keeps_margin()
             ? fmt::format("a set without the table keeps the tolerance, too, in {:.3g} ns. {}",
                           set.ns, forms)
             : fmt::format("a set without the table {}. {}",
                           exceeded(set.error, set.margin, m.bounded), forms);
}

std::string plan_page_html(const scene::Scene& s, const scene::Plan& p) {
  using namespace page;
  const bool relative = p.tolerance.metric == scene::Metric::relative;
  const std::string unit = unit_of(p.tolerance), unit_name = relative ? "change" : "ΔE2000";
  Page out{"", "plan", "Plan of a scene", "Only what the scene needs", verdict(p, unit)};
  Table t{{{"material"},
           {"time", true},
           {"operations", true},
           {"keep"},
           {"drop, or simplify →"},
           {fmt::format("{} at {}", unit_name, percent_given(p.tolerance.quantile)), true},
           {"worst", true}},
          {},
          "told-by-cell"};
  for (const auto& m : p.materials)
    t.add(
        m.name, scenes::speed(m.speedup), signed_percent(0 - m.ops_saved),
        names(m, [](const auto& e) { return e.keep; }),
        names(m, [](const auto& e) { return !e.keep && e.why != scene::Why::structural; }),
        m.bounded ? at_most(m.checked.upper, m.holds ? 2 : 3) : significant(m.checked.quantile, 2),
        bound_text(m.checked.worst));
  out.sections = {
      {"What to keep, and how much faster that is",
       fmt::format(
           "The tolerance: {} of the points differ by {}{} at most, and none by more than {}. "
           "{}Time: that of the plan beside that of all effects which the material has, in float, "
           "with Kulla and Conty's lobe, on this machine. Operations count no look-ups.",
           percent_given(p.tolerance.quantile), unit, plain(p.tolerance.limit),
           plain(p.tolerance.max),
           p.materials.empty()
               ? ""
               : fmt::format("A plan holds with a margin, so that a verification on other points "
                             "agrees: at most {} % may exceed the limit, and the worst may differ "
                             "by {}. ",
                             rounded_up(100 * p.materials[0].margin.most_exceeding, 3),
                             rounded_up(p.materials[0].margin.most_worst))),
       {t}},
      spheres(s, p)};
  for (const auto& m : p.materials) out.sections.push_back(one(m, p, unit_name));
  out.setting =
      "Points are what viewers see, half of them near highlights. Every number of the tables is in "
      "the plan beside it; a spread below 3 % of its time counts as that.";
  return page_html(out, {});
}

}  // namespace gonio
