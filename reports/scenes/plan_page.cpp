#include "reports/scenes/plan_page.h"

#include <algorithm>
#include <cmath>

#include "reports/finding/words.h"
#include "reports/page/numbers.h"
#include "reports/page/render.h"
#include "reports/page/spheres.h"
#include "reports/scenes/measure.h"
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
template <class Is>
std::string names(const scene::MaterialPlan& m, Is is) {
  std::vector<std::string> out;
  for (const auto& e : m.effects)
    if (is(e)) out.push_back(words_of(e.effect) + (e.keep ? form_words(e.form) : ""));
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

/// How the time changes: "6.3 × as fast", "18 × as slow".
std::string speed(double ratio) {
  return ratio < 1 ? times(1 / ratio) + " as slow" : times(ratio) + " as fast";
}

/// How far the plan was found to be off, in the material that differs most.
std::string found(const scene::Plan& p, std::string_view unit) {
  const auto upper = [](const scene::MaterialPlan& m) {
    return m.bounded ? m.checked.upper : m.checked.quantile;
  };
  const auto& far = *std::ranges::max_element(p.materials, {}, upper);
  const auto& worst = *std::ranges::max_element(
      p.materials, {}, [](const scene::MaterialPlan& m) { return m.checked.worst; });
  const auto of = [&](const scene::MaterialPlan& m) {
    return p.materials.size() == 1 ? std::string() : ", of " + m.name;
  };
  const auto beside = far.bounded
                          ? std::string()
                          : fmt::format(" from {}", scene::reference_in_words(far.reference));
  return fmt::format(
      "At {} of the fresh points the plan differs{} by {}{}{}{}; the worst point "
      "differs by {}{}.{}",
      percent(p.tolerance.quantile), beside, far.bounded ? "at most " : "", unit,
      rounded_up(upper(far), p.holds ? 2 : 3), of(far), significant(worst.checked.worst, 2),
      worst.name == far.name ? "" : of(worst),
      far.bounded ? "" : " No walk is known of this lobe, so that is no bound.");
}

std::vector<std::string> verdict(const scene::Plan& p, std::string_view unit) {
  std::vector<std::string> out;
  std::vector<const scene::MaterialPlan*> shippable;
  for (const auto& m : p.materials)
    if (!m.needs_table()) shippable.push_back(&m);
  std::ranges::sort(shippable, {}, &scene::MaterialPlan::speedup);
  if (shippable.size() == 1)
    out.push_back(fmt::format("Dropping what this scene does not need makes {} {}.",
                              shippable[0]->name, speed(shippable[0]->speedup)));
  else if (!shippable.empty())
    out.push_back(fmt::format(
        "Dropping what this scene does not need makes {} {}, and {}, which needs the most, {}.",
        shippable.back()->name, speed(shippable.back()->speedup), shippable[0]->name,
        speed(shippable[0]->speedup)));
  for (const auto& m : p.materials)
    if (m.needs_table())
      out.push_back(fmt::format(
          "No shader has the light between facets that {} needs here: what shaders have "
          "differs by {}{} at best. The table makes it {}.",
          m.name, unit, significant(m.shipped_upper, 2), speed(m.speedup)));
  out.push_back(found(p, unit));
  if (!p.holds)
    for (const auto& m : p.materials)
      if (!m.holds)
        out.push_back(fmt::format(
            "No form that is offered keeps {}{} for {}: its plan is the nearest, and the reference "
            "itself is known to {}.",
            unit, plain(p.tolerance.limit), m.name, significant(m.reference_error, 2)));
  if (p.budget)
    out.push_back(p.budget->fits
                      ? fmt::format("A visible point takes {} ns of the {} ns that the scene "
                                    "allows; the worst material errs by at most {}{}.",
                                    significant(p.budget->ns), plain(p.budget->budget_ns), unit,
                                    significant(p.budget->error, 2))
                      : fmt::format("Even the cheapest forms take {} ns a point, more than the {} "
                                    "ns that the scene allows.",
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
  return {"All effects, as planned, and the difference",
          "",
          {Markup{sphere_keys(scale) + R"(<div class="scene">)" +
                  sphere_figure(fmt::format("ΔE up to {}", significant(made.worst, 2)), pixels,
                                {{made.everything, "everything on"},
                                 {made.planned, "as planned"},
                                 {difference_png(made.difference, pixels, scale), "difference"}},
                                true) +
                  "</div>"}}};
}

Section one(const scene::MaterialPlan& m, const scene::Plan& p, const std::string& unit_name) {
  Table t{{{"effect"},
           {"here"},
           {unit_name + " if dropped by itself", true},
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
                   : Cell{"drop"},
          absent ? "–" : (proved ? "≤ " : "") + significant(e.error_if_dropped, 2),
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
            "Each effect dropped by itself, all others exact. Errors do not add, so the plan's set "
            "is checked as a whole. Savings are measured on all effects in double, "
            "with Kulla and Conty's lobe between facets.",
            {t}};
  if (!m.holds)
    s.parts.emplace_back(
        Prose{"No set of forms keeps the tolerance here. This one is the nearest."});
  const std::string failed =
      m.passed_over ? fmt::format(" {} failed there.", many(m.passed_over, "cheaper set")) : "";
  s.parts.emplace_back(Prose{
      m.bounded
          ? fmt::format("Checked on {} fresh points: less than {} of all exceed the limit, with a "
                        "confidence of {}. The error of the reference is in it.{}",
                        count_text(c.samples), percent(c.bound), percent(p.tolerance.confidence),
                        failed)
          : fmt::format("Checked on {} fresh points beside {}. No walk is known of this lobe, so "
                        "nothing is claimed beyond these points.{}",
                        count_text(c.samples), scene::reference_in_words(m.reference), failed),
      "small"});
  s.parts.emplace_back(Prose{fmt::format("The model: `{}`", m.spec), "small"});
  if (m.front.size() > 1) {
    Table front{{{"keeps"},
                 {"ns", true},
                 {"operations", true},
                 {fmt::format("{} at {}", unit_name, percent(p.tolerance.quantile)), true},
                 {"worst", true}},
                {}};
    bool has_plan = false;
    for (const auto& f : m.front) {
      const bool is_plan = f.forms == m.forms;
      has_plan = has_plan || is_plan;
      front.add(Cell{kept_words(f.forms), {}, is_plan ? "the plan" : "", ""}, significant(f.ns),
                rounded(f.ops),
                m.bounded ? "≤ " + rounded_up(f.error.upper) : significant(f.error.quantile, 2),
                significant(f.error.worst, 2));
    }
    s.parts.emplace_back(
        Subtitle{fmt::format("{} sets of which none is faster and errs less", m.front.size())});
    s.parts.emplace_back(front);
    if (!has_plan && m.holds)
      s.parts.emplace_back(Prose{
          fmt::format("The plan, at {} ns, is none of them: among sets that cost as much, within "
                      "the spread, it keeps the fewest effects.",
                      significant(m.ns)),
          "small"});
  }
  return s;
}

}  // namespace
}  // namespace gonio::page

namespace gonio {

std::string plan_page_html(const scene::Scene& s, const scene::Plan& p) {
  using namespace page;
  const bool relative = p.tolerance.metric == scene::Metric::relative;
  const std::string unit = relative ? "" : "ΔE2000 ", unit_name = relative ? "change" : "ΔE2000";
  Page out{"", "plan", "Plan of a scene", "Only what the scene needs", verdict(p, unit)};
  Table t{{{"material"},
           {"time", true},
           {"operations", true},
           {"keep"},
           {"drop"},
           {fmt::format("{} at {}", unit_name, page::percent(p.tolerance.quantile)), true},
           {"worst", true}},
          {},
          "told-by-cell"};
  for (const auto& m : p.materials)
    t.add(m.name, speed(m.speedup), signed_percent(0 - m.ops_saved),
          names(m, [](const auto& e) { return e.keep; }),
          names(m, [](const auto& e) { return !e.keep && e.why != scene::Why::structural; }),
          m.bounded ? "≤ " + rounded_up(m.checked.upper, m.holds ? 2 : 3)
                    : significant(m.checked.quantile, 2),
          significant(m.checked.worst, 2));
  out.sections = {
      {"What to keep, and how much faster that is",
       "Times of the effects that a material has, in float, with Kulla and Conty's "
       "compensation, over the plan's; both of composed column kernels on this machine. "
       "Operations count no look-ups.",
       {t}},
      spheres(s, p)};
  for (const auto& m : p.materials) out.sections.push_back(one(m, p, unit_name));
  out.setting =
      "Points are what viewers see, half of them near highlights. Every number of the tables is in "
      "the plan beside it.";
  return page_html(out, {});
}

}  // namespace gonio
